/* SPDX-License-Identifier: Apache-2.0 */
/* The L2 discrepancies by the fastest method. */
#ifndef KOKSMA_MEASURES_SHARED_L2_H
#define KOKSMA_MEASURES_SHARED_L2_H

#include "measures/shared/l2_pairs.h"

/* Writes the value and its square to out, in O(n log n) for d <= 2 unless n is small, in O(n log^(d-1) n) for d = 3
   and 4 and large n, else in O(n^2 d). Errors: DIM, MEMORY, INTERRUPTED. */
koksma_status koksma__l2(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                         koksma_value *out);

#endif
