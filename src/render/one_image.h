/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The rendering of one image: the frame, which has the data that all pixels share; groups of pixels, which fill
 * KOKSMA__BLOCK lanes and are traced by one of the pipelines (pipelines/pipelines.c); and the film, which turns the
 * values of samples into pixels.
 */
#ifndef KOKSMA_RENDER_ONE_IMAGE_H
#define KOKSMA_RENDER_ONE_IMAGE_H

#include <pthread.h>

#include <koksma/render.h>

#include "render/accel/accel.h"
#include "render/culling.h"
#include "render/filters/filters.h"
#include "render/integrators/integrators.h"
#include "render/pipelines/vertices.h"
#include "render/samples/samples.h"

typedef struct koksma__frame {
    const koksma_scene *scene;
    const koksma_render_options *options;
    const koksma__integrator_flags *flags;  /* the integrator's flags */
    koksma_light_selection light_selection; /* never AUTO */
    int depth;                              /* largest number of bounces */
    int channels;
    const koksma__batch_table *batch;
    koksma__geometry geometry;          /* owned by the scene */
    koksma__frustum_cull *frustum_cull; /* NULL: every ray is tested against all shapes */
    koksma__use_list uses;
    koksma__sampler sampler;
    /* number of samples of a group that the pipeline prefers; a pixel with more samples makes a larger group */
    size_t together;
    koksma__batch_camera camera;
    /* for an orthographic camera: the ray at film position (x, y) starts at eye + origins[0] + x origins[1] + y
       origins[2] */
    float origins[3][3];
    koksma__lights lights;
    /* the materials of the scene, then that of the medium, if there is one */
    koksma__batch_material *materials;
    koksma__shading_material *shading_materials;
    koksma__lane_materials lane_materials;
    float background[3];
    koksma__filter_table *filter; /* NULL: box */
    koksma_scene *replaced;       /* the scene that the integrator made, to which `scene` then points; or NULL */
} koksma__frame;

/* A group: pixels first .. first + count - 1, where pixel first + p has samples start[p] .. start[p + 1] - 1. The
   pixels are in one row unless sampling is adaptive. */
enum { KOKSMA__GROUP_PIXELS = 128 }; /* at most */

typedef struct koksma__group {
    size_t first, count;
    size_t start[KOKSMA__GROUP_PIXELS + 1];
} koksma__group;

/* The values of the samples of a group. Arrays have as many floats for each channel as the group can have samples;
   those of unused layers are NULL. */
typedef struct koksma__values {
    /* positions on the film, in pixels: 2 for each sample. From pixel 2^k to pixel 2^(k + 1) neighbouring floats
       differ by 2^(k - 23) pixels (by 1/256 at the far edge of the widest image), and the directions computed from
       them have no finer steps */
    float *film;
    float *weights; /* weights of the filter; NULL: all weights are 1 */
    float *rgb;     /* channels a sample */
    float *albedo, *normal, *depth;
    uint64_t rays;
} koksma__values;

typedef struct koksma__pipeline {
    const char *name, *title;
    int preference; /* priority among the pipelines that can render the image */
    /* Whether the pipeline can render this image. */
    bool (*takes)(const koksma__frame *frame);
    bool culls;      /* it uses frame->frustum_cull */
    size_t together; /* preferred number of samples in a group */
    /* Allocates the scratch of a task. Errors: MEMORY. */
    koksma_status (*open)(const koksma__frame *frame, size_t capacity, void **scratch);
    void (*close)(void *scratch);
    /* Returns true if no ray of the group can hit anything, wherever its samples are within the pixels, and no filter
       or other layer needs samples. It then writes the one colour of all samples to values->rgb[0] and, if there are
       three channels, [1] and [2], and no samples need to be drawn or traced. NULL: the pipeline has no such test. */
    bool (*is_empty)(const koksma__frame *frame, void *scratch, const koksma__group *group, koksma__values *values);
    /* Traces the samples at the film positions values->film, and writes their values to the other arrays of `values`;
       the caller has set values->film and values->weights. Errors: the sampler's, MEMORY. */
    koksma_status (*trace)(const koksma__frame *frame, void *scratch, const koksma__group *group,
                           koksma__values *values);
} koksma__pipeline;

