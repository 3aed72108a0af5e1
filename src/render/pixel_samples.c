/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Distribution ray tracing needs a point in as many dimensions as there are uses. Cook (1986) and Shirley (1991,
 * section 5.5.4) build it from 2D sets, one a use, whose strata are matched by random permutations ("uncorrelated
 * jitter"): each use alone is as well spread as its pattern, and no use knows of another.
 */
#include "render/pixel_samples.h"

#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { LANE_PAIRING = 1 << 20 }; /* above the uses: keys of the permutations' random numbers */

static koksma_status generate(const koksma_render_options *options, uint64_t seed, double *xs)
{
    static const koksma_run alone = {.threads = 1};
    koksma_points points = {(size_t)options->spp, 2, xs};
    return koksma_generate(&options->pattern, seed, &alone, &points);
}

koksma_status koksma__pixel_samples_init(koksma__pixel_samples *samples, const koksma_render_options *options)
{
    *samples = (koksma__pixel_samples){.options = options, .batch = koksma__batch()};
    const unsigned claims = options->pattern.pattern->claims;
    samples->shuffles = options->pairing == KOKSMA_PAIRING_SHUFFLED && !(claims & KOKSMA_CLAIM_EXCHANGEABLE);
    samples->fixed = malloc(2 * (size_t)options->spp * sizeof *samples->fixed);
    if (!samples->fixed) {
        return koksma__fail_memory(2 * (size_t)options->spp * sizeof *samples->fixed);
    }
    const koksma_status status = generate(options, options->seed, samples->fixed);
    if (status || options->pattern.shift || !(claims & KOKSMA_CLAIM_DETERMINISTIC)) {
        koksma__pixel_samples_fini(samples);
    }
    return status;
}

void koksma__pixel_samples_fini(koksma__pixel_samples *samples)
{
    free(samples->fixed);
    samples->fixed = NULL;
}

koksma_status koksma__sample_room_init(koksma__sample_room *room, int spp)
{
    const size_t n = (size_t)spp;
    *room = (koksma__sample_room){
        .xs = malloc(2 * n * sizeof *room->xs),
        .pairs = malloc(2 * n * sizeof *room->pairs),
        .words = malloc((n + 3) * sizeof *room->words),
    };
    if (!room->xs || !room->pairs || !room->words) {
        koksma__sample_room_fini(room);
        return koksma__fail_memory(28 * n);
    }
    return KOKSMA_OK;
}

void koksma__sample_room_fini(koksma__sample_room *room)
{
    free(room->xs);
    free(room->pairs);
    free(room->words);
    *room = (koksma__sample_room){0};
}

koksma_status koksma__pixel_samples_draw(const koksma__pixel_samples *samples, uint64_t pixel, uint32_t use,
                                         const float offset[2], koksma__sample_room *room, float *pairs)
{
    const koksma_render_options *options = samples->options;
    const size_t n = (size_t)options->spp;
    const double *xs = samples->fixed;
    if (!xs) {
        const koksma_status status = generate(options, koksma__random_seed(options->seed, pixel, use), room->xs);
        if (status) {
            return status;
        }
        xs = room->xs;
    }
    if (use == KOKSMA__USE_PIXEL || !samples->shuffles) {
        samples->batch->place(xs, n, offset, pairs);
        return KOKSMA_OK;
    }
    samples->batch->place(xs, n, offset, room->pairs);
    koksma__kernels()->words(options->seed, KOKSMA__PURPOSE_SHUFFLE, pixel * ((n + 3) / 4), LANE_PAIRING + use,
                             (n + 3) / 4, room->words);
    samples->batch->shuffle(room->pairs, room->words, n, pairs);
    return KOKSMA_OK;
}
