/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A render from its options to its picture: what is the same for all pixels is made once, the image is cut into tasks
 * of whole rows, whose number depends on the sizes only, and in a task pixels go in groups through the pipeline.
 */
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "render/film.h"
#include "render/rows.h"

enum { SAMPLES_A_TASK = 1 << 15 };

typedef struct job {
    koksma__frame *frame;
    koksma__film film;
    const koksma__pipeline *pipeline;
    int first_row, end_row; /* what is rendered of the image */
    int rows_a_task;
    size_t capacity; /* samples of a group */
    atomic_ullong rays;
} job;

/* A task's room. */
typedef struct room {
    koksma__sample_room draw;
    void *pipeline;
    koksma__values values;
} room;

/* ---- The scene in floats ------------------------------------------------------------------------------ */

static koksma__batch_camera make_camera(const koksma__camera *from, int width, int height)
{
    koksma__batch_camera c;
    const double step = 2 * tan(from->fov_rad / 2) / height;
    for (int k = 0; k < 3; k++) {
        const double right = step * from->right[k], down = step * from->down[k];
        c.eye[k] = (float)from->eye[k];
        c.base[k] = (float)(from->forward[k] - 0.5 * width * right - 0.5 * height * down);
        c.step_x[k] = (float)right;
        c.step_y[k] = (float)down;
    }
    return c;
}

static koksma__batch_material make_material(const koksma__material *from)
{
    koksma__batch_material m = {.checker = from->checker,
                                .albedo = {(float)from->albedo[0][0], (float)from->albedo[1][0]}};
    if (from->checker) {
        const double c = cos(from->angle_rad) / from->period, s = sin(from->angle_rad) / from->period;
        m.su = (float)c;
        m.sv = (float)s;
        m.tu = (float)-s;
        m.tv = (float)c;
        m.s0 = (float)from->phase[0];
        m.t0 = (float)from->phase[1];
    }
    return m;
}

static koksma_status make_materials(koksma__frame *f)
{
    const size_t n = f->scene->n_materials;
    f->materials = calloc(n + 1, sizeof *f->materials);
    f->substances = calloc(n + 1, sizeof *f->substances);
    if (!f->substances || !f->materials) {
        return koksma__fail_memory((n + 1) * sizeof *f->substances);
    }
    for (size_t i = 0; i < n; i++) {
        f->materials[i] = make_material(&f->scene->materials[i]);
        f->substances[i] = koksma__substance_of(&f->scene->materials[i]);
    }
    return KOKSMA_OK;
}

/* ---- The frame ------------------------------------------------------------------------------------------- */

/* What samples will be spent on. */
static koksma__use_list list_uses(const koksma__frame *f)
{
    unsigned lobes = 0;
    for (size_t i = 0; i < f->scene->n_materials; i++) {
        lobes |= f->substances[i].lobes;
    }
    const bool one = f->options->lights != KOKSMA_LIGHTS_ALL && f->lights.n > 0;
    const int lights = one ? 1 : (int)f->lights.n;
    return (koksma__use_list){.lens = f->scene->camera.lens_radius > 0,
                              .time = f->scene->moves,
                              .lights = f->rules->areas ? lights : 0,
                              .light_choice = one,
                              .vertices = lobes & f->rules->followed ? f->depth + 1 : 1};
}

static koksma_status make_frame(koksma__frame *f, const koksma_run *run)
{
    const koksma_render_options *options = f->options;
    koksma_status status = make_materials(f);
    status = status ? status : koksma__lights_init(f->scene, &f->lights);
    if (status) {
        return status;
    }
    f->camera = make_camera(&f->scene->camera, options->width, options->height);
    f->uses = list_uses(f);
    status = options->scope == KOKSMA_SCOPE_IMAGE ? koksma__image_samples(options, &f->uses, run, &f->sampler)
                                                  : koksma__pixel_samples(options, &f->uses, &f->sampler);
    status = status                   ? status
             : f->scene->n_placements ? koksma__accel_embree(f->scene, &f->geometry)
                                      : koksma__accel_shapes(f->scene, &f->geometry);
    if (!status && (options->splat || strcmp(options->filter->name, "box") != 0)) {
        status = koksma__filter_open(options->filter, &f->filter);
    }
    return !status && f->rules->open ? f->rules->open(f, run) : status;
}