/* Computes all data that the pixels share; the caller must call koksma__frame_close even after a failure. Errors:
   ARGUMENT, the pattern's, MEMORY, INTERRUPTED. */
koksma_status koksma__frame_open(const koksma_scene *scene, const koksma_render_options *options,
                                 const koksma_run *run, koksma__frame *out);
void koksma__frame_close(koksma__frame *frame);

/* Returns the option that selects which lights get shadow rays, with AUTO replaced: by one light if the scene has
   more than KOKSMA__FEW_LIGHTS lights and paths continue from diffuse surfaces, otherwise by all lights. */
enum { KOKSMA__FEW_LIGHTS = 8 };
koksma_light_selection koksma__light_selection(const koksma_scene *scene, const koksma_render_options *options);

/* The side length of a pixel: at distance 1 for a perspective camera, at any distance for an orthographic one. */
double koksma__pixel_size(const koksma__camera *camera, int height);

/* Moves the origins of camera rays from the eye to the film positions if the camera is orthographic; does nothing for
   other cameras. */
void koksma__move_origins(const koksma__frame *frame, const float *film, int n, koksma__rays *rays);

/* The sample dimensions that the render will use. */
koksma__use_list koksma__frame_uses(const koksma_scene *scene, const koksma_render_options *options);

/* The number of samples, rounded up to a multiple of KOKSMA__LANE_STEP (batch.h), as loops over lanes need it. */
static inline size_t koksma__whole_lanes(size_t samples)
{
    return (samples + KOKSMA__LANE_STEP - 1) / KOKSMA__LANE_STEP * KOKSMA__LANE_STEP;
}

/* The number of samples in the largest group, rounded up by koksma__whole_lanes, if a pixel has at most `most`
   samples. */
static inline size_t koksma__group_capacity(const koksma__frame *frame, size_t most)
{
    return koksma__whole_lanes(most < frame->together ? frame->together : most);
}

/* ---- Groups ----------------------------------------------------------------------------------------------------- */

/* Makes a group of the pixels from `first` on and below `end`: at least one pixel, and as many as have at most
   frame->together samples in all. */
void koksma__group_fill(const koksma__frame *frame, size_t first, size_t end, koksma__group *group);

/* Draws the sample pairs of one use for all samples of a group, one pixel after the other; with on_film each pixel's
   position is added. The pairs are padded with copies up to a multiple of KOKSMA__LANE_STEP. */
koksma_status koksma__group_draw(const koksma__frame *frame, const koksma__group *group, uint32_t use, bool on_film,
                                 koksma__sample_scratch *scratch, float *pairs);

/* Scratch in which a task draws its samples and computes their values. */
typedef struct koksma__task_scratch {
    const koksma__pipeline *pipeline;
    void *pipeline_scratch;
    koksma__sample_scratch draw;
    koksma__values values;
} koksma__task_scratch;

/* Allocates memory for groups of `capacity` samples; if all_layers, also for albedo, normal and depth. The caller
   must call fini even after a failure. Errors: MEMORY. */
koksma_status koksma__task_scratch_init(const koksma__frame *frame, const koksma__pipeline *pipeline, size_t capacity,
                                        bool all_layers, koksma__task_scratch *scratch);
void koksma__task_scratch_fini(koksma__task_scratch *scratch);

/* ---- The film --------------------------------------------------------------------------------------------------- */

/* For splatting: the sums of the rows of a task and of the rows around them that the task's samples reach. Each pixel
   has the weighted sums of the channels, the sum of the weights, and, if all layers are wanted, the sums for the
   variance; all in doubles, because a pixel may get millions of samples. */
typedef struct koksma__splat {
    int first_row, rows;
    bool done;
    double *sums; /* NULL: not allocated yet, or already added to the film's sums */
} koksma__splat;

typedef struct koksma__film {
    koksma_layers *layers;
    bool all_layers; /* whether all layers are made; otherwise only the image */
    int reach;       /* distance in pixels that a splatted sample reaches beyond its own pixel; 0: no splatting */
    size_t numbers;  /* number of sums for each pixel, with splatting */
    size_t n_splats;
    koksma__splat *splats; /* one for each task; NULL: no splatting */
    double *sums;          /* the sums of the image, over the first n_merged tasks */
    size_t n_merged;
    pthread_mutex_t lock; /* guards sums, n_merged and `done` of the splats */
} koksma__film;

