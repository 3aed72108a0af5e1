/* SPDX-License-Identifier: Apache-2.0 */
/* L2 discrepancies by divide and conquer. */
#ifndef KOKSMA_MEASURES_SHARED_L2_DIVIDE_H
#define KOKSMA_MEASURES_SHARED_L2_DIVIDE_H

#include "measures/shared/l2_pairs.h"

enum { KOKSMA__L2_DIVIDE_DIM = 4 };

/* Returns the number of products, 1 to 3, into which the kernel K(a, b) separates for a <= b. */
int koksma__l2_ranks(const koksma__l2_row *row);

/* Writes the square in O(n log^(d-1) n), for d = 3 to KOKSMA__L2_DIVIDE_DIM dimensions. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__l2_by_dividing(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                     double *square);

#endif
