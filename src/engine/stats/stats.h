/* SPDX-License-Identifier: Apache-2.0 */
/* Statistics: quantiles, fits of lines, means with intervals, rank correlation, resampling. What is
   marked KOKSMA__LAB is in libkoksma; the rest is in koksma-lab only. */
#ifndef KOKSMA_STATS_STATS_H
#define KOKSMA_STATS_STATS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <koksma/koksma.h>
#include <koksma/series.h>

#include "core/visibility.h"

/* ---- Quantiles of Student's t and of chi-squared, accurate to 1e-9 --------------------------------------------- */

/* Returns the quantile of Student's t: x with P(T <= x) = p, for 0.5 <= p < 1 and degrees > 0. */
KOKSMA__LAB double koksma__student_quantile(double p, double degrees);

/* Returns P(T > t) for t > 0 and degrees > 0. */
KOKSMA__LAB double koksma__student_tail(double t, double degrees);

/* Returns the quantile of chi-squared: x with P(X <= x) = p, for 0 < p < 1 and degrees > 0. */
KOKSMA__LAB double koksma__chi_squared_quantile(double p, double degrees);

/* ---- Lines by weighted least squares --------------------------------------------------------------------------- */

/* The caller passes the pairs one at a time, twice: first for the means, then for the sums about the means. A
   koksma__fit of zeros has no pairs. */
typedef struct koksma__fit {
    double weight, x, y; /* sum of the weights, weighted means of x and y */
    double xx, xy, yy;   /* weighted sums of products of deviations from the means */
} koksma__fit;

/* Adds a pair to the means; with weight 1 for all pairs, fit->weight is their number. */
KOKSMA__LAB void koksma__fit_mean(koksma__fit *fit, double x, double y, double weight);

/* Adds a pair to the sums; call it after all pairs have been added to the means. */
KOKSMA__LAB void koksma__fit_add(koksma__fit *fit, double x, double y, double weight);

/* Returns the slope xy / xx of the line y = fit->y + slope (x - fit->x), which is NaN or infinite if all x are equal.
   */
KOKSMA__LAB double koksma__fit_slope(const koksma__fit *fit);

/* An estimate with its 95 % interval. */
typedef struct koksma__estimate {
    double value, low, high;
} koksma__estimate;

/* Returns the x at which the power law of the line's slope through (x, y) reaches `target`, with the interval that
   follows from the slope's. NaN unless y and target are above 0 and the slope below; if the slope may be 0, an end is
   infinite, or 0. */
KOKSMA__LAB koksma__estimate koksma__reach(const koksma_line *line, double x, double y, double target);

/* Returns the standard error of the slope of log means[i] against log sizes[i] from the spread of two or more trials.
   log_errors: NULL, or the standard errors of the log means[i], whose correlations then come from the trials. Means
   that are not positive and finite are left out. */
KOKSMA__LAB double koksma__joint_error(const koksma_joint *joint, size_t n, const double *sizes, const double *means,
                                       const double *log_errors);

/* ---- Mean squares of errors, with intervals that allow for skewed and heavy-tailed ones ------------------------ */

typedef struct koksma__mean_square {
    /* Mean square and its 95 % interval. The interval is NaN with one error, and so is the value if the centre is the
       mean; all three are NaN if an error is not finite. */
    double value, low, high;
    /* variance of a squared error divided by the square of its mean: 2 for normal errors, 5 for those of Laplace */
    double relative_variance;
    double log_error; /* standard error of log value; NaN with one error */
    bool approximate; /* whether the interval may hold less often than 93 %: the errors are too few, or too skewed or
                          heavy-tailed. False if there is no such interval, or if all errors are 0 */
} koksma__mean_square;

/* relative_variance from which the intervals of a mean square, and of a slope over several, are approximate. */
#define KOKSMA__TOO_SPREAD 4

/* Summarises the errors values[i * stride] - centre of `count` values. With the centre NaN it is the mean of the values,
   and the divisor count - 1. */
KOKSMA__LAB koksma__mean_square koksma__mean_square_of(const double *values, size_t count, size_t stride,
                                                       double centre);

/* ---- Means, standard deviations and 95 % intervals ------------------------------------------------------------- */

typedef struct koksma__summary {
    size_t n;
    double mean, sd;  /* sd: of the sample, with divisor n - 1; NaN for n = 1 */
    double low, high; /* interval of the mean by Student's t; NaN for n = 1, because one value has no spread */
    double max;
} koksma__summary;

/* Compares two values. Returns 1 if a > b, -1 if a < b, and 0 if they differ by at most 1e-12 of the larger (which
   may be rounding) or if one is NaN. */
int koksma__compare(double a, double b);

/* How reports describe the intervals of means; docs/findings/integration.md has the simulations. "%%": for printf. */
#define KOKSMA__MEAN_INTERVALS                                                                                       \
    "95 %% intervals of means by Student's t, which are approximate where values are skewed: of 8 to 128 simulated " \
    "trials they hold in 94 to 96 %% up to a skewness of 1/2, in 89 to 95 %% at 1 to 2 and in 77 to 94 %% at 3 to 6"

/* Summarises the n values values[0], values[stride], …; n = 0 gives NaN. Sums are compensated, in the order of
   the index. An sd up to 1e-12 of the largest value is rounding noise and becomes 0. */
koksma__summary koksma__summarize(const double *values, size_t n, size_t stride);

/* Like koksma__summarize, for values that can't be negative, such as errors and measures: nor can their mean, and so the
   interval begins at 0 where Student's t, whose intervals are symmetric, puts its low end below. */
