/* SPDX-License-Identifier: Apache-2.0 */
/* How errors fall with n: slopes in log-log, and how many samples reach an error. */
#ifndef KOKSMA_STATS_SLOPES_H
#define KOKSMA_STATS_SLOPES_H

#include "stats/statistics.h"

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