void koksma__frame_close(koksma__frame *f)
{
    if (f->rules && f->rules->close) {
        f->rules->close(f);
    }
    if (f->sampler.release) {
        f->sampler.release(&f->sampler);
    }
    if (f->geometry.release) {
        f->geometry.release(&f->geometry);
    }
    koksma__filter_close(f->filter);
    koksma__lights_fini(&f->lights);
    free(f->materials);
    free(f->substances);
}

/* ---- Groups ----------------------------------------------------------------------------------------------- */

koksma_status koksma__group_draw(const koksma__frame *frame, const koksma__group *group, uint32_t use, bool on_film,
                                 koksma__sample_room *room_for, float *pairs)
{
    const size_t width = (size_t)frame->options->width, n = group->start[group->count];
    koksma_status status = KOKSMA_OK;
    for (size_t p = 0; !status && p < group->count; p++) {
        const size_t pixel = group->first + p;
        const float offset[2] = {on_film ? (float)(pixel % width) : 0, on_film ? (float)(pixel / width) : 0};
        status = frame->sampler.draw(&frame->sampler, pixel, use, offset, room_for, pairs + 2 * group->start[p]);
    }
    for (size_t i = n; n && i < koksma__whole_lanes(n); i++) {
        memcpy(pairs + 2 * i, pairs + 2 * (n - 1), 2 * sizeof *pairs);
    }
    return status;
}

/* As many pixels from `first` on as fill a block, one at least, none from `end` on. */
static void fill_group(const koksma__frame *f, size_t first, size_t end, koksma__group *group)
{
    group->first = first;
    group->count = 0;
    group->start[0] = 0;
    while (first + group->count < end && group->count < KOKSMA__BLOCK) {
        const size_t n = group->start[group->count] + f->sampler.count(&f->sampler, first + group->count);
        if (group->count && n > KOKSMA__BLOCK) {
            return;
        }
        group->start[++group->count] = n;
    }
}

static koksma_status render_group(job *j, size_t task, const koksma__group *group, room *r)
{
    const koksma__frame *f = j->frame;
    koksma_status status = koksma__group_draw(f, group, KOKSMA__USE_PIXEL, true, &r->draw, r->values.film);
    if (!status && group->start[group->count]) {
        koksma__film_place(f, group, &r->values);
        status = j->pipeline->trace(f, r->pipeline, group, &r->values);
    }
    if (!status) {
        koksma__film_add(f, &j->film, task, group, &r->values);
    }
    return status;
}

/* ---- Tasks --------------------------------------------------------------------------------------------- */

static void room_fini(const job *j, room *r)
{
    koksma__sample_room_fini(&r->draw);
    if (r->pipeline) {
        j->pipeline->close(r->pipeline);
    }
    free(r->values.film);
    free(r->values.weights);
    free(r->values.rgb);
    free(r->values.albedo);
    free(r->values.normal);
    free(r->values.depth);
}

static koksma_status room_init(const job *j, room *r)
{
    const size_t n = j->capacity;
    koksma__values *v = &r->values;
    *r = (room){.values = {.film = malloc(2 * n * sizeof(float)),
                           .weights = malloc(n * sizeof(float)),
                           .rgb = malloc(n * (size_t)j->frame->channels * sizeof(float))}};
    bool all = v->film && v->weights && v->rgb;
    if (j->film.all_layers) {
        v->albedo = malloc(3 * n * sizeof(float));
        v->normal = malloc(3 * n * sizeof(float));
        v->depth = malloc(n * sizeof(float));
        all &= v->albedo && v->normal && v->depth;
    }
    koksma_status status = all ? KOKSMA_OK : koksma__fail_memory(13 * n * sizeof(float));
    status = status ? status : koksma__sample_room_init(&r->draw, &j->frame->sampler);
    status = status ? status : j->pipeline->open(j->frame, n, &r->pipeline);
    if (status) {
        room_fini(j, r);
    }
    return status;
}

