/* SPDX-License-Identifier: Apache-2.0 */
/* Bootstrap intervals of statistics of pairs, such as correlations. */
#ifndef KOKSMA_STATS_BOOTSTRAP_H
#define KOKSMA_STATS_BOOTSTRAP_H

#include "stats/statistics.h"

enum { KOKSMA__LEAST_PAIRS = 7 }; /* the fewest pairs for which an interval is computed */

/* Computes a statistic of n pairs (x, y); NaN if it has no value. */
typedef double (*koksma__pair_statistic)(const double *x, const double *y, size_t n);

/* Means with their standard errors; an error counts as 0 if it is NaN or if `error` is NULL. `seed` is the seed for
   redrawing the means. */
typedef struct koksma__means {
    const double *mean, *error;
    uint64_t seed;
} koksma__means;

/* Computes the statistic and its percentile bootstrap interval (Efron 1979) over the pairs from `samples` resamples;
   resamples in which the statistic has no value are ignored. Each resample also redraws the means from normal
   distributions with their standard errors. Random numbers are hashes: equal seeds draw the same pairs, and means
   with equal `seed` get the same deviations in units of their errors. `values` is NULL or receives the statistic of
   each resample, in order, or NaN where it has no value. With n below 7 the interval is [-1, 1] and `values` is not
   set: bootstrap intervals of so few pairs exclude 0 in 8 to 13 % of cases without any correlation. If the pairs are
   in perfect order, all resamples have the same order. The interval then has width 0, although the statistic is not
   certain. Calls run->keep_going from time to time, always with the fraction 0; run may be NULL. Errors: MEMORY,
   INTERRUPTED. */
koksma_status koksma__bootstrap_pairs(const koksma__means *x, const koksma__means *y, size_t n,
                                      koksma__pair_statistic statistic, size_t samples, uint64_t seed,
                                      const koksma_run *run, double *values, koksma__estimate *out);

/* The value of a statistic; in resample s it is values[s] * factor. */
typedef struct koksma__draws {
    double value, factor;
    const double *values;
} koksma__draws;

/* Computes the difference a - b and its interval. Entry s of both arrays of values must come from the same resample,
   as koksma__bootstrap_pairs gives it for equal seeds. Errors: MEMORY. */
koksma_status koksma__bootstrap_difference(const koksma__draws *a, const koksma__draws *b, size_t samples,
                                           koksma__estimate *out);

#endif
