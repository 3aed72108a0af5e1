/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_OWEN_HAMMERSLEY_H
#define KOKSMA_PATTERNS_SHARED_OWEN_HAMMERSLEY_H

#include <koksma/koksma.h>

/* Fills coordinate 0 of a point set whose unscrambled coordinate 0 is i/n, i < n = out->n. With n = 2^m this is Owen's
   exact nested uniform scrambling in base 2, in steps of 2^-32; with other n the coordinate is uniform in
   [i/n, (i+1)/n). In both cases each of these n strata has one point. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__owen_equidistant(uint64_t seed, const koksma_run *run, koksma_points *out);

/* Fills `out` with Owen-scrambled Hammersley points: coordinate 0 is that of koksma__owen_equidistant, coordinate k > 0
   is coordinate k - 1 of koksma__owen_digits. */
koksma_status koksma__owen_hammersley(uint64_t seed, const koksma_run *run, koksma_points *out);

#endif
