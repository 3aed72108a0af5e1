/* SPDX-License-Identifier: Apache-2.0 */
/* What wavefront.c (paths) and wavefront_lights.c (lights at their vertices) share with wavefront_scratch.c. */
#ifndef KOKSMA_RENDER_PIPELINES_WAVEFRONT_H
#define KOKSMA_RENDER_PIPELINES_WAVEFRONT_H

#include "core/status.h"
#include "render/frame.h"
#include "render/pipelines/vertices.h"

/* Pairs that a task may keep of all uses: 1 GiB. */
#define KOKSMA__MAX_DRAWN ((size_t)1 << 27)

/* A ray on its way, and what its light will count for its sample. */
typedef struct koksma__path {
    float o[3], d[3], beta[3];
    float n[3]; /* of the surface that it leaves */
    float pdf;  /* of its direction; 0: from a mirror, or from the eye; -1: it must not see lights */
    float time;
    int32_t from; /* the primitive that it starts on, or -1 */
    uint32_t sample;
} koksma__path;

typedef struct koksma__queue {
    koksma__paths *blocks;
    size_t n, capacity; /* paths; capacity in whole blocks */
} koksma__queue;

/* The pairs of a use. */
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
    float *sums;                         /* 3 a sample */
    uint8_t *pixel_of;                   /* of a sample: which of the group */
    bool is_alive[KOKSMA__GROUP_PIXELS]; /* pixels of the group with a path at this bounce */
    koksma__vertices *vertices;
    float (*estimates)[KOKSMA__BLOCK]; /* of each light, for choosing one */
} koksma__wavefront_scratch;

/* One group at one bounce. */
typedef struct koksma__trace {
    const koksma__frame *frame;
    koksma__wavefront_scratch *scratch;
    const koksma__group *group;
    koksma__queue *next;
    int bounce, first; /* the bounce at which paths started: 0 at the eye */
} koksma__trace;

koksma_status koksma__wavefront_open(const koksma__frame *frame, size_t capacity, void **out);
void koksma__wavefront_close(void *opened);

/* Makes room for a block of paths more. Errors: MEMORY. */
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

/* The pairs of a use: pair i is sample i's. They are drawn when a path first needs the use, in the pixels that have a
   path at this bounce. Errors: the sampler's, ARGUMENT (too many), MEMORY. */
koksma_status koksma__wavefront_draw(const koksma__trace *trace, uint32_t use, const float **pairs);

/* Follows the paths that are in the first queue, at trace->bounce, to their ends; their light is added to the sums of
   their samples. */
koksma_status koksma__wavefront_follow(koksma__trace *trace, koksma__values *values);

/* Adds what the lights give at the vertices to their light. */
koksma_status koksma__wavefront_light(const koksma__trace *trace, koksma__vertices *v, koksma__values *values);

/* The probability that light `light` is among those that a vertex at p with normal n samples. */
float koksma__light_probability(const koksma__frame *frame, const float p[3], const float n[3], int light);

#endif
