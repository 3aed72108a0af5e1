/* SPDX-License-Identifier: Apache-2.0 */
/* Means, standard deviations and intervals (95 %) of values, and comparisons that forgive rounding. */
#ifndef KOKSMA_STATS_STATISTICS_H
#define KOKSMA_STATS_STATISTICS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <koksma/koksma.h>

typedef struct koksma__summary {
    size_t n;
    double mean, sd; /* sd: of the sample, with n - 1; NaN for n = 1 */
    double low,
        high; /* interval of the mean by Student's t; NaN for n = 1, that tells nothing of how others differ */
    double max;
} koksma__summary;

/* 1: a > b, -1: a < b, 0: they differ by no more than 1e-12 of the larger, which rounding alone may do (or one is
 * NaN). */
int koksma__compare(double a, double b);

/* Of values[0], values[stride], …, n of them; n = 0 gives NaN. Sums are compensated, in index order. An sd that is
   rounding noise, up to 1e-12 of the largest value, is 0. */
koksma__summary koksma__summarize(const double *values, size_t n, size_t stride);

/* The summary of a value that has no variance, such as the result of a deterministic pattern. */
koksma__summary koksma__exactly(double value);

/* The differences a[i] - b[i] of n pairs, 0 where they compare equal; values stride apart. */
koksma__summary koksma__paired(const double *a, const double *b, size_t n, size_t stride);

/* Mean over whole blocks of `block` values of each block's largest, and the sample SD of those; NaN without one. */
void koksma__largest_of(const double *values, size_t n, size_t stride, size_t block, double *mean, double *sd);

/* An estimate with its interval. */
typedef struct koksma__estimate {
    double value, low, high;
} koksma__estimate;

/* How many times as many trials would tell two means apart with a probability of 80 %, whose difference has an interval
   of +- half: both errors fall as trials^-1/2. */
double koksma__trials_factor(double difference, double half);

/* How much larger the mean of a is than that of base, over that of base, of n pairs: mean a / mean base - 1. 0 where
   both are 0; no interval (NaN) for n = 1. */
koksma__estimate koksma__relative_change(const double *a, const double *base, size_t n);

#endif
