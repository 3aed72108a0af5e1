/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Renders an image from its options: data that all pixels share are computed once; the image is split into tasks of
 * whole rows, whose number depends only on the image size; within a task the pipeline renders groups of pixels.
 */
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "render/one_image.h"
#include "render/pipelines/pipelines.h"
#include "render/samples/samples.h"

enum { SAMPLES_A_TASK = 1 << 15, SAMPLES_A_LOOK = 1 << 12 };

typedef struct job {
    koksma__frame *frame;
    koksma__film film;
    const koksma__pipeline *pipeline;
    int first_row, end_row; /* the rows of the image to render */
    int rows_a_task;
    size_t capacity; /* number of samples in a group */
    atomic_ullong rays;
    const koksma_run *run;
    pthread_t caller; /* the only thread that may call run->keep_going */
    size_t tasks;
    atomic_size_t tasks_done;
    atomic_bool stop;
} job;

/* ---- Groups ----------------------------------------------------------------------------------------------- */

static koksma_status render_group(job *j, size_t task, const koksma__group *group, koksma__task_scratch *r)
{
    const koksma__frame *f = j->frame;
    if (j->pipeline->is_empty && j->pipeline->is_empty(f, r->pipeline_scratch, group, &r->values)) {
        r->values.rays += group->start[group->count];
        koksma__film_fill(&j->film, group, r->values.rgb, (size_t)f->channels);
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__group_draw(f, group, KOKSMA__USE_PIXEL, true, &r->draw, r->values.film));
    if (group->start[group->count]) {
        koksma__film_place(f, group, true, &r->values);
        KOKSMA__TRY(j->pipeline->trace(f, r->pipeline_scratch, group, &r->values));
    }
    koksma__film_add(f, &j->film, task, group, &r->values);
    return KOKSMA_OK;
}

/* ---- Tasks --------------------------------------------------------------------------------------------- */

/* Calls keep_going if this is the thread that may call it; fails with INTERRUPTED once keep_going has returned false.
   Tasks call this function between groups of pixels, because a task of one row may take minutes with many samples. */
static koksma_status look(job *j)
{
    if (pthread_equal(pthread_self(), j->caller) &&
        !koksma__keep_going(j->run, (double)atomic_load(&j->tasks_done) / (double)j->tasks)) {
        atomic_store(&j->stop, true);
    }
    return atomic_load(&j->stop) ? koksma__fail_interrupted() : KOKSMA_OK;
}

/* The keep_going callback for patterns, which call it while they make a set, which may take seconds, and for
   koksma__parallel, which calls it between tasks. It returns false once the caller has ended the run, so that all
   threads stop, even within their tasks. */
static bool goes_on(void *context, double fraction)
{
    (void)fraction;
    return !look(context);
}

static koksma_status render_rows(void *context, size_t task)
{
    job *j = context;
    const koksma__frame *f = j->frame;
    const int first_row = j->first_row + (int)task * j->rows_a_task, left = j->end_row - first_row;
    const int rows = left < j->rows_a_task ? left : j->rows_a_task;
    const size_t width = (size_t)f->options->width;
    size_t samples = 0; /* samples rendered since the last call of look() */
    koksma__task_scratch r;
    koksma__group group;
    koksma_status status = koksma__task_scratch_init(f, j->pipeline, j->capacity, j->film.all_layers, &r);
    status = status ? status : koksma__film_open_task(f, &j->film, task, first_row, rows);
    for (int y = first_row; y < first_row + rows; y++) {
        const size_t end = ((size_t)y + 1) * width;
        for (size_t pixel = end - width; !status && pixel < end; pixel += group.count) {
            koksma__group_fill(f, pixel, end, &group);
            status = render_group(j, task, &group, &r);
            samples += group.start[group.count];
            if (!status && samples >= SAMPLES_A_LOOK) {
                samples = 0;
                status = look(j);
            }
        }
    }
    if (!status || status == KOKSMA_INTERRUPTED) { /* the finished part of an interrupted task is kept */
        koksma__film_close_task(f, &j->film, task);
    }
    atomic_fetch_add(&j->rays, r.values.rays);
    atomic_fetch_add(&j->tasks_done, 1);
    koksma__task_scratch_fini(&r);
    return status;
}

