/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_L2_BELOW_H
#define KOKSMA_MEASURES_SHARED_L2_BELOW_H

#include <koksma/koksma.h>

#include "measures/shared/double_double.h"

/* A point of the plane whose coordinates are multiples of a small unit: whole numbers of up to 2^52 in absolute
   value. */
typedef struct koksma__l2_point {
    int64_t x, y;
    uint32_t at; /* rank in x order */
} koksma__l2_point;

/* Returns sum_i x_i sum_j (y_i - y_j), where j runs over the points before point i both in x order and in y order.
   The n < 2^28 points must be in y order; `points` and `spare`, which has capacity for n points, are overwritten.
   Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__l2_sum_below(const koksma_run *run, size_t n, koksma__l2_point *points, koksma__l2_point *spare,
                                   koksma__dd *sum);

#endif