/* The number of sums for each pixel, with splatting. */
size_t koksma__film_numbers(int channels, bool all_layers);

/* The number of bytes that koksma__film_init allocates for the pixels, and koksma__film_finish for their weights. */
uint64_t koksma__film_size(uint64_t pixels, int channels, bool all_layers, bool splat);

/* Allocates the images. Errors: MEMORY. */
koksma_status koksma__film_init(const koksma__frame *frame, bool all_layers, size_t n_tasks, koksma_layers *layers,
                                koksma__film *out);
void koksma__film_fini(koksma__film *film);

/* Moves the samples of a group, drawn on the unit square of each pixel, to film positions that the filter selects,
   and sets their weights. Without `all`, the weight of a sample is what the filter gives for its position. With `all`,
   the group must have all samples of its pixels, and the weights of each pixel are balanced so that a constant image
   stays constant (film.c). */
void koksma__film_place(const koksma__frame *frame, const koksma__group *group, bool all, koksma__values *values);

/* Prepares the splats of a task. */
koksma_status koksma__film_open_task(const koksma__frame *frame, koksma__film *film, size_t task, int first_row,
                                     int rows);

/* Marks a task's samples as complete. */
void koksma__film_close_task(const koksma__frame *frame, koksma__film *film, size_t task);

/* Adds the samples of a group to their pixels. */
void koksma__film_add(const koksma__frame *frame, koksma__film *film, size_t task, const koksma__group *group,
                      const koksma__values *values);

/* Sets the albedo, normal and depth of a pixel from its samples first .. end - 1. */
void koksma__film_add_surface(const koksma_layers *layers, const koksma__values *values, size_t pixel, size_t first,
                              size_t end);

/* Does what koksma__film_add does, if all samples of the group have the colour rgb and the film has neither splatting
   nor layers beside the image. */
void koksma__film_fill(const koksma__film *film, const koksma__group *group, const float *rgb, size_t channels);

/* Called after all tasks have ended: adds the splats in the order of tasks. Pixels without samples are filled from
   their neighbours if the image is whole, and are 0 otherwise. Errors: MEMORY. */
koksma_status koksma__film_finish(const koksma__frame *frame, koksma__film *film, bool whole);

/* Fills pixels without samples in the order of their distance from the nearest pixel with samples; each gets the mean
   of its neighbours that are one step nearer. has: each pixel's number of samples, or sum of weights. Every pixel is
   visited once, however wide the gaps are. */
koksma_status koksma__film_fill_gaps(koksma_image *image, const float *has);

/* ---- The lens --------------------------------------------------------------------------------------------------- */

/* Maps n pairs of the unit square, n a multiple of KOKSMA__LANE_STEP, to points (x to the right, y down) on the
   camera's lens of radius 1: a disk, or a polygon if the camera has blades. */
void koksma__lens_points(const koksma__camera *camera, const koksma__batch_table *batch, const float *pairs, int n,
                         float *x, float *y);

/* ---- Warnings --------------------------------------------------------------------------------------------------- */

/* Warning i of koksma_scene_warning, of those that concern the integrator. flags: NULL for all integrators. */
bool koksma__scene_warning(const koksma_scene *scene, const koksma__integrator_flags *flags, size_t i, char *text,
                           size_t size);

/* Whether path tracing is what shows the scene: it has a medium, or its file's integrator follows paths. */
static inline bool koksma__scene_asks_for_paths(const koksma_scene *scene)
{
    return scene->paths || scene->medium.is_there;
}

/* Writes the first part of a scene that is not read; returns false if there is none. */
bool koksma__scene_unread(const koksma_scene *scene, char *text, size_t size);

/* ---- Parts of an image, for several machines -------------------------------------------------------------------- */

/* Whether each pixel can be rendered without the others. This is false if samples are splatted, if one pattern covers
   the image, or if the integrator first computes data for the whole image. */
bool koksma__rows_stand_alone(const koksma_render_options *options);

/* Renders rows first_row .. first_row + rows - 1, bit for bit as koksma_render does if rows are independent
   (koksma__rows_stand_alone). Allocates `out`, whose height is `rows`. Errors: koksma_render's. */
koksma_status koksma__render_rows(const koksma_scene *scene, const koksma_render_options *options, int first_row,
                                  int rows, const koksma_run *run, koksma_image *out);

#endif
