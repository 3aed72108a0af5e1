/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A measure as a function of the number of points: statistics over sets, values for the prefixes of a sequence, the
 * slope on logarithmic axes, and proven rates of decay. Part of libkoksma.
 *
 *     size_t sizes[] = {64, 256, 1024};
 *     koksma_value values[3];
 *     koksma_tally tallies[3] = {0};
 *     for each set: koksma_evaluate_prefixes(&measure, &points, sizes, 3, NULL, values) and koksma_tally_add;
 *     koksma_log_line(3, xs, means, &line): line.slope and line.slope_error
 */
#ifndef KOKSMA_SERIES_H
#define KOKSMA_SERIES_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Running mean and variance of values (Welford 1962). A struct of zeros has no values yet. */
typedef struct koksma_tally {
    double count, mean;
    double spread; /* sum of squared deviations of the values from the mean */
    double min, max;
} koksma_tally;

/* Adds a value in O(1). */
KOKSMA_API void koksma_tally_add(koksma_tally *tally, double value);

/* Return the standard deviation of the values, the standard error of their mean, and half the length of the mean's
   95 % confidence interval (Student's t). The interval is approximate where values are skewed: in simulations of 8 to 128
   values it holds in 94 to 96 % up to a skewness of 1/2, in 89 to 95 % at 1 to 2 and in 77 to 94 % at 3 to 6. All three
   are NaN with fewer than two values. */
KOKSMA_API double koksma_tally_sd(const koksma_tally *tally);
KOKSMA_API double koksma_tally_error(const koksma_tally *tally);
KOKSMA_API double koksma_tally_interval(const koksma_tally *tally);

/* Returns the 97.5 % quantile of Student's t distribution, or NaN for 0 degrees of freedom. */
KOKSMA_API double koksma_student_975(size_t degrees);

/* The line log y = slope log x + intercept by least squares; slope_error is the standard error from the residuals. */
typedef struct koksma_line {
    size_t count; /* number of pairs used: those with x and y positive and finite */
    double slope, slope_error, intercept;
} koksma_line;

/* Fits the line to n pairs. Returns false, and sets nothing, with fewer than three usable pairs or only one x. */
KOKSMA_API bool koksma_log_line(size_t n, const double *xs, const double *ys, koksma_line *line);

enum { KOKSMA_MAX_SIZES = 64 };

/* Means and covariances over trials of a measure at several sizes (numbers of points). A struct of zeros has no
   trials yet. */
typedef struct koksma_joint {
    double count, means[KOKSMA_MAX_SIZES];
    double spread[KOKSMA_MAX_SIZES][KOKSMA_MAX_SIZES]; /* sums of products of the deviations from the means */
} koksma_joint;

/* Adds a trial in O(n^2): values[i] is the value at size i < n. All trials need the same n, at most
   KOKSMA_MAX_SIZES; with a larger n the function only sets koksma_error_text(). The sets of the trials must differ: a
   pattern with only one set (koksma_has_one_set) has one trial, else its slope would seem to be exact. */
KOKSMA_API void koksma_joint_add(koksma_joint *joint, size_t n, const double *values);

/* Fits a line to n means as koksma_log_line does. With two or more trials slope_error comes from the spread of the
   trials (infinitesimal jackknife, Efron 1982), with one trial from the residuals. Returns false in the same cases as
   koksma_log_line. */
KOKSMA_API bool koksma_joint_line(const koksma_joint *joint, size_t n, const double *sizes, const double *means,
                                  koksma_line *line);

/* Evaluates a measure of several prefixes of a point set: values[i] is the measure of the first sizes[i] points.
     sizes   n_sizes numbers, 1 to points->n, in any order
     values  receives n_sizes values
   Errors: those of koksma_evaluate; N (a size out of range). */
KOKSMA_API koksma_status koksma_evaluate_prefixes(const koksma_spec *measure, const koksma_points *points,
                                                  const size_t *sizes, size_t n_sizes, const koksma_run *run,
                                                  koksma_value *values);

/* Returns the exponent a for which a measure of the points of a pattern, with its parameters in dim dimensions, is
   proven to decrease as n^-a (up to powers of log n), or NaN if no theorem covers the claims of the pattern. */
KOKSMA_API double koksma_rate(const koksma_spec *pattern, const koksma_measure *measure, int dim);

/* Returns the largest exponent a for which some point sets make a measure decrease as n^-a (up to powers of log n),
   or NaN if it is not known. */
KOKSMA_API double koksma_best_rate(const koksma_measure *measure, int dim);

#ifdef __cplusplus
}
#endif

#endif
