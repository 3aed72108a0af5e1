/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One picture in the making. Pixels go in groups that fill KOKSMA__BLOCK lanes through one of the pipelines of
 * pipelines.def: lambert_lanes.c, all in lanes, for grey Lambert scenes under rectangles; wavefront.c, for
 * everything. A pipeline turns the samples of a group into values; film.c turns values into pixels.
 */
#ifndef KOKSMA_RENDER_FRAME_H
#define KOKSMA_RENDER_FRAME_H

#include <koksma/render.h>

#include "render/accel/intersect.h"
#include "render/filters/filters.h"
#include "render/frustum_cull.h"
#include "render/integrators/integrator_flags.h"
#include "render/pipelines/vertices.h"
#include "render/samples/sampler.h"

typedef struct koksma__frame {
    const koksma_scene *scene;
    const koksma_render_options *options;
    const koksma__integrator_flags *flags;  /* of the integrator */
    koksma_light_selection light_selection; /* never AUTO */
    int depth;                              /* bounces at most */
    int channels;
    const koksma__batch_table *batch;
    koksma__geometry geometry;          /* the scene's own */
    koksma__frustum_cull *frustum_cull; /* NULL: all shapes are tried for every ray */
    koksma__use_list uses;
    koksma__sampler sampler;
    size_t together; /* samples of a group, unless one pixel has more: the pipeline's */
    koksma__batch_camera camera;
    koksma__lights lights;
    koksma__batch_material *materials;
    koksma__shading_material *shading_materials;
    koksma__lane_materials lane_materials;
    float background[3];
    koksma__filter_table *filter; /* NULL: box */
    void *cache;                  /* the integrator's own */
    koksma_scene *replaced;       /* the integrator's own scene, which `scene` is then; or NULL */
} koksma__frame;

/* Pixels first .. first + count - 1, and their samples: pixel first + p has samples start[p] .. start[p + 1] - 1. The
   pixels are of one row unless sampling is adaptive. */
enum { KOKSMA__GROUP_PIXELS = 128 }; /* at most */

typedef struct koksma__group {
    size_t first, count;
    size_t start[KOKSMA__GROUP_PIXELS + 1];
} koksma__group;

/* What the samples of a group come to. capacity floats a channel; layers are NULL when no one wants them. */
typedef struct koksma__values {
    float *film; /* positions on the film, in pixels: 2 a sample. In pixel 2^k they are multiples of 2^(k - 23) of a
                       pixel (at 65,536 of 1/256), no coarser than the directions that are made of them */
    float *weights; /* of the filter; NULL: all 1 */
    float *rgb;     /* channels a sample */
    float *albedo, *normal, *depth;
    uint64_t rays;
} koksma__values;

typedef struct koksma__pipeline {
    const char *name, *title;
    int preference; /* among those that take a picture */
    /* Whether it can render this picture. */
    bool (*takes)(const koksma__frame *frame);
    bool culls;      /* it wants frame->frustum_cull */
    size_t together; /* samples that it takes at once, if a pixel has fewer */
    /* A task's scratch. Errors: MEMORY. */
    koksma_status (*open)(const koksma__frame *frame, size_t capacity, void **scratch);
    void (*close)(void *scratch);
    /* Whether no ray of the group can meet anything, wherever in the pixels its samples are: then values has their
       colours, and nothing needs to be drawn or traced. NULL: it is never known. */
    bool (*is_empty)(const koksma__frame *frame, void *scratch, const koksma__group *group, koksma__values *values);
    /* Fills values (film and weights are there). Errors: the sampler's, MEMORY. */
    koksma_status (*trace)(const koksma__frame *frame, void *scratch, const koksma__group *group,
                           koksma__values *values);
} koksma__pipeline;

/* All that is the same for every pixel; close also after a failure. Errors: ARGUMENT, the pattern's, MEMORY,
 * INTERRUPTED.
 */
koksma_status koksma__frame_open(const koksma_scene *scene, const koksma_render_options *options,
                                 const koksma_run *run, koksma__frame *out);
void koksma__frame_close(koksma__frame *frame);

/* Which lights get shadow rays: for AUTO one where paths are followed among more than KOKSMA__FEW_LIGHTS, else all. */
enum { KOKSMA__FEW_LIGHTS = 8 };
koksma_light_selection koksma__light_selection(const koksma_scene *scene, const koksma_render_options *options);

/* What samples will be spent on. */
koksma__use_list koksma__frame_uses(const koksma_scene *scene, const koksma_render_options *options);

/* As many pixels from `first` on as have frame->together samples, one at least, none from `end` on. */
void koksma__group_fill(const koksma__frame *frame, size_t first, size_t end, koksma__group *group);

/* The pairs of a use of all samples of a group, one pixel after the other; with on_film each pixel's own position is
   added. The pairs are padded with copies to whole lanes. */
koksma_status koksma__group_draw(const koksma__frame *frame, const koksma__group *group, uint32_t use, bool on_film,
                                 koksma__sample_scratch *scratch, float *pairs);

/* What a task needs to draw its samples and to know what they come to. */
typedef struct koksma__task_scratch {
    const koksma__pipeline *pipeline;
    void *pipeline_scratch;
    koksma__sample_scratch draw;
    koksma__values values;
} koksma__task_scratch;

/* For groups of `capacity` samples; all_layers: albedo, normal and depth too. fini also after a failure. Errors:
 * MEMORY. */
koksma_status koksma__task_scratch_init(const koksma__frame *frame, const koksma__pipeline *pipeline, size_t capacity,
                                        bool all_layers, koksma__task_scratch *scratch);
void koksma__task_scratch_fini(koksma__task_scratch *scratch);

/* samples, rounded up to whole lanes */
static inline size_t koksma__whole_lanes(size_t samples)
{
    return (samples + KOKSMA__LANE_STEP - 1) / KOKSMA__LANE_STEP * KOKSMA__LANE_STEP;
}

/* The samples of the largest group, in whole lanes, if a pixel has `most`. */
static inline size_t koksma__group_capacity(const koksma__frame *frame, size_t most)
{
    return koksma__whole_lanes(most < frame->together ? frame->together : most);
}

#endif
