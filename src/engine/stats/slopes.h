/* SPDX-License-Identifier: Apache-2.0 */
/* Describes how errors decrease with n: slopes on logarithmic axes, and the number of samples that reaches an error.
   */
#ifndef KOKSMA_STATS_SLOPES_H
#define KOKSMA_STATS_SLOPES_H

#include "stats/statistics.h"

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

#endif
