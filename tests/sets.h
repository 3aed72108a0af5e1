/* SPDX-License-Identifier: Apache-2.0 */
/* Random small sets that are hard on a measure: ties, repeated points, collinear points, points on the sides. */
#ifndef KOKSMA_TESTS_SETS_H
#define KOKSMA_TESTS_SETS_H

#include "core/random.h"
#include "test.h"

enum { SETS_KINDS = 6 };

/* Number `index` of the random numbers of a test, in [0,1). */
static inline double sets_unit(uint64_t seed, uint64_t index)
{
    double pair[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_TEST, index, 0, pair);
    return pair[0];
}

/* Kind 0: uniform. 1: on the lattice k/4, sides included. 2: uniform, each second point a repeat. 3: on a line (in
   3D: a diagonal one). 4: uniform, each coordinate with odds of 1/4 pushed to 0 or 1. 5: on the lattice k/8. */
static inline void sets_fill(koksma_points *points, int kind, uint64_t seed)
{
    const size_t dim = (size_t)points->dim;
    for (size_t c = 0; c < points->n * dim; c++) {
        const double u = sets_unit(seed, c), odds = sets_unit(seed, c + 1000000);
        double x = u;
        if (kind == 1 || kind == 5) {
            const double m = kind == 1 ? 4 : 8;
            x = floor(u * (m + 1)) / m;
        } else if (kind == 2 && c / dim % 2 == 1) {
            x = points->xs[c - dim];
        } else if (kind == 3 && c % dim > 0) {
            x = c % dim == 1 ? 0.5 * points->xs[c - 1] + 0.25 : points->xs[c - 2];
        } else if (kind == 3) {
            x = floor(u * 64) / 64;
        } else if (kind == 4 && odds < 0.25) {
            x = odds < 0.125 ? 0 : 1;
        }
        points->xs[c] = x;
    }
}

/* A fresh set; the test ends it with koksma_points_fini. */
static inline koksma_points sets_points(size_t n, int dim, int kind, uint64_t seed)
{
    koksma_points points;
    assert_ok(koksma_points_init(&points, n, dim));
    sets_fill(&points, kind, seed);
    return points;
}

/* The square of the distance of a and b on the torus. */
static inline double sets_torus_distance2(const double *a, const double *b, int dim)
{
    double sum = 0;
    for (int k = 0; k < dim; k++) {
        const double t = fabs(a[k] - b[k]), across = t > 0.5 ? 1 - t : t;
        sum += across * across;
    }
    return sum;
}

/* The text of a set for a failure. */
static inline void sets_print(const koksma_points *points)
{
    for (size_t i = 0; i < points->n; i++) {
        for (int k = 0; k < points->dim; k++) {
            fprintf(stderr, "%.17g%c", points->xs[i * (size_t)points->dim + (size_t)k],
                    k + 1 < points->dim ? ' ' : '\n');
        }
    }
}

/* The power of a set of the plane at a frequency, by its definition. */
static inline double sets_power(const koksma_points *p, int kx, int ky)
{
    long double c = 0, s = 0;
    for (size_t i = 0; i < p->n; i++) {
        const long double turns = (long double)kx * p->xs[2 * i] + (long double)ky * p->xs[2 * i + 1];
        c += cosl(2 * acosl(-1) * turns);
        s += sinl(2 * acosl(-1) * turns);
    }
    return (double)((c * c + s * s) / (long double)p->n);
}

#endif
