/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_OWEN_HAMMERSLEY_H
#define KOKSMA_PATTERNS_SHARED_OWEN_HAMMERSLEY_H

#include <koksma/koksma.h>

/* Coordinate 0 of a point set that is i/n there, i < n = out->n, scrambled: with n = 2^m by Owen's nested uniform
   scrambling in base 2, exact, in steps of 2^-32; with other n, which no base divides into digits, uniform in
   [i/n, (i+1)/n). Either way each of these strata has one point. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__owen_equidistant(uint64_t seed, const koksma_run *run, koksma_points *out);

/* Fills out with Hammersley's points, Owen-scrambled: coordinate 0 as above, coordinate k > 0 as koksma__owen_digits
   has the Halton sequence's coordinate k - 1. */
koksma_status koksma__owen_hammersley(uint64_t seed, const koksma_run *run, koksma_points *out);

#endif
