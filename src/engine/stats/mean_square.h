/* SPDX-License-Identifier: Apache-2.0 */
/* The mean square of errors, with an interval that allows for skewed and heavy-tailed errors. */
#ifndef KOKSMA_STATS_MEAN_SQUARE_H
#define KOKSMA_STATS_MEAN_SQUARE_H

#include <stdbool.h>
#include <stddef.h>

#include "core/visibility.h"

typedef struct koksma__mean_square {
    double value, low, high; /* mean square and its 95 % interval, or NaN with one error */
    /* variance of a squared error divided by the square of its mean: 2 for normal errors, 5 for those of Laplace */
    double relative_variance;
    double log_error; /* standard error of log value; NaN with one error */
    bool approximate; /* whether the interval may hold less often than 93 %: the errors are too few, or too skewed or
                          heavy-tailed. False with one error, and if all are 0 */
} koksma__mean_square;

/* relative_variance from which the intervals of a mean square, and of a slope over several, are approximate. */
#define KOKSMA__TOO_SPREAD 4

/* Summarises the errors values[i * stride] - centre of `count` values. With the centre NaN it is the mean of the values,
   and the divisor count - 1. */
KOKSMA__LAB koksma__mean_square koksma__mean_square_of(const double *values, size_t count, size_t stride,
                                                       double centre);

#endif
