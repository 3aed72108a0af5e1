/* SPDX-License-Identifier: Apache-2.0 */
/*
 * ranking-keys: the points of all pixels of a square image, pixel after pixel. The pixels of a cell of 32 x 32 share one
 * Owen-scrambled (0,2)-sequence; the key of a pixel, optimised so that the errors of neighbouring pixels cancel,
 * selects the pixel's block of the sequence and the order of the points in the block.
 *
 *     point s of pixel (x, y), pair of dimensions k = koksma_keys_2d(koksma_keys_of(seed, x, y, k, spp), s)
 *
 * With dims=4 a key covers four coordinates, koksma_keys_4d, of one Owen-scrambled Sobol' sequence; with 1, 3 or 4 samples
 * a pixel a tile of its points repeats, moved within boxes of 1/8.
 *
 * n = width^2 spp; koksma/keys.h documents how the keys are applied. The points of one pixel have the distribution of
 * Owen-scrambled Sobol' points, but for such tiles; for spp = 2^m they are a (0,m,2)-net in base 2 in each pair of
 * dimensions, with dims=4 in the first pair of a quadruple but in tiles. Sources:
 * Heitz & others 2019 (ranking keys), Ahmed & Wonka 2020 (blocks of one sequence); the optimised permutation of the
 * blocks is new in this project.
 */
#include <koksma/keys.h>

#include <inttypes.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "patterns/patterns.h"

enum { BLOCK = 4096 };

typedef struct filling {
    uint64_t seed;
    uint64_t width, spp, first; /* first: number of the first of the points */
    int dims;                   /* coordinates of a key: 2 or 4 */
    koksma_points *out;
} filling;

static koksma_status fill_block(void *context, size_t block)
{
    const filling *f = context;
    const size_t end = (block + 1) * BLOCK < f->out->n ? (block + 1) * BLOCK : f->out->n;
    for (int k = 0; k < f->out->dim; k += f->dims) {
        const int left = f->out->dim - k;
        const size_t bytes = (size_t)(left < f->dims ? left : f->dims) * sizeof(double);
        koksma_keys keys = {.key = 0};
        for (size_t i = block * BLOCK; i < end; i++) {
            const uint64_t pixel = (f->first + i) / f->spp, s = (f->first + i) % f->spp;
            double xs[4];
            if (i == block * BLOCK || s == 0) {
                keys = (f->dims == 2 ? koksma_keys_of : koksma_keys_of_4d)(f->seed, (uint32_t)(pixel % f->width),
                                                                           (uint32_t)(pixel / f->width),
                                                                           (uint32_t)(k / f->dims), (uint32_t)f->spp);
            }
            (f->dims == 2 ? koksma_keys_2d : koksma_keys_4d)(&keys, (uint32_t)s, xs);
            memcpy(f->out->xs + i * (size_t)f->out->dim + (size_t)k, xs, bytes);
        }
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const uint64_t width = (uint64_t)args->params[0], pixels = width * width;
    KOKSMA__FAIL_IF(args->n % pixels, KOKSMA_N,
                    "ranking-keys: n = %" PRIu64 " is no multiple of the %" PRIu64 " pixels; n = %" PRIu64
                    " would do",
                    args->n, pixels, (args->n / pixels + 1) * pixels);
    KOKSMA__FAIL_IF(args->n / pixels > 1 << 22, KOKSMA_N,
                    "ranking-keys: %" PRIu64 " samples a pixel: the maximum is 2^22", args->n / pixels);
    filling f = {seed, width, args->n / pixels, args->first, args->params[1] != 0 ? 4 : 2, out};
    return koksma__parallel(args->run, (out->n + BLOCK - 1) / BLOCK, fill_block, &f);
}

static const char *const dims[] = {"2", "4", NULL};

static const koksma_param params[] = {
    {"width", "pixels a side", 4, 1, 8192, NULL, true},
    {"dims", "coordinates of a key: errors are blue whatever these couple", 0, 0, 1, dims, true},
    {0},
};

const koksma_pattern koksma__pattern_ranking_keys = {
    .name = "ranking-keys",
    .title = "blocks of one (0,2)-sequence for each cell of pixels, in an order that makes errors blue",
    .cite = "heitz2019keys ahmed2020 laine2011 burley2020",
    .min_dim = 1,
    .max_dim = 128,
    .claims = KOKSMA_CLAIM_UNBIASED | KOKSMA_CLAIM_DIMENSION_PREFIXES,
    .params = params,
    .revision = 6, /* of 1 the renderer gave each pixel a whole image */
    .ranges = koksma__ranges_always,
    .generate = generate,
};
