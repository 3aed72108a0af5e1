/* SPDX-License-Identifier: Apache-2.0 */
/*
 * void-and-cluster: the centres of a mask's pixels in order of their ranks: a progressive blue-noise set of up to
 * size^2 points. The next pixel is always the one in the largest void: the pixel at which the earlier points have the
 * least energy.
 *
 *     x = (column + 1/2) / size, y = (row + 1/2) / size of the pixel of rank i
 *     energy of a pixel = sum over set pixels of exp(-d^2 / (2 s^2)), s = 1.5 pixels, d on the torus
 *
 * Source: Ulichney 1993. koksma/mask.h declares the function that makes the mask. Known (Ulichney 1988, of blue noise):
 * with a share g of the pixels set, the peak of the power is at about sqrt(g) cycles a pixel, for g up to 1/4, and 10
 * averaged periodograms have an anisotropy of -10 dB (docs/findings/screen-noise.md).
 */
#include <koksma/mask.h>

#include <stdlib.h>

#include "core/status.h"
#include "patterns/patterns.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t size = (size_t)args->params[0], pixels = size * size;
    KOKSMA__FAIL_IF(out->n > pixels, KOKSMA_N,
                    "void-and-cluster: size=%zu has %zu pixels, not %zu; n = %zu or less would do", size, pixels,
                    out->n, pixels);
    uint32_t *ranks = malloc(pixels * sizeof *ranks);
    KOKSMA__REQUIRE_MEMORY(ranks, pixels * sizeof *ranks);
    const koksma_status status = koksma_mask_void_and_cluster((int)size, seed, args->run, ranks);
    for (size_t p = 0; p < pixels && !status; p++) {
        if (ranks[p] < out->n) {
            double *x = out->xs + 2 * (size_t)ranks[p];
            x[0] = ((double)(p % size) + 0.5) / (double)size;
            x[1] = ((double)(p / size) + 0.5) / (double)size;
        }
    }
    free(ranks);
    return status;
}

static const koksma_param params[] = {
    {"size", "width of the mask in pixels", 64, KOKSMA_MASK_MIN, KOKSMA_MASK_MAX, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_void_and_cluster = {
    .name = "void-and-cluster",
    .title = "the pixels of a void-and-cluster mask by rank",
    .cite = "ulichney1993",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_SEQUENCE,
    .params = params,
    .generate = generate,
};
