/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The pipelines, which trace the samples of an image, and the choice among them (pipelines.c); and what the files of the
 * wavefront tracer share: the paths of a task, their memory and their samples.
 */
#ifndef KOKSMA_RENDER_PIPELINES_PIPELINES_H
#define KOKSMA_RENDER_PIPELINES_PIPELINES_H

#include "core/status.h"
#include "render/render.h"

/* All pipelines, terminated by NULL. */
extern const koksma__pipeline *const koksma__pipelines[];
extern const koksma__pipeline koksma__pipeline_lambert_lanes, koksma__pipeline_wavefront;

/* Chooses the pipeline for the image (wavefront accepts every image) and prepares the frame for it. Errors:
   MEMORY. */
koksma_status koksma__pipeline_for(koksma__frame *frame, const koksma__pipeline **out);

/* ---- The wavefront tracer: paths and samples (wavefront_scratch.c) ---------------------------------------------- */

/* The largest number of pairs that a task may store, over all uses: 1 GiB. */
#define KOKSMA__MAX_DRAWN ((size_t)1 << 27)

/* A path: its current ray and the weight `beta` with which light along the ray counts for the sample. */
typedef struct koksma__path {
    float o[3], d[3], beta[3];
    float n[3]; /* normal of the surface where the ray starts */
    /* sampling density of the direction: 0 if the ray comes from a mirror or the eye, -1 if it must not see lights */
    float pdf;
    float time;
    int32_t from; /* the primitive on which the ray starts, or -1 */
    uint32_t sample;
} koksma__path;

typedef struct koksma__queue {
    koksma__paths *blocks;
    size_t n, capacity; /* n is the number of paths; capacity is the number of paths for which there is memory */
} koksma__queue;

/* The sample pairs of a use. */
typedef struct koksma__drawn {
    uint32_t use;
    bool done;
    float *pairs;
} koksma__drawn;

typedef struct koksma__wavefront_scratch {
    koksma__sample_scratch draw;
    koksma__drawn *drawn;
    size_t n_drawn, capacity;
    koksma__queue queues[2];
    float *sums;                         /* light of each sample, 3 numbers per sample */
    uint8_t *pixel_of;                   /* for each sample, the index of its pixel in the group */
    bool is_alive[KOKSMA__GROUP_PIXELS]; /* for each pixel of the group, whether it has a path at this bounce */
    koksma__vertices *vertices;
    float (*estimates)[KOKSMA__BLOCK]; /* estimates of the light from each light source, for choosing one source */
} koksma__wavefront_scratch;

/* The tracing of one group at one bounce. */
typedef struct koksma__trace {
    const koksma__frame *frame;
    koksma__wavefront_scratch *scratch;
    const koksma__group *group;
    koksma__queue *next;
    int bounce;
} koksma__trace;

koksma_status koksma__wavefront_open(const koksma__frame *frame, size_t capacity, void **out);
void koksma__wavefront_close(void *opened);

/* Ensures that the queue has capacity for one more block of paths. Errors: MEMORY. */
koksma_status koksma__wavefront_reserve(koksma__queue *queue);

/* Appends a path. Errors: MEMORY. */
koksma_status koksma__wavefront_push(koksma__queue *queue, const koksma__path *path);

/* Returns the pairs of a use; pair i is for sample i. The pairs are drawn when a path first needs the use, for the
   pixels that have a path at this bounce. Errors: the sampler's, ARGUMENT (too many pairs), MEMORY. */
koksma_status koksma__wavefront_draw(const koksma__trace *trace, uint32_t use, const float **pairs);

/* ---- Direct light (wavefront_lights.c) -------------------------------------------------------------------------- */

/* Samples lights at the vertices and adds the light that the vertices reflect. */
koksma_status koksma__wavefront_light(const koksma__trace *trace, koksma__vertices *v, koksma__values *values);

/* Returns the probability that a vertex at p with normal n samples light `light`. */
float koksma__light_probability(const koksma__frame *frame, const float p[3], const float n[3], int light);

/* ---- The medium (wavefront_medium.c) ---------------------------------------------------------------------------- */

/* Samples the medium along the rays of the paths, whose hits are known; the first number of each sample's pair
   selects the distance. Multiplies the weights of the paths, and replaces hits by points of the medium: their
   material is that of the medium, their normal is 0, and their primitive is 0 until koksma__wavefront_detach. */
void koksma__wavefront_travel(const koksma__frame *frame, const float *pairs, koksma__paths *paths,
                              koksma__vertices *v);

/* Sets the primitive of points in the medium to -1, because rays from there do not start on a primitive. */
void koksma__wavefront_detach(const koksma_scene *scene, koksma__vertices *v);

/* Multiplies light by the transmittance of the medium along the shadow rays. */
void koksma__wavefront_attenuate(const koksma__frame *frame, const koksma__vertices *v,
                                 const koksma__shadows *shadows, koksma__lanes light[3]);

#endif
