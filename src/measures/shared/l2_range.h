/* SPDX-License-Identifier: Apache-2.0 */
/* L2 discrepancies that are outside the range of doubles. */
#ifndef KOKSMA_MEASURES_SHARED_L2_RANGE_H
#define KOKSMA_MEASURES_SHARED_L2_RANGE_H

#include "measures/shared/l2_pairs.h"

/* Computes the value by sums over pairs. The value is correct even if terms of the square, or the square itself (then
   NaN), are beyond the range of doubles. The error DIM means that the value, or a product over the first coordinates
   of a point, is beyond this range. */
koksma_status koksma__l2_value_by_pairs(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                        koksma_value *out);

#endif
