/* SPDX-License-Identifier: Apache-2.0 */
/*
 * void-and-cluster-3d: the centres of the voxels of a mask in space and time, in order of their ranks. The next voxel
 * is always the one in the largest void: the voxel at which the earlier points have the least energy.
 *
 *     x = (column + 1/2) / size, y = (row + 1/2) / size, z = (frame + 1/2) / frames of the voxel of rank i
 *     energy of a voxel = sum over set voxels of exp(-d^2 / (2 s^2)), s = 1.5 voxels, d on the torus
 *
 * Source: Ulichney 1993, in three dimensions. koksma/mask.h declares the function that makes the mask. Known: with a share
 * g of the voxels set the power has its peak at about the cube root of g cycles a voxel; a single frame is no blue
 * noise: it has half the low power of white noise (docs/findings/screen-noise.md).
 */
#include <koksma/mask.h>

#include <stdlib.h>

#include "core/status.h"
#include "patterns/patterns.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t size = (size_t)args->params[0], frames = (size_t)args->params[1], voxels = size * size * frames;
    KOKSMA__FAIL_IF(out->n > voxels, KOKSMA_N,
                    "void-and-cluster-3d: size=%zu and frames=%zu have %zu voxels, not %zu; n = %zu or less would do",
                    size, frames, voxels, out->n, voxels);
    uint32_t *ranks = malloc(voxels * sizeof *ranks);
    KOKSMA__REQUIRE_MEMORY(ranks, voxels * sizeof *ranks);
    const koksma_status status = koksma_mask_void_and_cluster_3d((int)size, (int)frames, seed, args->run, ranks);
    for (size_t p = 0; p < voxels && !status; p++) {
        if (ranks[p] < out->n) {
            double *x = out->xs + 3 * (size_t)ranks[p];
            x[0] = ((double)(p % size) + 0.5) / (double)size;
            x[1] = ((double)(p / size % size) + 0.5) / (double)size;
            x[2] = ((double)(p / size / size) + 0.5) / (double)frames;
        }
    }
    free(ranks);
    return status;
}

static const koksma_param params[] = {
    {"size", "width of the mask in pixels", 16, KOKSMA_MASK_MIN, KOKSMA_MASK_MAX_3D, NULL, true},
    {"frames", "of the mask", 8, KOKSMA_MASK_MIN, KOKSMA_MASK_MAX_3D, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_void_and_cluster_3d = {
    .name = "void-and-cluster-3d",
    .title = "the voxels of a void-and-cluster mask in space and time by rank",
    .cite = "ulichney1993",
    .min_dim = 3,
    .max_dim = 3,
    .claims = KOKSMA_CLAIM_SEQUENCE,
    .params = params,
    .generate = generate,
};
