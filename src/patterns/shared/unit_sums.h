/* SPDX-License-Identifier: Apache-2.0 */
/* What a further coordinate would add to a lattice's error, for all multipliers at once. */
#ifndef KOKSMA_PATTERNS_SHARED_UNIT_SUMS_H
#define KOKSMA_PATTERNS_SHARED_UNIT_SUMS_H

#include <koksma/koksma.h>

typedef struct koksma__unit_sums koksma__unit_sums;

/* n > 2. Takes 16 n bytes when n is a power of two, and up to 82 n (n a prime just above one). To be closed when it
   failed, too. */
koksma_status koksma__unit_sums_open(size_t n, const koksma_run *run, koksma__unit_sums **sums);
void koksma__unit_sums_close(koksma__unit_sums *sums);

/* values[z] = the sum over 1 <= i <= n/2 of product[i] B_2({i z / n}), but for a constant, at each z <= n/2 that has
   no divisor in common with n; infinity at the others. values has n/2 + 1 entries. Rounding is taken to be
   below *error. Time: O(n log n). Errors: INTERRUPTED. */
koksma_status koksma__unit_sums_find(koksma__unit_sums *sums, const koksma_run *run, const double *product,
                                     double *values, double *error);

#endif
