/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_L2_GRADIENT_H
#define KOKSMA_MEASURES_SHARED_L2_GRADIENT_H

#include "measures/shared/l2_pairs.h"

/* Computes the square of an L2 discrepancy by sums over pairs, and its derivatives by all coordinates, in O(n^2 d).
   Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__l2_gradient(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                  double *square, double *gradient);

#endif
