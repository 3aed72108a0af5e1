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

#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/patterns.h"

enum { BLOCK = 4096 };

typedef struct filling {
    uint64_t seed;
    uint32_t width;
    int levels;
    size_t spp;
    koksma_points *out;
} filling;

static koksma_status fill_block(void *context, size_t block)
{
    const filling *f = context;
    const koksma_domain domain = {f->seed};
    const size_t end = (block + 1) * BLOCK < f->out->n ? (block + 1) * BLOCK : f->out->n;
    uint32_t rank = 0;
    for (size_t i = block * BLOCK; i < end; i++) {
        const uint32_t pixel = (uint32_t)(i / f->spp);
        if (i == block * BLOCK || i % f->spp == 0) {
            rank = koksma_z_rank(domain, pixel % f->width, pixel / f->width, f->levels);
        }
        koksma_sobol_2d(domain, (uint32_t)(rank * f->spp + i % f->spp), f->out->xs + 2 * i);
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
    const size_t pixels = (size_t)width * width;
    KOKSMA__FAIL_IF(1u << levels != width, KOKSMA_ARGUMENT,
                    "z-sampler: width=%u is not a power of two; width=%u or %u would do", width, 1u << (levels - 1),
                    1u << levels);
    KOKSMA__FAIL_IF(out->n % pixels, KOKSMA_N,
                    "z-sampler: n = %zu is not a multiple of the %zu pixels; n = %zu would do", out->n, pixels,
                    (out->n / pixels + 1) * pixels);
    filling f = {seed, width, levels, out->n / pixels, out};
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
    .revision = 1,
    .generate = generate,
};
