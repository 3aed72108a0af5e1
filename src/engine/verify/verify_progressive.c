/* SPDX-License-Identifier: Apache-2.0 */
/*
 * progressive: whether the points can be used progressively, in their order, a few at first and more later. The value
 * is the largest ratio, over the prefixes of 2^j >= 16 points, of the prefix's L2 star discrepancy to its root mean
 * square for as many random points, sqrt((2^-d - 3^-d) / n). The longest prefix is one that takes about a second:
 * 2^22 points in the plane, 2^18 in three dimensions, 2^12 in four to twelve.
 */
#include <math.h>
#include <stdio.h>

#include "verify/verify.h"

enum { PREFIX_LEAST = 16, PREFIX_MOST_DIM = 12 };

/* The number of points of the longest prefix that can be measured in about a second. */
static size_t longest_prefix(const koksma_points *points)
{
    const size_t most = points->dim <= 2 ? (size_t)1 << 22 : points->dim == 3 ? (size_t)1 << 18 : (size_t)1 << 12;
    size_t n = PREFIX_LEAST;
    while (n <= points->n / 2 && n < most) {
        n *= 2;
    }
    return n;
}

static koksma_status look(koksma__verification *v)
{
    const koksma_points *points = v->points;
    size_t worst = 0;
    double value = 0;
    koksma_spec l2_star;
    koksma_status status = koksma_measure_spec("l2-star", &l2_star);
    const size_t last = longest_prefix(points);
    for (size_t n = PREFIX_LEAST; n <= points->n && n <= last && points->dim <= PREFIX_MOST_DIM && !status; n *= 2) {
        const koksma_points prefix = {n, points->dim, points->xs};
        const double random = (pow(2, -points->dim) - pow(3, -points->dim)) / (double)n;
        koksma_value found;
        status = koksma_evaluate(&l2_star, &prefix, v->run, &found);
        const double ratio = status ? 0 : found.value / sqrt(random);
        if (ratio > value) {
            value = ratio;
            worst = n;
        }
    }
    if (status || worst == 0) {
        return status;
    }
    return koksma__add_finding(v, "-", value, value <= 2, "the worst of the prefixes up to %zu points has %zu", last,
                               worst);
}

const koksma__property koksma__property_progressive = {
    .public = {.name = "progressive",
               .meaning =
                   "prefixes have at most twice the L2 star discrepancy of random points; value: the largest ratio"},
    .look = look,
};
