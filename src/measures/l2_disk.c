/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-disk: the root mean square, over disks on the unit torus with a uniform centre, of the difference between the
 * share of points in the disk and its area. The measure behind the second paper's section 4.
 *
 * Formula: (1/n^2) sum_ij sum_{k in Z^2} lens(|x_i - x_j + k|) - E(A^2), where lens is the mean area that two disks
 * at that distance share. Fixed r: 2 r^2 acos(h/r) - 2 h s, with h half the distance and s = sqrt(r^2 - h^2); r
 * uniform up to R: ((2/3) R^3 acos(h/R) - (4/3) h R s + (2/3) h^3 ln((R + s)/h))/R; area uniform: (R^4 acos(h/R) -
 * (5/3) h s^3 - h^3 s)/R^2. E(A^2) is pi^2 r^4, pi^2 R^4/5 and pi^2 R^4/3. Source: Mitchell 1992, section 4 (his
 * table 3 is of another law, which he does not give); in this form ours. Known exactly: random points, E(square) =
 * E(A (1 - A))/n: for R = 1/2 (pi/12 - pi^2/80)/n and (pi/8 - pi^2/48)/n. Limits: 2r <= 1. The terms cancel; with
 * compensated sums the square is good to about 1e-16.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "measures/measures.h"
#include "measures/parts/disk_laws.h"

enum { ROWS_PER_BLOCK = 32 };

typedef struct job {
    const koksma_points *points;
    koksma__disk_law law;
    double r;
    koksma__sum *sums;
} job;

/* Over the images on the torus that are nearer than 2r <= 1: of each coordinate at t <= 1/2 and at 1 - t. */
static double overlap(const job *j, const double *x, const double *y)
{
    const double dx = fabs(x[0] - y[0]), dy = fabs(x[1] - y[1]);
    const double near_x = dx < 0.5 ? dx : 1 - dx, near_y = dy < 0.5 ? dy : 1 - dy;
    const double xs[2] = {near_x * near_x, (1 - near_x) * (1 - near_x)};
    const double ys[2] = {near_y * near_y, (1 - near_y) * (1 - near_y)};
    const double reach = 4 * j->r * j->r;
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const double distance2 = xs[k / 2] + ys[k % 2];
        if (distance2 < reach) {
            sum += koksma__disk_overlap(j->law, j->r, distance2);
        }
    }
    return sum;
}

static koksma_status sum_rows(void *context, size_t block)
{
    const job *j = context;
    const size_t n = j->points->n, first = block * ROWS_PER_BLOCK;
    koksma__sum sum = {0};
    for (size_t i = first; i < n && i < first + ROWS_PER_BLOCK; i++) {
        koksma__sum row = {0};
        for (size_t k = 0; k < i; k++) {
            koksma__sum_add(&row, overlap(j, j->points->xs + 2 * i, j->points->xs + 2 * k));
        }
        koksma__sum_add(&sum, 2 * row.total);
        koksma__sum_add(&sum, 2 * row.lost);
        koksma__sum_add(&sum, koksma__disk_overlap(j->law, j->r, 0));
    }
    j->sums[block] = sum;
    return KOKSMA_OK;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const size_t n_blocks = (points->n + ROWS_PER_BLOCK - 1) / ROWS_PER_BLOCK;
    job j = {.points = points, .law = (koksma__disk_law)args->params[1]};
    j.r = koksma__disk_radius(j.law, args->params[0]);
    j.sums = malloc(n_blocks * sizeof *j.sums);
    if (!j.sums) {
        return koksma__fail_memory(n_blocks * sizeof *j.sums);
    }
    const koksma_status status = koksma__parallel(args->run, n_blocks, sum_rows, &j);
    koksma__sum sum = {0};
    for (size_t block = 0; block < n_blocks && !status; block++) {
        koksma__sum_add(&sum, j.sums[block].total);
        koksma__sum_add(&sum, j.sums[block].lost);
    }
    const double n = (double)points->n;
    out->square = fmax(koksma__sum_value(&sum) / n / n - koksma__disk_square(j.law, j.r), 0);
    out->value = sqrt(out->square);
    free(j.sums);
    return status;
}

static const koksma_param params[] = {
    {"r", "the radius, or the largest radius; 0: 1/4 if fixed, else 1/2", 0, 0, 0.5, NULL, false},
    {"law", "fixed radius, radius uniform, or area uniform", 0, 0, 2, koksma__disk_laws, true},
    {0},
};

const koksma_measure koksma__measure_l2_disk = {
    .name = "l2-disk",
    .title = "L2 discrepancy of disks on the torus (root mean square over disks)",
    .cite = "mitchell1992",
    .cost = "n^2",
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
};
