/* SPDX-License-Identifier: Apache-2.0 */
/* The extreme discrepancy of few points. */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_SMALL_H
#define KOKSMA_MEASURES_SHARED_EXTREME_SMALL_H

#include <koksma/koksma.h>

/* Computes the largest |count/n - volume| over all boxes, exactly, with its witness, in d = 1 to 3 dimensions in
   O(n^(2d-1)). If a time limit ends the search, out has a lower and an upper bound. Errors: N, MEMORY, INTERRUPTED. */
koksma_status koksma__extreme_small(const koksma_points *points, const koksma_run *run, koksma_value *out);

#endif
