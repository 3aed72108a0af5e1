/* SPDX-License-Identifier: Apache-2.0 */
/* p-values from resamples, and Holm's correction for several tests. */
#ifndef KOKSMA_STATS_HOLM_H
#define KOKSMA_STATS_HOLM_H

#include <koksma/koksma.h>

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
