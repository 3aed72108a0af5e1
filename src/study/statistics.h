/* SPDX-License-Identifier: Apache-2.0 */
/* The statistics of studies. Intervals are of 95 %. */
#ifndef KOKSMA_STUDY_STATISTICS_H
#define KOKSMA_STUDY_STATISTICS_H

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

/* Of values[0], values[stride], …, n of them; n = 0 gives NaN. Sums are compensated, in index order. */
koksma__summary koksma__summarize(const double *values, size_t n, size_t stride);

/* Of the one value of something that doesn't vary. */
koksma__summary koksma__exactly(double value);

/* The differences a[i] - b[i] of n pairs; values stride apart. */
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

/* A line y = intercept + slope x by weighted least squares. */
typedef struct koksma__line {
    double slope, intercept;
    double slope_error;   /* standard error: the larger of what the weights say and what the residuals say */
    size_t degrees;       /* of freedom of the residuals where these say it; 0: the weights do */
    double covariance[3]; /* of (intercept, slope): variances and, last, their covariance; of the weights */
} koksma__line;

/* Points with the standard errors sigma of y (0: taken for the residuals' own). Fewer than two give NaN. */
koksma__line koksma__fit_line(const double *x, const double *y, const double *sigma, size_t n);

/* The slope with its interval by Student's t: of the residuals' degrees of freedom where these say the error, else of
   one less than `least`, the smallest number of trials behind a sigma. NaN: the points tell no error. */
koksma__estimate koksma__slope(const koksma__line *line, size_t least);

/* ---- Rank correlation ---------------------------------------------------------------------------------- */

/* Spearman's rho: Pearson's correlation of the mean ranks. Kendall's tau-b. NaN when one side is constant. */
double koksma__spearman(const double *x, const double *y, size_t n);
double koksma__kendall(const double *x, const double *y, size_t n);

enum { KOKSMA__LEAST_PAIRS = 7 }; /* for an interval */

/* A statistic of the pairs (x, y), NaN when it has no value. */
typedef double (*koksma__pair_statistic)(const double *x, const double *y, size_t n);

/* The statistic with its percentile bootstrap interval (Efron 1979) over the pairs: `samples` resamples, of which
   those without a value are left out. Random numbers are keyed by seed. n below 7 gives the interval of the whole
   range [-1, 1]: resamples of so few pairs exclude 0 in 8 to 13 % of cases without any correlation. Errors: MEMORY.
 */
koksma_status koksma__bootstrap_pairs(const double *x, const double *y, size_t n, koksma__pair_statistic statistic,
                                      size_t samples, uint64_t seed, koksma__estimate *out);

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
