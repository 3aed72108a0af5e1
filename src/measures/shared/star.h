/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of the star discrepancy. All of them leave the value and its witness in out. */
#ifndef KOKSMA_MEASURES_SHARED_STAR_H
#define KOKSMA_MEASURES_SHARED_STAR_H

#include <koksma/koksma.h>

enum { KOKSMA__STAR_MAX_DIM = 64 };

/* One dimension by sorting. Two: sweep in O(n^2) below the crossover, kinetic tree in about O(n log n) above; n <
   2^28. The last form is for two dimensions and has no crossover: tests compare the two. Errors: MEMORY, INTERRUPTED.
 */
koksma_status koksma__star_2d(const koksma_points *points, const koksma_run *run, koksma_value *out);
koksma_status koksma__star_2d_by(bool kinetic, const koksma_points *points, const koksma_run *run, koksma_value *out);

/* The kinetic tree alone: points in order of x, their ranks by y, and y in order with y[n] = 1. For excess and
   deficit the largest value times n, and the place in x order (n for x = 1) where it is reached. */
koksma_status koksma__star_kinetic(size_t n, const double *x, const uint32_t *rank, const double *y,
                                   const koksma_run *run, double best[2], size_t at[2]);

/* Any dimension, exact, by Dobkin, Eppstein and Mitchell's partition in O(n^(1 + d/2)). When run's time limit passes,
 *complete is false and out holds the best that was found. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__star_partition(const koksma_points *points, const koksma_run *run, double deadline_s,
                                     koksma_value *out, bool *complete);

/* A lower bound by threshold accepting: the best of `restarts` walks of `steps` steps for each sign, or of as many as
   the deadline leaves time for. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__star_search(const koksma_points *points, const koksma_run *run, uint64_t seed, size_t steps,
                                  size_t restarts, double deadline_s, koksma_value *out);

/* An upper bound by refining a cover of the corners until the deadline. */
koksma_status koksma__star_cover(const koksma_points *points, const koksma_run *run, double deadline_s, double lower,
                                 double *upper);

/* Puts the box from the origin to corner[0..dim) into out if it is better than what is there: its count is taken
   anew, and the value is |count/n - volume| to the last bit. */
void koksma__star_keep(const koksma_points *points, const double *corner, bool closed, koksma_value *out);

#endif
