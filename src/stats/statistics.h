/* SPDX-License-Identifier: Apache-2.0 */
/* The statistics of studies. Intervals are of 95 %. */
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

/* Of the one value of something that doesn't vary. */
koksma__summary koksma__exactly(double value);

/* The differences a[i] - b[i] of n pairs, 0 where they compare equal; values stride apart. */
koksma__summary koksma__paired(const double *a, const double *b, size_t n, size_t stride);

/* Mean over whole blocks of `block` values of each block's largest, and the sample SD of those; NaN without one. */
void koksma__largest_of(const double *values, size_t n, size_t stride, size_t block, double *mean, double *sd);

/* An estimate with its interval. */
typedef struct koksma__estimate {
    double value, low, high;
} koksma__estimate;

/* How much larger the mean of a is than that of base, over that of base, of n pairs: mean a / mean base - 1. 0 where
   both are 0; no interval (NaN) for n = 1. */
koksma__estimate koksma__relative_change(const double *a, const double *base, size_t n);

/* ---- Slopes -------------------------------------------------------------------------------------------- */

/* How means fall with n. */
typedef struct koksma__trend {
    koksma__estimate slope;
    bool off_line; /* the means lie off every line by more than their trials explain, surely (at 1 %) */
} koksma__trend;

/* The average slope in log-log of means above 0 at rising n[i]: that of the line of least squares, all sizes counting
   alike, which is a statement about a curve, too. Its interval is of the means' own errors, by Student's t with
   Welch's and Satterthwaite's degrees of freedom, whether the means lie on a line or not. Where no mean varies, or
   one is of one trial, how they scatter about the line is all that is known: then it is of that, with count - 2
   degrees of freedom, NaN for two sizes. Fewer sizes than two have no slope: NaN. */
koksma__trend koksma__trend_of(const double *n, const koksma__summary *mean, size_t count);

/* ---- Rank correlation ---------------------------------------------------------------------------------- */

/* Spearman's rho: Pearson's correlation of the mean ranks. Kendall's tau-b. Values that compare equal are
   ties. NaN when one side is constant. */
double koksma__spearman(const double *x, const double *y, size_t n);
double koksma__kendall(const double *x, const double *y, size_t n);

/* out: the centred mean ranks of n values over the root of their sum of squares, so that the sum of the products of
   two such lists is Spearman's rho; zeros where all values compare equal. */
void koksma__unit_ranks(const double *values, size_t n, double *out);

enum { KOKSMA__LEAST_PAIRS = 7 }; /* for an interval */

/* A statistic of the pairs (x, y), NaN when it has no value. */
typedef double (*koksma__pair_statistic)(const double *x, const double *y, size_t n);

/* Means with their standard errors (NULL, or NaN: not known, and taken for 0); seed: of the numbers that redraw them.
 */
typedef struct koksma__means {
    const double *mean, *error;
    uint64_t seed;
} koksma__means;

/* The statistic with its percentile bootstrap interval (Efron 1979) over the pairs: `samples` resamples, of which
   those without a value are left out. In each the means are redrawn, too, normal with their standard errors. Random
   numbers are keyed: equal seeds draw the same pairs, and the same noise of equal means. values: NULL, or room for
   the resamples' values, in their order, NaN: none. n below 7 gives the interval of the whole range [-1, 1] and no
   values: resamples of so few pairs exclude 0 in 8 to 13 % of cases without any correlation. Of pairs in perfect
   order all resamples are alike: the interval has no width, which says nothing. Errors: MEMORY. */
koksma_status koksma__bootstrap_pairs(const koksma__means *x, const koksma__means *y, size_t n,
                                      koksma__pair_statistic statistic, size_t samples, uint64_t seed, double *values,
                                      koksma__estimate *out);

/* A value whose resamples are values[s] factor. */
typedef struct koksma__draws {
    double value, factor;
    const double *values;
} koksma__draws;

/* The difference of two values with its interval from resamples that belong together. Errors:
   MEMORY. */
koksma_status koksma__bootstrap_difference(const koksma__draws *a, const koksma__draws *b, size_t samples,
                                           koksma__estimate *out);

/* The two-sided p of "it is 0" from resamples, values[i] a - b[i] c (b NULL: 0): twice the rarer sign's share, 0
   counting for both signs, with the +1 of Davison and Hinkley (1997): never below 2 / (samples + 1). NaN are left
   out; without values it is 1. */
double koksma__resampled_p(const double *values, double a, const double *b, double c, size_t samples);

/* ---- Several tests at once ------------------------------------------------------------------------------ */

/* Holm's (1979) adjusted p of n tests, in place: those up to 0.05 may all be called sure, and the chance that one of
   them is wrong is no more than 5 %, whatever the tests have to do with each other. Errors: MEMORY. */
koksma_status koksma__holm(double *p, size_t n);

/* ---- Equal error --------------------------------------------------------------------------------------- */

/* Mean errors of a pattern at rising sample counts, with standard errors. */
typedef struct koksma__convergence {
    const double *n, *mean, *error;
    size_t count;
} koksma__convergence;

/* How many samples of the pattern reach the error `target` (with standard error target_error), by interpolation in
   log n and log error between the two neighbouring sizes, or extrapolation from the last two by their slope: *outside
   says so. NaN when the errors don't fall there. */
koksma__estimate koksma__samples_for(const koksma__convergence *pattern, double target, double target_error,
                                     bool *outside);

#endif
