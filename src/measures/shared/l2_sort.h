/* SPDX-License-Identifier: Apache-2.0 */
/* L2 discrepancies by sorting. */
#ifndef KOKSMA_MEASURES_SHARED_L2_SORT_H
#define KOKSMA_MEASURES_SHARED_L2_SORT_H

#include "measures/shared/l2_pairs.h"

/* Writes the square in O(n log n), for one or two dimensions and n < 2^28, if r and all coefficients of a24 and g
   except the first are multiples of 1/16; where the compiler has no 128-bit integers it sums over pairs instead.
   Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__l2_by_sorting(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                    double *square);

#endif