static koksma_status render_image(job *j, const koksma_run *run, bool all_layers, koksma_layers *out)
{
    const koksma_run inner = {.threads = 1, .keep_going = goes_on, .context = j},
                     outer = {.threads = koksma__threads(run), .keep_going = goes_on, .context = j};
    koksma__frame *f = j->frame;
    const size_t spp = (size_t)f->options->spp, width = (size_t)f->options->width;
    const size_t rows = SAMPLES_A_TASK / (width * spp);
    j->rows_a_task = rows ? (int)rows : 1;
    const size_t tasks = (size_t)((j->end_row - j->first_row + j->rows_a_task - 1) / j->rows_a_task);
    j->tasks = tasks;
    j->run = run;
    j->caller = pthread_self();
    f->sampler.run = run && run->keep_going ? &inner : NULL;
    koksma_status status = koksma__pipeline_for(f, &j->pipeline);
    j->capacity = koksma__group_capacity(f, f->sampler.most);
    const koksma_status film = koksma__film_init(f, all_layers, tasks, out, &j->film);
    status = status ? status : film;
    status = status ? status : koksma__parallel(&outer, tasks, render_rows, j);
    f->sampler.run = NULL;
    if (!status || status == KOKSMA_INTERRUPTED) {
        const koksma_status finish = koksma__film_finish(f, &j->film, !status);
        status = status ? status : finish;
    }
    out->rays = atomic_load(&j->rays);
    koksma__film_fini(&j->film);
    return status;
}

/* ---- The public functions ------------------------------------------------------------------------------ */

void koksma_render_options_init(koksma_render_options *options, const koksma_scene *scene)
{
    KOKSMA__REQUIRE_OR(, options, scene);
    *options = (koksma_render_options){
        .spp = 16,
        .width = scene->width,
        .height = scene->height,
        .lights = KOKSMA_LIGHTS_AUTO,
        .integrator = koksma_integrator_find(koksma__scene_asks_for_paths(scene) ? "path" : "distribution"),
        .depth = -1,
        .filter = koksma_filter_find("box")};
    koksma_pattern_spec("n-rooks", &options->pattern);
}

bool koksma_render_warning(const koksma_scene *scene, const koksma_render_options *options, size_t i, char *text,
                           size_t size)
{
    KOKSMA__REQUIRE_OR(false, scene, options, text);
    KOKSMA__REQUIRE_OR(false, options->integrator);
    KOKSMA__REQUIRE_OR(false, options->integrator->flags);
    return koksma__scene_warning(scene, options->integrator->flags, i, text, size);
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
    KOKSMA__REQUIRE(scene, options, out);
    KOKSMA__REQUIRE_RUN(run);
    return render(scene, options, run, true, out);
}

koksma_status koksma_render_only(const koksma_scene *scene, const koksma_render_options *options,
                                 const koksma_run *run, koksma_layers *out)
{
    KOKSMA__REQUIRE(scene, options, out);
    KOKSMA__REQUIRE_RUN(run);
    return render(scene, options, run, false, out);
}

koksma_status koksma_render(const koksma_scene *scene, const koksma_render_options *options, const koksma_run *run,
                            koksma_image *out)
{
    KOKSMA__REQUIRE(scene, options, out);
    KOKSMA__REQUIRE_RUN(run);
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
    return options->scope == KOKSMA_SCOPE_PIXEL && !options->splat;
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

/* ---- Size of a picture --------------------------------------------------------------------------------- */

koksma_render_size koksma_render_size_of(const koksma_scene *scene, const koksma_render_options *options,
                                         bool all_layers)
{
    KOKSMA__REQUIRE_OR((koksma_render_size){0}, scene, options);
    KOKSMA__REQUIRE_OR((koksma_render_size){0}, options->integrator, options->pattern.pattern);
    KOKSMA__REQUIRE_OR((koksma_render_size){0}, options->integrator->flags);
    const uint64_t pixels = (uint64_t)options->width * (uint64_t)options->height;
    const koksma__use_list uses = koksma__frame_uses(scene, options);
    const int channels = scene->grey ? 1 : 3;
    const bool image = options->scope == KOKSMA_SCOPE_IMAGE;
    return (koksma_render_size){
        .film = koksma__film_size(pixels, channels, all_layers, options->splat),
        .samples = image ? koksma__image_samples_size(options, &uses) : 0,
        .file =
            all_layers ? koksma__film_size(pixels, channels, true, false) : pixels * (size_t)channels * sizeof(float),
    };
}
