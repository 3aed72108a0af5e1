/* SPDX-License-Identifier: Apache-2.0 */
/* The edge discrepancy in 3 dimensions. */
#ifndef KOKSMA_MEASURES_SHARED_EDGE_SPACE_H
#define KOKSMA_MEASURES_SHARED_EDGE_SPACE_H

#include <koksma/koksma.h>

/* Computes the measure `edge` in 3 dimensions: the largest |count/n - volume| over all half-spaces, with its witness.
   If run's time limit passes, out is not exact: it receives the best value found and the upper bound 1. Errors: N,
   MEMORY, INTERRUPTED. */
koksma_status koksma__edge_space(const koksma_points *points, const koksma_run *run, koksma_value *out);

#endif
