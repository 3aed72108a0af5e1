/* SPDX-License-Identifier: Apache-2.0 */
/* Weighted sample elimination on the torus (Yuksel 2015), for the patterns sample-elimination and
   progressive-elimination. */
#ifndef KOKSMA_PATTERNS_SHARED_ELIMINATION_H
#define KOKSMA_PATTERNS_SHARED_ELIMINATION_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Returns the radius of the weight function, which is twice the largest Poisson disk radius of n points in [0,1)^dim.
   In 1 to 3 dimensions it follows from the densest packing; in more, from balls that fill the whole volume, as in the
   paper. */
KOKSMA__LAB double koksma__elimination_radius(size_t n, int dim);

/* Returns the weight limit d_min / d_max if n of m points remain in `dim` dimensions: distances below d_min have the same
   weight as d_min. It is 0 above 3 dimensions. */
KOKSMA__LAB double koksma__elimination_limit(size_t n, size_t m, int dim);

/* Removes the heaviest of `count` points, one after the other, until `keep` are left. The weight of a point is the
   sum over the other points with d < d_max of (1 - max(d, d_min) / d_max)^8, where d is the distance on the torus;
   in 4 to 8 dimensions with d_max > 1/2 the sum is over all periodic images of the other points. Of points with
   equal weights the one with the lowest number is removed first.
       order[0] .. order[keep - 1]       the points left, in the order in which they are given
       order[keep] .. order[count - 1]   the points removed, the last one first */
koksma_status koksma__eliminate(size_t count, int dim, const double *points, size_t keep, double d_max, double d_min,
                                const koksma_run *run, uint32_t *order);

/* How distances are measured. units has a unit of distance for each point; the distance of a pair is divided by the
   smaller unit of its two points ("smaller disks", Mitchell, Rand, Ebeida & Bajaj 2012). lengths[k] is what a coordinate
   of 1 measures along axis k. Both may be NULL: all are 1. Without torus distances do not wrap around. */
typedef struct koksma__metric {
    const double *units, *lengths;
    bool torus;
} koksma__metric;

/* Does the same as koksma__eliminate with a metric other than that of the unit torus. */
KOKSMA__LAB koksma_status koksma__eliminate_scaled(size_t count, int dim, const double *points,
                                                   const koksma__metric *metric, size_t keep, double d_max,
                                                   double d_min, const koksma_run *run, uint32_t *order);

/* Puts points into Yuksel's progressive order, in which every prefix is blue noise: elimination halves the set again and
   again, and each point comes after those that remain when it is removed.
       volume_dim   dimension of what the points fill: 2 for those on a surface, else dim
       d_max        argument of koksma__eliminate for the whole set; each halving has a larger one
       d_min        argument of koksma__eliminate for the whole set; all halvings use it
       order[k]     number of the k-th point in progressive order
   Errors: MEMORY, INTERRUPTED. */
KOKSMA__LAB koksma_status koksma__progressive_order(size_t count, int dim, const double *points,
                                                    const koksma__metric *metric, int volume_dim, double d_max,
                                                    double d_min, const koksma_run *run, uint32_t *order);

/* Puts a finished set on the torus into progressive order. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__order_progressively(const koksma_run *run, koksma_points *points);

/* Makes n points by elimination from factor * n uniform random points. The points are in the order in which they were
   drawn or, with `progressive`, in Yuksel's progressive order, whose prefixes are blue noise, too. `name` is the name
   of the pattern in error messages. */
koksma_status koksma__eliminated_set(const char *name, uint64_t seed, size_t n, int dim, size_t factor,
                                     bool progressive, const koksma_run *run, double *xs);

#endif
