/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The pipelines, which trace the samples of an image, and the choice among them (pipelines.c); and what the files of the
 * wavefront tracer share: the paths of a task, their memory and their samples.
 */
#ifndef KOKSMA_RENDER_PIPELINES_PIPELINES_H
#define KOKSMA_RENDER_PIPELINES_PIPELINES_H

#include "core/status.h"
#include "render/one_image.h"

/* All pipelines, terminated by NULL. */
extern const koksma__pipeline *const koksma__pipelines[];
extern const koksma__pipeline koksma__pipeline_lambert_lanes, koksma__pipeline_wavefront;

/* Chooses the pipeline for the image (wavefront accepts every image) and prepares the frame for it. Errors:
   MEMORY. */
koksma_status koksma__pipeline_for(koksma__frame *frame, const koksma__pipeline **out);

/* ---- The wavefront tracer: paths and samples (wavefront_scratch.c) ---------------------------------------------- */

/* The largest number of pairs that a task may store, over all uses: 1 GiB. */
#define KOKSMA__MAX_DRAWN ((size_t)1 << 27)

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

/* Returns the pairs of a use; pair i is for sample i. The pairs are drawn when a path first needs the use, for the
   pixels that have a path at this bounce. Errors: the sampler's, ARGUMENT (too many pairs), MEMORY. */
koksma_status koksma__wavefront_draw(const koksma__trace *trace, uint32_t use, const float **pairs);

/* Sets (x, y) to the pairs of a use at this bounce for the paths of the vertices; y may be NULL. */
koksma_status koksma__wavefront_pairs(const koksma__trace *trace, uint32_t use, const koksma__vertices *v, float *x,
                                      float *y);

/* ---- Direct light (wavefront_lights.c) -------------------------------------------------------------------------- */

/* Samples lights at the vertices and adds the light that the vertices reflect. */
koksma_status koksma__wavefront_light(const koksma__trace *trace, koksma__vertices *v, koksma__values *values);

/* Returns the probability that a vertex at p with normal n samples light `light`. */
float koksma__light_probability(const koksma__frame *frame, const float p[3], const float n[3], int light);

#endif
