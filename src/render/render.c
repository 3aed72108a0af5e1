/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Direct light by distribution ray tracing (Cook, Porter & Carpenter 1984): a pixel is the mean over its samples (box
 * filter of one pixel) of
 *     background                                                     where the ray hits nothing,
 *     min(1, albedo (ambient + sum over luminaires of their light))  elsewhere, one shadow ray a luminaire.
 *
 * The image is cut into blocks of whole rows, whose number depends on the sizes only; inside, pixels go through the
 * pipeline in groups that fill KOKSMA__BLOCK lanes. Every pixel is summed on its own, in a fixed order.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "render/intersect.h"
#include "render/pixel_samples.h"

enum { SAMPLES_A_TASK = 1 << 15 };

typedef struct frame {
    const koksma_scene *scene;
    const koksma_render_options *options;
    const koksma__batch_table *batch;
    koksma__geometry geometry;
    koksma__pixel_samples samples;
    koksma__batch_camera camera;
    koksma__batch_light *lights;
    koksma__batch_material *materials;
    koksma_image *image;
    int rows_a_task;
    size_t group_pixels;  /* pixels that go through the pipeline together */
    size_t group_samples; /* and their samples, rounded up to whole lanes */
} frame;

/* A task's room; every array holds group_samples of its kind. */
typedef struct room {
    koksma__sample_room draw;
    float *film, *values;
    float *places; /* one array a light */
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

static koksma__batch_light make_light(const koksma__light *from)
{
    koksma__batch_light l = {.power = (float)from->power};
    for (int k = 0; k < 3; k++) {
        const double u = from->half[0] * from->axis_u[k], v = from->half[1] * from->axis_v[k];
        l.corner[k] = (float)(from->centre[k] - u - v);
        l.edge_x[k] = (float)(2 * u);
        l.edge_y[k] = (float)(2 * v);
        l.normal[k] = (float)from->normal[k];
    }
    return l;
}

static koksma__batch_material make_material(const koksma__material *from)
{
    koksma__batch_material m = {.checker = from->checker, .albedo = {(float)from->albedo[0], (float)from->albedo[1]}};
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

static koksma_status make_lists(frame *f)
{
    const koksma_scene *scene = f->scene;
    f->lights = calloc(scene->n_lights + 1, sizeof *f->lights);
    f->materials = calloc(scene->n_materials + 1, sizeof *f->materials);
    if (!f->lights || !f->materials) {
        return koksma__fail_memory((scene->n_lights + 1) * sizeof *f->lights);
    }
    for (size_t i = 0; i < scene->n_lights; i++) {
        f->lights[i] = make_light(&scene->lights[i]);
    }
    for (size_t i = 0; i < scene->n_materials; i++) {
        f->materials[i] = make_material(&scene->materials[i]);
    }
    return KOKSMA_OK;
}

/* ---- One group of pixels ------------------------------------------------------------------------------- */

/* Copies the last sample into the spare lanes. */
static void pad(float *pairs, size_t used, size_t room_for)
{
    for (size_t i = used; i < room_for; i++) {
        memcpy(pairs + 2 * i, pairs + 2 * (used - 1), 2 * sizeof *pairs);
    }
}

static koksma_status draw_use(const frame *f, uint32_t use, size_t pixel, size_t count, float *pairs, room *r)
{
    const size_t spp = (size_t)f->options->spp, width = (size_t)f->options->width;
    for (size_t p = 0; p < count; p++) {
        const bool on_film = use == KOKSMA__USE_PIXEL;
        const float offset[2] = {on_film ? (float)((pixel + p) % width) : 0, on_film ? (float)(pixel / width) : 0};
        const koksma_status status =
            koksma__pixel_samples_draw(&f->samples, pixel + p, use, offset, &r->draw, pairs + 2 * p * spp);
        if (status) {
            return status;
        }
    }
    pad(pairs, count * spp, f->group_samples);
    return KOKSMA_OK;
}

/* The samples of the luminaires are drawn when the first ray of the group hits something. */
static koksma_status draw_lights(const frame *f, size_t pixel, size_t count, room *r)
{
    koksma_status status = KOKSMA_OK;
    for (size_t l = 0; !status && l < f->scene->n_lights; l++) {
        status = draw_use(f, KOKSMA__USE_LIGHT + (uint32_t)l, pixel, count, r->places + 2 * l * f->group_samples, r);
    }
    return status;
}

/* Samples start .. start + n of the group, which hit something in `hits`. */
static void shade_block(const frame *f, const koksma__hits *hits, size_t start, int n, const room *r)
{
    KOKSMA__LANES(float, albedo);
    KOKSMA__LANES(float, sum);
    koksma__shadows shadows;
    for (int i = 0; i < n; i++) {
        sum[i] = (float)f->scene->ambient;
    }
    f->batch->albedo(f->materials, hits, n, albedo);
    for (size_t l = 0; l < f->scene->n_lights; l++) {
        const float *places = r->places + 2 * (l * f->group_samples + start);
        if (f->batch->aim(&f->lights[l], hits, places, n, &shadows)) {
            f->geometry.occlude(&f->geometry, hits, n, &shadows);
            f->batch->add(&shadows, n, sum);
        }
    }
    f->batch->shade(hits, albedo, sum, (float)f->scene->background, n, r->values + start);
}

static koksma_status render_group(const frame *f, size_t pixel, size_t count, room *r)
{
    const size_t spp = (size_t)f->options->spp;
    const size_t total = (count * spp + KOKSMA__LANE_STEP - 1) / KOKSMA__LANE_STEP * KOKSMA__LANE_STEP;
    bool drawn = false;
    koksma__rays rays;
    koksma__hits hits;
    koksma_status status = draw_use(f, KOKSMA__USE_PIXEL, pixel, count, r->film, r);
    for (size_t start = 0; !status && start < total; start += KOKSMA__BLOCK) {
        const int n = (int)(total - start < KOKSMA__BLOCK ? total - start : KOKSMA__BLOCK);
        f->batch->camera(&f->camera, r->film + 2 * start, n, &rays);
        if (!f->geometry.closest(&f->geometry, &rays, n, &hits)) {
            for (int i = 0; i < n; i++) {
                r->values[start + (size_t)i] = (float)f->scene->background;
            }
            continue;
        }
        if (!drawn) {
            status = draw_lights(f, pixel, count, r);
            drawn = true;
        }
        shade_block(f, &hits, start, n, r);
    }
    for (size_t p = 0; !status && p < count; p++) {
        f->image->pixels[pixel + p] = (float)f->batch->mean(r->values + p * spp, spp);
    }
    return status;
}

/* ---- Tasks --------------------------------------------------------------------------------------------- */

static void room_fini(room *r)
{
    koksma__sample_room_fini(&r->draw);
    free(r->film);
    free(r->values);
    free(r->places);
}

static koksma_status room_init(const frame *f, room *r)
{
    const size_t n = f->group_samples;
    *r = (room){.film = malloc(2 * n * sizeof *r->film),
                .values = malloc(n * sizeof *r->values),
                .places = malloc(2 * n * (f->scene->n_lights + 1) * sizeof *r->places)};
    koksma_status status = koksma__sample_room_init(&r->draw, f->options->spp);
    if (!status && (!r->film || !r->values || !r->places)) {
        status = koksma__fail_memory(2 * n * (f->scene->n_lights + 3) * sizeof(float));
    }
    if (status) {
        room_fini(r);
    }
    return status;
}

static koksma_status render_rows(void *context, size_t task)
{
    const frame *f = context;
    const size_t width = (size_t)f->options->width, first = task * (size_t)f->rows_a_task;
    room r;
    koksma_status status = room_init(f, &r);
    if (status) {
        return status;
    }
    for (size_t y = first; y < first + (size_t)f->rows_a_task && y < (size_t)f->options->height; y++) {
        for (size_t x = 0; !status && x < width; x += f->group_pixels) {
            const size_t count = width - x < f->group_pixels ? width - x : f->group_pixels;
            status = render_group(f, y * width + x, count, &r);
        }
    }
    room_fini(&r);
    return status;
}

static koksma_status render_image(frame *f, const koksma_run *run)
{
    const size_t spp = (size_t)f->options->spp, width = (size_t)f->options->width;
    const size_t rows = SAMPLES_A_TASK / (width * spp);
    f->rows_a_task = rows ? (int)rows : 1;
    f->group_pixels = spp < KOKSMA__BLOCK ? KOKSMA__BLOCK / spp : 1;
    f->group_samples = (f->group_pixels * spp + KOKSMA__LANE_STEP - 1) / KOKSMA__LANE_STEP * KOKSMA__LANE_STEP;
    const int tasks = (f->options->height + f->rows_a_task - 1) / f->rows_a_task;
    return koksma__parallel(run, (size_t)tasks, render_rows, f);
}

/* ---- The public functions ------------------------------------------------------------------------------ */

const char *koksma_pairing_name(koksma_pairing pairing)
{
    static const char *const names[] = {"shuffled", "aligned"};
    return (unsigned)pairing < sizeof names / sizeof *names ? names[pairing] : NULL;
}

void koksma_render_options_init(koksma_render_options *options, const koksma_scene *scene)
{
    *options = (koksma_render_options){.spp = 16, .width = scene->width, .height = scene->height};
    koksma_pattern_spec("n-rooks", &options->pattern);
}

koksma_status koksma_render(const koksma_scene *scene, const koksma_render_options *options, const koksma_run *run,
                            koksma_image *out)
{
    *out = (koksma_image){0};
    if (options->spp < 1 || options->spp > KOKSMA_MAX_SPP) {
        return koksma__fail(KOKSMA_ARGUMENT, "spp = %d: samples a pixel are 1 to %d", options->spp, KOKSMA_MAX_SPP);
    }
    if (!koksma_pairing_name(options->pairing)) {
        return koksma__fail(KOKSMA_ARGUMENT, "no pairing %d", (int)options->pairing);
    }
    frame f = {.scene = scene, .options = options, .batch = koksma__batch(), .image = out};
    koksma_status status = koksma__pixel_samples_init(&f.samples, options);
    status = status ? status : koksma_image_init(out, options->width, options->height, 1);
    status = status ? status : koksma__accel_shapes(scene, &f.geometry);
    status = status ? status : make_lists(&f);
    if (!status) {
        f.camera = make_camera(&scene->camera, options->width, options->height);
        status = render_image(&f, run);
    }
    koksma__pixel_samples_fini(&f.samples);
    if (f.geometry.release) {
        f.geometry.release(&f.geometry);
    }
    free(f.lights);
    free(f.materials);
    if (status) {
        koksma_image_fini(out);
    }
    return status;
}
