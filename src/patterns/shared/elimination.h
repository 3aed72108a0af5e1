/* SPDX-License-Identifier: Apache-2.0 */
/* Weighted sample elimination on the torus (Yuksel 2015), for the patterns sample-elimination and
   progressive-elimination. */
#ifndef KOKSMA_PATTERNS_SHARED_ELIMINATION_H
#define KOKSMA_PATTERNS_SHARED_ELIMINATION_H

#include <koksma/koksma.h>

/* Twice the largest Poisson disk radius of n points in [0,1)^dim: the radius of the weight function. Exact for the
   torus packings of dim 1, 2 and 3; above, the radius of balls that fill the whole volume, as the paper takes it. */
double koksma__elimination_radius(size_t n, int dim);

/* Weight limiting: the fraction of that radius below which a smaller distance weighs no more, when n of m points
   are kept. */
double koksma__elimination_limit(size_t n, size_t m);

/* Takes the heaviest of `count` points out, one after the other, until `keep` are left. A point weighs the sum over
   the others of (1 - max(d, d_min) / d_max)^8, where d is the distance on the torus and d < d_max; in 4 to 8 dimensions
   over all periodic images of the others within d_max, which are several where d_max > 1/2. Of equal weights the first
   point's goes first.
       order[0] .. order[keep - 1]       the points left, in the order in which they are given
       order[keep] .. order[count - 1]   those taken out, the last one first */
koksma_status koksma__eliminate(size_t count, int dim, const double *points, size_t keep, double d_max, double d_min,
                                const koksma_run *run, uint32_t *order);

/* n points, of `factor` times as many uniform ones: in the order in which these were drawn, or so that the first
   n/2, n/4, .. and all others are blue noise, too (Yuksel's progressive ordering). `name` is the pattern's. */
koksma_status koksma__eliminated_set(const char *name, uint64_t seed, size_t n, int dim, size_t factor,
                                     bool progressive, const koksma_run *run, double *xs);

#endif
