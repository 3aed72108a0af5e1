/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The rendering of one image. Pixels are processed in groups that fill KOKSMA__BLOCK lanes, by one of the pipelines
 * of pipelines.def: lambert_lanes.c, fully vectorised, for grey Lambert scenes lit by rectangles; wavefront.c for all
 * scenes. A pipeline turns the samples of a group into values; film.c turns values into pixels.
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
#include "render/samples/uses.h"

typedef struct koksma__aovs koksma__aovs;

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
    void *cache;                  /* data of the integrator */
    const koksma__aovs *aovs;     /* further images, or NULL */
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
    float *parts; /* 3 numbers for each AOV of light for each sample; NULL: no AOVs */
    float *ids;   /* the number of the first object that each sample hits */
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

#endif
