/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The sampler provides the samples of each pixel. The sample of a use is a pure function of (options, pixel, sample,
 * bounce, use), independent of the order of requests. There are two implementations: pixel_samples.c draws a new set
 * in every pixel, and image_samples.c draws one set over the whole image.
 */
#ifndef KOKSMA_RENDER_SAMPLES_SAMPLER_H
#define KOKSMA_RENDER_SAMPLES_SAMPLER_H

#include <koksma/render.h>

#include "render/pipelines/batch.h"
#include "render/samples/uses.h"

/* The scratch memory of a thread: buffers for the points of one pixel, and a store (`kept`) for the sets that several
   uses share (those of a native pattern or of groups of uses), for all pixels that are drawn together. */
typedef struct koksma__sample_scratch {
    double *xs;
    float *pairs;
    uint32_t *words;               /* buffer for the random words of a use in `room_for` pixels */
    uint16_t *order;               /* buffers for two orders of the samples of each of these pixels */
    size_t room_for, first, count; /* `prepare` filled the buffers for the pixels first .. first + count - 1 */
    double *kept;
    uint64_t *kept_keys;   /* the key of the set in each slot; 0: none */
    const koksma_run *run; /* the sampler's `run` or, if that is NULL, a run that is never cancelled */
    size_t sets;           /* number of sets that koksma_generate made; keep_going is called at every 16th */
} koksma__sample_scratch;

typedef struct koksma__sampler {
    void *made;
    /* Any thread checks this run for cancellation while it makes a set, which may take seconds; NULL: never
       cancelled. */
    const koksma_run *run;
    size_t most; /* largest number of samples in a pixel */
    /* coordinates per sample in `kept` of the scratch: those of all groups, or of a native pattern */
    int kept_dim;
    size_t kept_sets;  /* number of groups; a native pattern counts as one group */
    size_t kept_slots; /* number of pixels whose sets fit in `kept`; a pixel has slot pixel modulo kept_slots */
    size_t (*count)(const struct koksma__sampler *sampler, uint64_t pixel);
    /* Draws the random words of a use for several pixels at once, which saves time, before `draw` is called for each
       of these pixels with the same scratch; NULL: `draw` draws the words itself. */
    void (*prepare)(const struct koksma__sampler *sampler, uint64_t first, size_t count, uint32_t use,
                    koksma__sample_scratch *room);
    /* Draws the coordinates of one use for all samples of a pixel, and adds the offset to them. pairs[2 i] and
       pairs[2 i + 1] are the two coordinates of sample i; in a one-dimensional use the second has no meaning. */
    koksma_status (*draw)(const struct koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs);
    void (*release)(struct koksma__sampler *sampler);
} koksma__sampler;

koksma_status koksma__sample_scratch_init(koksma__sample_scratch *room, const koksma__sampler *sampler);
void koksma__sample_scratch_fini(koksma__sample_scratch *room);

#endif
