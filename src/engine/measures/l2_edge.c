/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-edge: the root mean square, over random lines through the unit square, of the difference between the share of
 * points on one side of the line and the area on that side. Table 4 of Mitchell 1992 estimates it from 10,000 lines.
 *
 * Formula: points minus area is a signed measure of mass 0. With sigma(x, y) the probability that a line separates x
 * and y, L^2 = (1/n) sum_i P(x_i) - (1/2n^2) sum_ij sigma(x_i, x_j) - C/2, where P(x) = int sigma(x, y) dy over the
 * square, C = int P. For isotropic lines sigma = |x - y|/2 and C = (2 + sqrt 2 + 5 asinh 1)/30; for law=mitchell,
 * with a >= b the larger and smaller of |dx| and |dy|, sigma = ((a + b) ln(1 + b/a) + a - b)/2 and C = (8/15) ln 2 -
 * 1/9. P has a closed form (measures/edge/lines.c).
 * Source: Mitchell 1992, section 5; the formula as a sum over pairs is from Alexander 1990. In 3 dimensions planes
 * through the unit cube replace the lines, only with the isotropic distribution: sigma = |x - y|/3, and C is a third
 * of the mean distance of two points of the cube (Robbins 1978), which is .6617... (measures/edge/planes.c).
 * Known exactly: random points, E(L^2) = C/(2n). L does not depend on which side of the line is counted.
 * Limits: the terms are near 0.26 and cancel; with compensated sums the error of the square is about 1e-16.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "kernels/kernels.h"
#include "measures/edge/edge.h"
#include "measures/measures.h"

enum { ROWS_PER_BLOCK = 64 };

typedef struct job {
    koksma__line_law law;
    size_t n;
    const double *points; /* the points in 3 dimensions; NULL in 2 */
    double *x, *y;
    koksma__sum *pairs, *potentials;
} job;

/* Adds row i of the sum over pairs in 3 dimensions, and the potential of point i. */
static void add_row_of_cube(const job *j, size_t i, koksma__sum *pairs, koksma__sum *potentials)
{
    const double *p = j->points + 3 * i;
    koksma__sum row = {0};
    for (size_t k = 0; k < i; k++) {
        const double *q = j->points + 3 * k, x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
        koksma__sum_add(&row, sqrt(x * x + y * y + z * z));
    }
    koksma__sum_add(pairs, koksma__sum_value(&row) / 3);
    koksma__sum_add(potentials, koksma__plane_potential(p));
}

static void add_row(const job *j, size_t i, koksma__sum *pairs, koksma__sum *potentials)
{
    koksma__sum row = {0};
    if (j->law == KOKSMA__LINES_ISOTROPIC) {
        row.total = koksma__kernels()->distances(i, j->x, j->y, j->x[i], j->y[i]) / 2;
    }
    for (size_t k = 0; k < i && j->law == KOKSMA__LINES_MITCHELL; k++) {
        koksma__sum_add(&row, koksma__line_separates(j->law, j->x[i] - j->x[k], j->y[i] - j->y[k]));
    }
    koksma__sum_add(pairs, row.total);
    koksma__sum_add(pairs, row.lost);
    koksma__sum_add(potentials, koksma__line_potential(j->law, (double[2]){j->x[i], j->y[i]}));
}

static koksma_status sum_rows(void *context, size_t block)
{
    const job *j = context;
    const size_t first = block * ROWS_PER_BLOCK;
    for (size_t i = first; i < first + ROWS_PER_BLOCK && i < j->n; i++) {
        (j->points ? add_row_of_cube : add_row)(j, i, &j->pairs[block], &j->potentials[block]);
    }
    return KOKSMA_OK;
}

