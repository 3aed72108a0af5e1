/* SPDX-License-Identifier: Apache-2.0 */
/* Algorithms for the star discrepancy: in the plane, in space, above by covers and partitions, below by searches. */
#ifndef KOKSMA_MEASURES_STAR_STAR_H
#define KOKSMA_MEASURES_STAR_STAR_H

#include <koksma/koksma.h>

/* ---- star_2d.c --------------------------------------------------------------------------------------------- */

/* koksma__star_2d accepts one or two dimensions and n < 2^28. In one dimension it sorts; in two it uses a sweep in
   O(n^2) for few points and a kinetic tree in about O(n log n) for more. koksma__star_2d_by accepts two dimensions
   and the method to use; tests compare the two. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__star_2d(const koksma_points *points, const koksma_run *run, koksma_value *out);
koksma_status koksma__star_2d_by(bool kinetic, const koksma_points *points, const koksma_run *run, koksma_value *out);

/* Writes the box from the origin to corner[0..dim) to out if its value exceeds that in out. The function counts the
   points in the box again, so that the value is |count/n - volume| to the last bit. */
void koksma__star_keep(const koksma_points *points, const double *corner, bool closed, koksma_value *out);

/* ---- star_cover.c ------------------------------------------------------------------------------------------ */

/* Computes an upper bound by refining a cover of the possible corners with boxes until the deadline. */
koksma_status koksma__star_cover(const koksma_points *points, const koksma_run *run, double deadline_s, double lower,
                                 double *upper);

/* ---- star_kinetic.c ---------------------------------------------------------------------------------------- */

/* Finds the best boxes by the kinetic tree. x: the x coordinates in order; rank: the ranks by y of these points; y:
   the y coordinates in order, with y[n] = 1. best: the largest excess and the largest deficit, times n; at: the index
   in x at which each is reached (n for x = 1). */
koksma_status koksma__star_kinetic(size_t n, const double *x, const uint32_t *rank, const double *y,
                                   const koksma_run *run, double best[2], size_t at[2]);

/* ---- star_partition.c -------------------------------------------------------------------------------------- */

/* The star discrepancy in any dimension, exactly. */
enum { KOKSMA__STAR_MAX_DIM = 64 };

/* Computes the exact value in any dimension by the partition of Dobkin, Eppstein and Mitchell, in O(n^(1 + d/2)). If
   the deadline passes, *complete becomes false and out receives the best value found. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__star_partition(const koksma_points *points, const koksma_run *run, double deadline_s,
                                     koksma_value *out, bool *complete);

/* ---- star_search.c ----------------------------------------------------------------------------------------- */

/* Computes a lower bound by threshold accepting: the best value of `restarts` walks of `steps` steps for the excess
   and as many for the deficit. After the deadline no further walks are started. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__star_search(const koksma_points *points, const koksma_run *run, uint64_t seed, size_t steps,
                                  size_t restarts, double deadline_s, koksma_value *out);

#endif
