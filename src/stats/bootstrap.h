/* SPDX-License-Identifier: Apache-2.0 */
/* Bootstrap intervals of statistics of pairs. */
#ifndef KOKSMA_STATS_BOOTSTRAP_H
#define KOKSMA_STATS_BOOTSTRAP_H

#include "stats/statistics.h"

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

#endif
