/* SPDX-License-Identifier: Apache-2.0 */
/* The kinetic tree for the star discrepancy in two dimensions. */
#ifndef KOKSMA_MEASURES_SHARED_STAR_KINETIC_H
#define KOKSMA_MEASURES_SHARED_STAR_KINETIC_H

#include <koksma/koksma.h>

/* Finds the best boxes by the kinetic tree. x: the x coordinates in order; rank: the ranks by y of these points; y:
   the y coordinates in order, with y[n] = 1. best: the largest excess and the largest deficit, times n; at: the index
   in x at which each is reached (n for x = 1). */
koksma_status koksma__star_kinetic(size_t n, const double *x, const uint32_t *rank, const double *y,
                                   const koksma_run *run, double best[2], size_t at[2]);

#endif