static koksma_status render_rows(void *context, size_t task)
{
    job *j = context;
    const koksma__frame *f = j->frame;
    const int first_row = j->first_row + (int)task * j->rows_a_task, left = j->end_row - first_row;
    const int rows = left < j->rows_a_task ? left : j->rows_a_task;
    const size_t width = (size_t)f->options->width;
    room r;
    koksma__group group;
    koksma_status status = room_init(j, &r);
    if (status) {
        return status;
    }
    status = koksma__film_open_task(f, &j->film, task, first_row, rows);
    for (int y = first_row; y < first_row + rows; y++) {
        const size_t end = ((size_t)y + 1) * width;
        for (size_t pixel = end - width; !status && pixel < end; pixel += group.count) {
            fill_group(f, pixel, end, &group);
            status = render_group(j, task, &group, &r);
        }
    }
    atomic_fetch_add(&j->rays, r.values.rays);
    room_fini(j, &r);
    return status;
}

static koksma_status render_image(job *j, const koksma_run *run, bool all_layers, koksma_layers *out)
{
    const koksma__frame *f = j->frame;
    const size_t spp = (size_t)f->options->spp, width = (size_t)f->options->width;
    const size_t rows = SAMPLES_A_TASK / (width * spp);
    j->rows_a_task = rows ? (int)rows : 1;
    const size_t tasks = (size_t)((j->end_row - j->first_row + j->rows_a_task - 1) / j->rows_a_task);
    j->capacity = koksma__whole_lanes(f->sampler.most < KOKSMA__BLOCK ? KOKSMA__BLOCK : f->sampler.most);
    j->pipeline = koksma__direct_can(f) ? &koksma__direct_pipeline : &koksma__tracer_pipeline;
    koksma_status status = koksma__film_init(f, all_layers, tasks, out, &j->film);
    status = status ? status : koksma__parallel(run, tasks, render_rows, j);
    if (!status || status == KOKSMA_INTERRUPTED) {
        const koksma_status finish = koksma__film_finish(f, &j->film);
        status = status ? status : finish;
    }
    out->rays = atomic_load(&j->rays);
    koksma__film_fini(&j->film);
    return status;
}

/* ---- The public functions ------------------------------------------------------------------------------ */

void koksma_render_options_init(koksma_render_options *options, const koksma_scene *scene)
{
    *options = (koksma_render_options){.spp = 16,
                                       .width = scene->width,
                                       .height = scene->height,
                                       .integrator = koksma_integrator_find("distribution"),
                                       .depth = -1,
                                       .filter = koksma_filter_find("box")};
    koksma_pattern_spec("n-rooks", &options->pattern);
}

static koksma_status check(const koksma_render_options *o)
{
    if (o->width < 1 || o->height < 1 || o->width > KOKSMA_MAX_IMAGE_SIDE || o->height > KOKSMA_MAX_IMAGE_SIDE ||
        (size_t)o->width * (size_t)o->height > KOKSMA_MAX_PIXELS) {
        koksma_image none;
        return koksma_image_init(&none, o->width, o->height, 1); /* says what is wrong with them */
    }
    if (o->spp < 1 || o->spp > KOKSMA_MAX_SPP) {
        return koksma__fail(KOKSMA_ARGUMENT, "spp = %d: samples a pixel are 1 to %d", o->spp, KOKSMA_MAX_SPP);
    }
    if (!koksma_pairing_name(o->pairing) || !koksma_scope_name(o->scope) || !koksma_light_selection_name(o->lights) ||
        !o->integrator || !o->filter) {
        return koksma__fail(KOKSMA_ARGUMENT,
                            "the options lack a pairing, scope, light selection, integrator or filter");
    }
    if (o->depth < -1 || o->depth > KOKSMA_MAX_DEPTH) {
        return koksma__fail(KOKSMA_ARGUMENT, "depth = %d: bounces are 0 to %d", o->depth, KOKSMA_MAX_DEPTH);
    }
    if (o->scope == KOKSMA_SCOPE_IMAGE && !o->splat && strcmp(o->filter->name, "box") != 0) {
        return koksma__fail(
            KOKSMA_ARGUMENT,
            "filter %s with scope image: the samples lie where the pattern has them, so it takes splatting",
            o->filter->name);
    }
    return KOKSMA_OK;
}