static double finish(const job *j, size_t n_blocks, double constant)
{
    const double n = (double)j->n;
    koksma__sum pairs = {0}, potentials = {0}, square = {0};
    for (size_t block = 0; block < n_blocks; block++) {
        koksma__sum_add(&pairs, j->pairs[block].total);
        koksma__sum_add(&pairs, j->pairs[block].lost);
        koksma__sum_add(&potentials, koksma__sum_value(&j->potentials[block]));
    }
    koksma__sum_add(&square, koksma__sum_value(&potentials) / n);
    koksma__sum_add(&square, -koksma__sum_value(&pairs) / n / n);
    koksma__sum_add(&square, -constant / 2);
    return koksma__not_below_0(koksma__sum_value(&square));
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const size_t n = points->n, n_blocks = (n + ROWS_PER_BLOCK - 1) / ROWS_PER_BLOCK;
    const size_t bytes = 2 * n * sizeof(double) + 2 * n_blocks * sizeof(koksma__sum);
    const bool cube = points->dim == 3;
    const koksma__line_law law = (koksma__line_law)args->params[0];
    if (cube && law != KOKSMA__LINES_ISOTROPIC) {
        return koksma__fail_law_of_plane("l2-edge");
    }
    job j = {.law = law, .n = n, .points = cube ? points->xs : NULL, .pairs = calloc(1, bytes)};
    KOKSMA__REQUIRE_MEMORY(j.pairs, bytes);
    j.potentials = j.pairs + n_blocks;
    j.x = (double *)(j.potentials + n_blocks);
    j.y = j.x + n;
    for (size_t i = 0; i < n && !cube; i++) {
        j.x[i] = points->xs[2 * i];
        j.y[i] = points->xs[2 * i + 1];
    }
    const koksma_status status = koksma__parallel(args->run, n_blocks, sum_rows, &j);
    if (!status) {
        out->square = finish(&j, n_blocks, cube ? koksma__plane_constant() : koksma__line_constant(law));
        out->value = sqrt(out->square);
    }
    free(j.pairs);
    return status;
}

/* Computes the gradient from the derivatives of sigma and P. In the sum over all i and j each pair occurs twice,
   which cancels the factor 1/2. */
static koksma_status gradient(const koksma_points *points, const koksma_args *args, double *square, double *out)
{
    const size_t dim = (size_t)points->dim;
    const double n = (double)points->n, *xs = points->xs;
    const koksma__line_law law = (koksma__line_law)args->params[0];
    koksma_value value;
    koksma_status status = eval(points, args, &value);
    const size_t asked = KOKSMA__ASKED / points->n + 1; /* points between two questions */
    *square = value.square;
    for (size_t i = 0; i < points->n && !status; i++) {
        double *own = out + i * dim, slope[3], sum[3] = {0};
        status = i % asked ? KOKSMA_OK : koksma__ask(args->run);
        for (size_t j = 0; j < points->n; j++) {
            double d[3] = {0};
            for (size_t k = 0; k < dim; k++) {
                d[k] = xs[i * dim + k] - xs[j * dim + k];
            }
            const double r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            if (dim == 2) {
                koksma__line_separates_slope(law, d[0], d[1], slope);
            }
            for (size_t k = 0; k < dim; k++) {
                sum[k] += dim == 2 ? slope[k] : r > 0 ? d[k] / r / 3 : 0;
            }
        }
        if (dim == 2) {
            koksma__line_potential_slope(law, xs + i * dim, slope);
        } else {
            koksma__plane_potential_slope(xs + i * dim, slope);
        }
        for (size_t k = 0; k < dim; k++) {
            own[k] = slope[k] / n - sum[k] / (n * n);
        }
    }
    return status;
}

static const koksma_param params[] = {
    {"law", "distribution of the lines: isotropic, or as in Mitchell 1992", 0, 0, 1, koksma__line_laws, true},
    {0},
};

const koksma_measure koksma__measure_l2_edge = {
    .name = "l2-edge",
    .title = "L2 discrepancy of half-planes or half-spaces (root mean square over random lines or planes)",
    .cite = "mitchell1992 alexander1990 robbins1978",
    .revision = 2, /* one logarithm for two rectangles */
    .cost = "n^2",
    .family = KOKSMA_FAMILY_EDGES,
    .min_dim = 2,
    .max_dim = 3,
    .params = params,
    .eval = eval,
    .gradient = gradient,
};
