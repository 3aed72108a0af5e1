/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The samples of a pixel, by use. Every use has a 2D set of points of its own in every pixel: a pure function of
 * (options, pixel, use), whatever was asked for before.
 */
#ifndef KOKSMA_RENDER_PIXEL_SAMPLES_H
#define KOKSMA_RENDER_PIXEL_SAMPLES_H

#include <koksma/render.h>

#include "render/batch.h"

/* Uses. Their numbers are part of the random numbers' keys, so they never change; luminaires count up from LIGHT. */
enum { KOKSMA__USE_PIXEL = 0, KOKSMA__USE_LIGHT = 1024 };

typedef struct koksma__pixel_samples {
    const koksma_render_options *options;
    const koksma__batch_table *batch;
    double *fixed; /* the points of a deterministic pattern, made once; else NULL */
    bool shuffles;
} koksma__pixel_samples;

/* What a thread needs for drawing: room for the points of one pixel. */
typedef struct koksma__sample_room {
    double *xs;
    float *pairs;
    uint32_t *words;
} koksma__sample_room;

/* Draws one set, so that a pattern that can't serve spp says so here. Errors: the pattern's, MEMORY. */
koksma_status koksma__pixel_samples_init(koksma__pixel_samples *samples, const koksma_render_options *options);
void koksma__pixel_samples_fini(koksma__pixel_samples *samples);

koksma_status koksma__sample_room_init(koksma__sample_room *room, int spp);
void koksma__sample_room_fini(koksma__sample_room *room);

/* The spp pairs of a use of a pixel, plus offset. The use `pixel` keeps the pattern's order; the others are put into
   an independent random order, with pairing shuffled. */
koksma_status koksma__pixel_samples_draw(const koksma__pixel_samples *samples, uint64_t pixel, uint32_t use,
                                         const float offset[2], koksma__sample_room *room, float *pairs);

#endif