koksma_status koksma__frame_open(const koksma_scene *scene, const koksma_render_options *options,
                                 const koksma_run *run, koksma__frame *out)
{
    *out = (koksma__frame){.scene = scene, .options = options};
    const koksma_status status = check(options);
    if (status) {
        return status;
    }
    out->rules = options->integrator->rules;
    out->depth = options->depth < 0 ? options->integrator->depth : options->depth;
    out->channels = scene->grey ? 1 : 3;
    out->batch = koksma__batch();
    return make_frame(out, run);
}

static koksma_status render(const koksma_scene *scene, const koksma_render_options *options, const koksma_run *run,
                            bool all_layers, koksma_layers *out)
{
    koksma__frame f;
    job j = {.frame = &f, .end_row = options->height};
    *out = (koksma_layers){0};
    koksma_status status = koksma__frame_open(scene, options, run, &f);
    status = status ? status : render_image(&j, run, all_layers, out);
    koksma__frame_close(&f);
    if (status && status != KOKSMA_INTERRUPTED) {
        koksma_layers_fini(out);
        *out = (koksma_layers){0};
    }
    return status;
}

koksma_status koksma_render_layers(const koksma_scene *scene, const koksma_render_options *options,
                                   const koksma_run *run, koksma_layers *out)
{
    return render(scene, options, run, true, out);
}

koksma_status koksma_render_only(const koksma_scene *scene, const koksma_render_options *options,
                                 const koksma_run *run, koksma_layers *out)
{
    return render(scene, options, run, false, out);
}

koksma_status koksma_render(const koksma_scene *scene, const koksma_render_options *options, const koksma_run *run,
                            koksma_image *out)
{
    koksma_layers layers;
    const koksma_status status = render(scene, options, run, false, &layers);
    *out = (koksma_image){0};
    if (!status) {
        *out = layers.image;
        layers.image = (koksma_image){0};
    }
    koksma_layers_fini(&layers);
    return status;
}

bool koksma__rows_stand_alone(const koksma_render_options *options)
{
    const koksma__rules *rules = options->integrator->rules;
    return options->scope == KOKSMA_SCOPE_PIXEL && !options->splat && !rules->open;
}

koksma_status koksma__render_rows(const koksma_scene *scene, const koksma_render_options *options, int first_row,
                                  int rows, const koksma_run *run, koksma_image *out)
{
    koksma__frame f;
    koksma_layers layers = {0};
    job j = {.frame = &f, .first_row = first_row, .end_row = first_row + rows};
    koksma_status status = koksma__frame_open(scene, options, run, &f);
    status = status ? status : render_image(&j, run, false, &layers);
    *out = (koksma_image){0};
    status = status ? status : koksma_image_init(out, options->width, rows, layers.image.channels);
    if (!status) {
        const size_t row = (size_t)options->width * (size_t)layers.image.channels;
        memcpy(out->pixels, layers.image.pixels + (size_t)first_row * row, (size_t)rows * row * sizeof *out->pixels);
    }
    koksma__frame_close(&f);
    koksma_layers_fini(&layers);
    return status;
}
