/* SPDX-License-Identifier: Apache-2.0 */
/* Checks of point sets. */
#ifndef KOKSMA_CORE_POINTS_H
#define KOKSMA_CORE_POINTS_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Fails unless dim is a valid number of dimensions and n points of that dimension fit into one set. Errors: ARGUMENT,
   DIM. */
KOKSMA__LAB koksma_status koksma__points_fit(size_t n, int dim);

/* Fails unless the set has points, its size is within the limits, and each coordinate is in [0,1] (NaN is not). Every
   public function that takes points, unless it documents another rule, makes this check first. Errors: ARGUMENT, DIM. */
KOKSMA__LAB koksma_status koksma__points_check(const koksma_points *points);

#endif