koksma__summary koksma__summarize_sizes(const double *values, size_t n, size_t stride);

/* Makes the summary of a value without variance, such as the result of a deterministic pattern. */
koksma__summary koksma__exactly(double value);

/* Takes the largest value of each complete block of `block` values, and computes the mean and the sample SD of these
   maxima. The SD is NaN for fewer than two blocks. */
void koksma__largest_of(const double *values, size_t n, size_t stride, size_t block, double *mean, double *sd);

/* Computes the relative difference of means over n pairs, mean a / mean base - 1. It is 0 if both means are 0; the
   interval is NaN for n = 1. */
koksma__estimate koksma__relative_change(const double *a, const double *base, size_t n);

/* ---- How errors decrease with n -------------------------------------------------------------------------------- */

/* The slope of means against n, and whether they follow a power law. */
typedef struct koksma__trend {
    koksma__estimate slope;
    bool off_line; /* true: a test at the 1 % level rejects the hypothesis that the means lie on a line */
} koksma__trend;

/* Computes the average slope of positive means at ascending n[i] on logarithmic axes: the slope of the least-squares
   line with equal weights, which is meaningful even if the means follow a curve. The slope's interval comes from the
   standard errors of the means, by Student's t with Welch's and Satterthwaite's degrees of freedom, whether or not
   the means lie on a line. If no mean varies, or if a mean has only one trial, the interval comes from the residuals,
   with count - 2 degrees of freedom, and is NaN for two sizes. With fewer than two sizes the slope is NaN. */
koksma__trend koksma__trend_of(const double *n, const koksma__summary *mean, size_t count);

/* A pattern's mean errors at ascending numbers of samples, with standard errors. */
typedef struct koksma__convergence {
    const double *n, *mean, *error;
    size_t count;
} koksma__convergence;

/* Returns the number of samples with which the pattern reaches the error `target` (with standard error target_error).
   It interpolates in log n and log error between the two nearest sizes, or extrapolates from the first or last two
   and sets *outside. The result is NaN if the error does not decrease between these sizes. */
koksma__estimate koksma__samples_for(const koksma__convergence *pattern, double target, double target_error,
                                     bool *outside);

/* ---- Rank correlation ------------------------------------------------------------------------------------------ */

/* Spearman's rho, which is Pearson's correlation of the mean ranks. Values that koksma__compare finds equal are ties. NaN
   when x or y is constant. */
double koksma__spearman(const double *x, const double *y, size_t n);

/* The least rho of n pairs without ties that chance reaches with probability alpha at most, one-sided: up to ten pairs by
   the number of orders with each sum of squared differences of ranks, beyond by Student's t = rho sqrt((n - 2) /
   (1 - rho^2)) with n - 2 degrees of freedom. NaN: chance reaches 1 more often than that. */
double koksma__spearman_limit(size_t n, double alpha);

/* ---- Resamples: bootstrap intervals, p-values, and several tests at once --------------------------------------- */

enum { KOKSMA__LEAST_PAIRS = 7 }; /* the fewest pairs for which an interval is computed */

/* Means with their standard errors; an error counts as 0 if it is NaN or if `error` is NULL. `seed` is the seed for
   redrawing the means. */
typedef struct koksma__means {
    const double *mean, *error;
    uint64_t seed;
} koksma__means;

/* Computes Spearman's rho and its percentile bootstrap interval (Efron 1979) over the pairs from `samples` resamples;
   resamples in which it has no value are ignored. Each resample also redraws the means from normal
   distributions with their standard errors. Random numbers are hashes: equal seeds draw the same pairs, and means
   with equal `seed` get the same deviations in units of their errors. `values` is NULL or receives the rho of
   each resample, in order, or NaN where it has no value. With n below 7 the interval is [-1, 1] and `values` is not
   set: bootstrap intervals of so few pairs exclude 0 in 8 to 13 % of cases without any correlation. If the pairs are
   in perfect order, all resamples have the same order. The interval then has width 0, although rho is not
   certain. Calls run->keep_going from time to time, always with the fraction 0; run may be NULL. Errors: MEMORY,
   INTERRUPTED. */
koksma_status koksma__bootstrap_pairs(const koksma__means *x, const koksma__means *y, size_t n, size_t samples,
                                      uint64_t seed, const koksma_run *run, double *values, koksma__estimate *out);

/* The value of a statistic; in resample s it is values[s] * factor. */
typedef struct koksma__draws {
    double value, factor;
    const double *values;
} koksma__draws;

/* Computes the difference a - b and its interval. Entry s of both arrays of values must come from the same resample,
   as koksma__bootstrap_pairs gives it for equal seeds. Errors: MEMORY. */
koksma_status koksma__bootstrap_difference(const koksma__draws *a, const koksma__draws *b, size_t samples,
                                           koksma__estimate *out);

/* Returns the two-sided p-value of the hypothesis that a quantity is 0. The resamples of the quantity are
   a * values[i] - c * b[i], or a * values[i] if b is NULL. The result is twice the fraction of resamples with the rarer
   sign, where 0 counts for both signs. It is never below 2 / (samples + 1), because 1 is added to the counts (Davison
   and Hinkley 1997). NaN are ignored; without values the result is 1. */
double koksma__resampled_p(const double *values, double a, const double *b, double c, size_t samples);

/* Replaces the p-values of n tests by Holm's (1979) adjusted ones. If all tests with an adjusted p-value up to 0.05
   are called significant, the probability that any of them is wrong is at most 5 %, for any dependence between the
   tests.
   Errors: MEMORY. */
koksma_status koksma__holm(double *p, size_t n);

#endif
