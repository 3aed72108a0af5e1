/* SPDX-License-Identifier: Apache-2.0 */
/* The paths of a task, their memory and their samples, which wavefront.c (paths) and wavefront_lights.c (light at
   vertices) share. */
#ifndef KOKSMA_RENDER_PIPELINES_WAVEFRONT_SCRATCH_H
#define KOKSMA_RENDER_PIPELINES_WAVEFRONT_SCRATCH_H

#include "core/status.h"
#include "render/frame.h"
#include "render/pipelines/vertices.h"

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
    int bounce, first; /* `first` is the bounce at which the paths started: 0 for paths from the eye */
} koksma__trace;

koksma_status koksma__wavefront_open(const koksma__frame *frame, size_t capacity, void **out);
void koksma__wavefront_close(void *opened);

/* Ensures that the queue has capacity for one more block of paths. Errors: MEMORY. */
koksma_status koksma__wavefront_reserve(koksma__queue *queue);

static inline koksma_status koksma__wavefront_push(koksma__queue *queue, const koksma__path *path)
{
    KOKSMA__TRY(koksma__wavefront_reserve(queue));
    koksma__paths *to = &queue->blocks[queue->n / KOKSMA__BLOCK];
    const size_t i = queue->n++ % KOKSMA__BLOCK;
    to->rays.ox[i] = path->o[0];
    to->rays.oy[i] = path->o[1];
    to->rays.oz[i] = path->o[2];
    to->rays.dx[i] = path->d[0];
    to->rays.dy[i] = path->d[1];
    to->rays.dz[i] = path->d[2];
    to->rays.time[i] = path->time;
    for (int k = 0; k < 3; k++) {
        to->beta[k][i] = path->beta[k];
        to->n[k][i] = path->n[k];
    }
    to->pdf[i] = path->pdf;
    to->from[i] = path->from;
    to->sample[i] = path->sample;
    return KOKSMA_OK;
}

/* Returns the pairs of a use; pair i is for sample i. The pairs are drawn when a path first needs the use, for the
   pixels that have a path at this bounce. Errors: the sampler's, ARGUMENT (too many pairs), MEMORY. */
koksma_status koksma__wavefront_draw(const koksma__trace *trace, uint32_t use, const float **pairs);

#endif
