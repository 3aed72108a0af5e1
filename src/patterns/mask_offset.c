/* SPDX-License-Identifier: Apache-2.0 */
/*
 * mask-offset: the points of all pixels of a square tile, pixel after pixel: each pixel has the same spp
 * hash-Owen-scrambled points, shifted on the torus by the ranks of two void-and-cluster masks.
 *
 *     point s of pixel p = {sobol(s) + ((rank_1(p) + 1/2) / width^2, (rank_2(p) + 1/2) / width^2)},   n = width^2 spp
 *
 * Source: Georgiev & Fajardo 2016, with void-and-cluster masks (Ulichney 1993) in the place of their optimised one.
 */
#include <koksma/mask.h>
#include <koksma/sampler.h>

#include <stdlib.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/patterns.h"

enum { BLOCK = 4096 };

typedef struct filling {
    uint64_t seed;
    size_t spp, pixels;
    const uint32_t *ranks;
    koksma_points *out;
} filling;

static koksma_status fill_block(void *context, size_t block)
{
    const filling *f = context;
    const size_t end = (block + 1) * BLOCK < f->out->n ? (block + 1) * BLOCK : f->out->n;
    for (size_t i = block * BLOCK; i < end; i++) {
        double *xy = f->out->xs + 2 * i;
        koksma_sobol_2d((koksma_domain){f->seed}, (uint32_t)(i % f->spp), xy);
        for (size_t k = 0; k < 2; k++) {
            xy[k] += ((double)f->ranks[k * f->pixels + i / f->spp] + 0.5) / (double)f->pixels;
            xy[k] -= xy[k] >= 1;
        }
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t width = (size_t)args->params[0], pixels = width * width;
    if (out->n % pixels) {
        return koksma__fail(KOKSMA_N, "mask-offset: n = %zu is no multiple of the %zu pixels; n = %zu would do",
                            out->n, pixels, (out->n / pixels + 1) * pixels);
    }
    uint32_t *ranks = malloc(2 * pixels * sizeof *ranks);
    if (!ranks) {
        return koksma__fail_memory(2 * pixels * sizeof *ranks);
    }
    koksma_status status = KOKSMA_OK;
    for (size_t k = 0; k < 2 && !status; k++) {
        status = koksma_mask_void_and_cluster((int)width, koksma__random_seed(seed, k, KOKSMA__PURPOSE_SHIFT),
                                              args->run, ranks + k * pixels);
    }
    if (!status) {
        filling f = {seed, out->n / pixels, pixels, ranks, out};
        status = koksma__parallel(args->run, (out->n + BLOCK - 1) / BLOCK, fill_block, &f);
    }
    free(ranks);
    return status;
}

static const koksma_param params[] = {
    {"width", "pixels a side", 4, KOKSMA_MASK_MIN, KOKSMA_MASK_MAX, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_mask_offset = {
    .name = "mask-offset",
    .title = "one pattern, shifted in each pixel by blue-noise masks",
    .cite = "georgiev2016 ulichney1993",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};
