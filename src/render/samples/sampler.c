/* SPDX-License-Identifier: Apache-2.0 */
/* What the samplers share: the scratch memory for drawing samples, and the conversion of points to pairs of floats. */
#include "render/samples/samples.h"

#include <stdlib.h>

#include "core/capacity.h"
#include "core/platform/system.h"
#include "core/status.h"

koksma_status koksma__sample_scratch_init(koksma__sample_scratch *room, const koksma__sampler *sampler)
{
    static const koksma_run alone = {.threads = 1};
    const size_t n = sampler->most, pixels = sampler->prepare && n && n < KOKSMA__BLOCK ? KOKSMA__BLOCK / n : 1;
    const size_t words = (pixels * (2 * n + 4 * KOKSMA__SHUFFLED) + 2 * KOKSMA__SHUFFLED) / 16 * 16;
    const size_t orders = 2 * pixels * (n < KOKSMA__ORDERED ? n : KOKSMA__ORDERED) + 2 * 64;
    const size_t kept = n * (size_t)sampler->kept_dim * sampler->kept_slots;
    *room = (koksma__sample_scratch){
        .xs = malloc((2 * n + 8) * sizeof *room->xs),
        .pairs = malloc(2 * n * sizeof *room->pairs),
        /* the words are aligned, because kernels store whole vectors */
        .words = koksma__aligned(words * sizeof *room->words),
        .order = malloc(orders * sizeof *room->order),
        .kept = malloc((kept + 1) * sizeof *room->kept),
        .kept_keys = calloc(sampler->kept_slots * sampler->kept_sets + 1, sizeof *room->kept_keys),
        .run = sampler->run ? sampler->run : &alone,
        .room_for = pixels,
    };
    if (!room->xs || !room->pairs || !room->words || !room->order || !room->kept || !room->kept_keys) {
        koksma__sample_scratch_fini(room);
        return koksma__fail_memory(24 * n + 4 * words + 2 * orders + 8 * kept);
    }
    return KOKSMA_OK;
}

void koksma__sample_scratch_fini(koksma__sample_scratch *room)
{
    koksma__aligned_free(room->words);
    KOKSMA__FREE(room->xs, room->pairs, room->order, room->kept, room->kept_keys);
    *room = (koksma__sample_scratch){0};
}

void koksma__keep_pairs(const double *xs, size_t n, int dim, int first, bool two, const uint32_t *permutation,
                        float *pairs)
{
    const float last = 1 - 0x1p-24f;
    for (size_t i = 0; i < 2 * n; i++) {
        const double *x = xs + (permutation ? permutation[i / 2] : i / 2) * (size_t)dim + first;
        const float number = i % 2 == 0 ? (float)x[0] : two ? (float)x[1] : 0;
        pairs[i] = number < last ? number : last;
    }
}
