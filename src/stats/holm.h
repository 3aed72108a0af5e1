/* SPDX-License-Identifier: Apache-2.0 */
/* Tests from resamples, and several tests at once. */
#ifndef KOKSMA_STATS_HOLM_H
#define KOKSMA_STATS_HOLM_H

#include <koksma/koksma.h>

/* The two-sided p of "it is 0" from resamples, values[i] a - b[i] c (b NULL: 0): twice the rarer sign's share, 0
   counting for both signs, with the +1 of Davison and Hinkley (1997): never below 2 / (samples + 1). NaN are left
   out; without values it is 1. */
double koksma__resampled_p(const double *values, double a, const double *b, double c, size_t samples);

/* Holm's (1979) adjusted p of n tests, in place: those up to 0.05 may all be called sure, and the chance that one of
   them is wrong is no more than 5 %, whatever the tests have to do with each other. Errors: MEMORY. */
koksma_status koksma__holm(double *p, size_t n);

#endif
