/* SPDX-License-Identifier: Apache-2.0 */
/*
 * z-sampler: the points of all pixels of a square image, pixel after pixel. Each pixel takes a block of one
 * hash-Owen-scrambled (0,2)-sequence; the blocks are assigned along a Z-curve whose quadrants are in random order at
 * each node. The points of neighbouring pixels are evenly distributed together, so that the errors of these pixels
 * differ.
 *
 *     point s of pixel (x, y) = sequence(rank(x, y) spp + s),   n = width^2 spp
 *
 * Source: Ahmed & Wonka 2020. If spp = 2^k, the points of each pixel are a (0,k,2)-net in base 2, and all points
 * together are a (0,m,2)-net with 2^m = n.
 */
#include <koksma/sampler.h>

#include <inttypes.h>

#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/patterns.h"

enum { BLOCK = 4096 };

typedef struct filling {
    uint64_t seed;
    uint32_t width;
    int levels;
    uint64_t spp, first; /* first: number of the first of the points */
    koksma_points *out;
} filling;

static koksma_status fill_block(void *context, size_t block)
{
    const filling *f = context;
    const koksma_domain domain = {f->seed};
    const size_t end = (block + 1) * BLOCK < f->out->n ? (block + 1) * BLOCK : f->out->n;
    uint32_t rank = 0;
    for (size_t i = block * BLOCK; i < end; i++) {
        const uint64_t s = (f->first + i) % f->spp;
        if (i == block * BLOCK || s == 0) {
            const uint32_t pixel = (uint32_t)((f->first + i) / f->spp);
            rank = koksma_z_rank(domain, pixel % f->width, pixel / f->width, f->levels);
        }
        koksma_sobol_2d(domain, (uint32_t)(rank * f->spp + s), f->out->xs + 2 * i);
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    int levels = 0;
    const uint32_t width = (uint32_t)args->params[0];
    while (1u << levels < width) {
        levels++;
    }
    const uint64_t pixels = (uint64_t)width * width;
    KOKSMA__FAIL_IF(1u << levels != width, KOKSMA_ARGUMENT,
                    "z-sampler: width=%u is not a power of two; width=%u or %u would do", width, 1u << (levels - 1),
                    1u << levels);
    KOKSMA__FAIL_IF(args->n % pixels, KOKSMA_N,
                    "z-sampler: n = %" PRIu64 " is not a multiple of the %" PRIu64 " pixels; n = %" PRIu64
                    " would do",
                    args->n, pixels, (args->n / pixels + 1) * pixels);
    KOKSMA__FAIL_IF((args->n - 1) >> 32, KOKSMA_N, "z-sampler: n = %" PRIu64 ": the maximum is 2^32 points", args->n);
    filling f = {seed, width, levels, args->n / pixels, args->first, out};
    return koksma__parallel(args->run, (out->n + BLOCK - 1) / BLOCK, fill_block, &f);
}

static const koksma_param params[] = {
    {"width", "width of the image in pixels, a power of two", 4, 1, 8192, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_z_sampler = {
    .name = "z-sampler",
    .title = "one (0,2)-sequence that is distributed over the pixels of an image along a Z-curve",
    .cite = "ahmed2020",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_NET2 | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .revision = 2, /* of 1 the renderer gave each pixel a whole image */
    .ranges = koksma__ranges_always,
    .generate = generate,
};
