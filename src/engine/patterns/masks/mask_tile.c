/* SPDX-License-Identifier: Apache-2.0 */
/* Each pixel has its own variant of one hash-Owen-scrambled (0,2)-sequence, which three masks select (koksma/mask.h). A
   block of the parallel loop is a fixed number of points. */
#include "patterns/masks/mask_tile.h"

#include <koksma/mask.h>
#include <koksma/sampler.h>

#include "core/parallel.h"
#include "core/status.h"

enum { BLOCK = 4096, VALUE_LANE = 1 };

typedef struct filling {
    uint64_t seed;
    size_t spp, pixels;
    const uint32_t *ranks;
    koksma_points *out;
} filling;

/* Computes the values of the three masks at a pixel. */
static void values_at(const filling *f, size_t pixel, uint32_t values[KOKSMA__TILE_MASKS])
{
    uint32_t random[4];
    koksma_words(f->seed, KOKSMA_FOR_SHIFT, pixel, VALUE_LANE, random);
    for (size_t k = 0; k < KOKSMA__TILE_MASKS; k++) {
        values[k] = koksma_mask_value(f->ranks[k * f->pixels + pixel], (uint32_t)f->pixels, random[k]);
    }
}

static koksma_status fill_block(void *context, size_t block)
{
    const filling *f = context;
    const koksma_sobol sequence = koksma_sobol_of((koksma_domain){f->seed});
    const size_t end = (block + 1) * BLOCK < f->out->n ? (block + 1) * BLOCK : f->out->n;
    uint32_t values[KOKSMA__TILE_MASKS];
    values_at(f, block * BLOCK / f->spp, values);
    for (size_t i = block * BLOCK; i < end; i++) {
        if (i % f->spp == 0) {
            values_at(f, i / f->spp, values);
        }
        koksma_mask_2d(&sequence, values, (uint32_t)(i % f->spp), (uint32_t)f->spp, f->out->xs + 2 * i);
    }
    return KOKSMA_OK;
}

koksma_status koksma__tile_check(const char *pattern, size_t pixels, bool one, const koksma_points *out)
{
    KOKSMA__FAIL_IF(one && out->n != pixels, KOKSMA_N,
                    "%s: a mask of vectors has one sample in each of the %zu pixels, not n = %zu; n = %zu would do",
                    pattern, pixels, out->n, pixels);
    KOKSMA__FAIL_IF(out->n % pixels, KOKSMA_N, "%s: n = %zu is not a multiple of the %zu pixels; n = %zu would do",
                    pattern, out->n, pixels, (out->n / pixels + 1) * pixels);
    return KOKSMA_OK;
}

koksma_status koksma__tile_fill(uint64_t seed, const koksma_run *run, size_t pixels, const uint32_t *ranks,
                                koksma_points *out)
{
    filling f = {seed, out->n / pixels, pixels, ranks, out};
    return koksma__parallel(run, (out->n + BLOCK - 1) / BLOCK, fill_block, &f);
}
