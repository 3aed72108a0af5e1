/* SPDX-License-Identifier: Apache-2.0 */
/*
 * disk-sampled: an estimate of l2-disk from random disks, with the method of Mitchell 1992.
 *
 * Formula: the root of the mean, over `disks` random disks on the torus, of (#{x_i in the disk}/n - area)^2; its
 * standard error is the standard error of the mean of the squares, divided by twice the value.
 * Source: Mitchell 1992, section 4.
 * Known exactly: the expectation of the squared value is l2-disk squared.
 * Limits: the value is random; equal seeds give equal bits.
 * In 3 dimensions balls replace the disks.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/disk/disk.h"
#include "measures/measures.h"
#include "measures/shared/shared.h"

enum { DISKS_PER_BLOCK = 256 };

typedef struct job {
    const koksma_points *points;
    koksma__disk_law law;
    double r, *squares;
    uint64_t seed;
    size_t disks;
} job;

static koksma_status sample_block(void *context, size_t block)
{
    const job *j = context;
    const size_t n = j->points->n, dim = (size_t)j->points->dim, first = block * DISKS_PER_BLOCK;
    for (size_t d = first; d < j->disks && d < first + DISKS_PER_BLOCK; d++) {
        double centre[3], r2, inside = 0;
        koksma__random_disk(j->law, j->r, j->seed, d, (int)dim, centre, &r2);
        for (size_t i = 0; i < n; i++) {
            double distance2 = 0;
            for (size_t k = 0; k < dim; k++) {
                const double way = fabs(j->points->xs[dim * i + k] - centre[k]), near = way < 1 - way ? way : 1 - way;
                distance2 += near * near;
            }
            inside += distance2 <= r2 ? 1.0 : 0.0;
        }
        const double deviation = inside / (double)n - (dim == 3 ? 4 * M_PI / 3 * r2 * sqrt(r2) : M_PI * r2);
        j->squares[d] = deviation * deviation;
    }
    return KOKSMA_OK;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const size_t disks = (size_t)args->params[0];
    job j = {.points = points, .law = (koksma__disk_law)args->params[2], .seed = (uint64_t)args->params[3]};
    j.r = koksma__disk_radius(j.law, args->params[1]);
    j.disks = disks;
    j.squares = malloc(disks * sizeof *j.squares);
    KOKSMA__REQUIRE_MEMORY(j.squares, disks * sizeof *j.squares);
    const koksma_status status =
        koksma__parallel(args->run, (disks + DISKS_PER_BLOCK - 1) / DISKS_PER_BLOCK, sample_block, &j);
    if (!status) {
        koksma__sampled_root(j.squares, disks, out);
    }
    free(j.squares);
    return status;
}

static const koksma_param params[] = {
    {"disks", "number of random disks (in 3D: balls)", 10000, 1, 1e8, NULL, true},
    {"r", "radius of the disks, or the largest radius if it is random; 0: 1/4 if fixed, else 1/2", 0, 0, 0.5, NULL,
     false},
    {"law", "law of the radius: fixed, uniform, or such that the area (volume) is uniform", 0, 0, 2,
     koksma__disk_laws, true},
    {"seed", "seed of the disks", 1, 0, 9007199254740992.0, NULL, true},
    {0},
};

const koksma_measure koksma__measure_disk_sampled = {
    .name = "disk-sampled",
    .title = "L2 discrepancy of disks or balls on the torus (root mean square), estimated from random ones",
    .cite = "mitchell1992",
    .revision = 1, /* own elementary functions */
    .cost = "disks n",
    .family = KOKSMA_FAMILY_DISKS,
    .min_dim = 2,
    .max_dim = 3,
    .params = params,
    .eval = eval,
    .answer = KOKSMA_ANSWER_SAMPLED,
};
