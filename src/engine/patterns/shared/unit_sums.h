/* SPDX-License-Identifier: Apache-2.0 */
/* Computes for all multipliers at once how much another coordinate would add to the worst-case error of a lattice. */
#ifndef KOKSMA_PATTERNS_SHARED_UNIT_SUMS_H
#define KOKSMA_PATTERNS_SHARED_UNIT_SUMS_H

#include <koksma/koksma.h>

typedef struct koksma__unit_sums koksma__unit_sums;

/* Prepares the sums for n > 2 points. The sums need 16 n bytes if n is a power of two, and up to 82 n bytes for other
   n (the most if n is a prime just above a power of two). The sums must be closed even if opening failed. */
koksma_status koksma__unit_sums_open(size_t n, const koksma_run *run, koksma__unit_sums **sums);
void koksma__unit_sums_close(koksma__unit_sums *sums);

/* Computes values[z], z <= n/2 (n/2 + 1 entries): the sum over 1 <= i <= n/2 of product[i] B_2({i z / n}), up to a
   constant that is equal for all z; infinity if z has a divisor in common with n. *error becomes the assumed bound
   on the rounding error. Time: O(n log n). Errors: INTERRUPTED. */
koksma_status koksma__unit_sums_find(koksma__unit_sums *sums, const koksma_run *run, const double *product,
                                     double *values, double *error);

#endif
