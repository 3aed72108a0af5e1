/* SPDX-License-Identifier: Apache-2.0 */
/*
 * disk-sampled: l2-disk by Monte Carlo, as the second paper does it: the root mean square of the difference between
 * the share of points and the area over `disks` random disks on the torus.
 *
 * Formula: square = mean of (#{x_i within r_m of c_m}/n - pi r_m^2)^2 over m < disks, c_m uniform on the torus, r_m
 * by its law; value = sqrt(square), whose standard error is that of the mean over 2 value. Source: Mitchell 1992,
 * section 4 (10,000 disks; the law of the radius is not stated there). Known exactly: the mean of the square is the
 * square of l2-disk with the same law and radius. Limits: the error falls as 1/sqrt(disks), and the standard error is
 * itself estimated; a set whose deviation is the same for every disk seen has a standard error of 0. Equal seeds give
 * equal disks.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/measures.h"
#include "measures/parts/sampled.h"
#include "measures/parts/torus_disks.h"

enum { BLOCK = 256, LANE_CENTRE = 16, LANE_RADIUS = 17 };

typedef struct sample {
    koksma__torus_cells points;
    koksma__disk_law law;
    double r;
    uint64_t seed;
    size_t disks;
    double *squares; /* a disk each */
} sample;

static double radius(const sample *s, size_t index)
{
    double pair[2];
    koksma__random_pair(s->seed, KOKSMA__PURPOSE_SEARCH, index, LANE_RADIUS, pair);
    return s->law == KOKSMA__DISK_FIXED ? s->r : s->r * (s->law == KOKSMA__DISK_RADIUS ? pair[0] : sqrt(pair[0]));
}

static koksma_status block(void *context, size_t index)
{
    sample *s = context;
    for (size_t m = index * BLOCK; m < s->disks && m < (index + 1) * BLOCK; m++) {
        double centre[2];
        koksma__random_pair(s->seed, KOKSMA__PURPOSE_SEARCH, m, LANE_CENTRE, centre);
        const double r = radius(s, m);
        const size_t inside =
            koksma__kernels()->disk_count(r, centre[0], centre[1], s->points.n, s->points.xs, s->points.ys);
        const double delta = (double)inside / (double)s->points.n - M_PI * r * r;
        s->squares[m] = delta * delta;
    }
    return KOKSMA_OK;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    sample s = {.law = (koksma__disk_law)(int)args->params[0], .disks = (size_t)args->params[2]};
    s.r = koksma__disk_radius(s.law, args->params[1]);
    s.seed = (uint64_t)args->params[3];
    koksma_status status = koksma__torus_cells_init(&s.points, points, 1);
    s.squares = malloc(s.disks * sizeof *s.squares);
    if (!status && !s.squares) {
        status = koksma__fail_memory(s.disks * sizeof *s.squares);
    }
    if (!status) {
        status = koksma__parallel(args->run, (s.disks + BLOCK - 1) / BLOCK, block, &s);
    }
    if (!status) {
        koksma__sample_root(s.disks, s.squares, out);
    }
    free(s.squares);
    koksma__torus_cells_fini(&s.points);
    return status;
}

static const koksma_param params[] = {
    KOKSMA__DISK_PARAMS,
    {"disks", "how many random disks", 10000, 2, 1e8, NULL, true},
    {"seed", "seed of the disks", 0, 0, 0x1p53, NULL, true},
    {0},
};

const koksma_measure koksma__measure_disk_sampled = {
    .name = "disk-sampled",
    .title = "L2 discrepancy of disks on the torus, from random disks",
    .cite = "mitchell1992",
    .cost = "n * disks",
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
};
