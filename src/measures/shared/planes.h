/* SPDX-License-Identifier: Apache-2.0 */
/* Half-spaces and the unit cube. */
#ifndef KOKSMA_MEASURES_SHARED_PLANES_H
#define KOKSMA_MEASURES_SHARED_PLANES_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* The volume of the cube where a . x <= c; a is not 0. */
KOKSMA__LAB double koksma__volume_below(const double a[3], double c);

/* The volume of the cube where a . x <= a . p: computed from p, without rounding the product a . p first. */
KOKSMA__LAB double koksma__volume_below_through(const double a[3], const double p[3]);

/* The potential P(p), the integral over x in the cube of sigma = |p - x| / 3, the probability that a random plane
   that meets the cube separates p and x. The measure of planes is the one that is invariant under translation and
   rotation. */
KOKSMA__LAB double koksma__plane_potential(const double p[3]);
/* The derivatives of P by p, and (koksma__plane_constant) the constant C, the integral of P over the cube. */
void koksma__plane_potential_slope(const double p[3], double slope[3]);
KOKSMA__LAB double koksma__plane_constant(void);

/* Random plane `index` of a seed, a . x = c, by the invariant measure of planes that meet the cube. */
KOKSMA__LAB void koksma__random_plane(uint64_t seed, uint64_t index, double a[3], double *c);

/* edge in 3 dimensions: the largest |#/n - volume| over all half-spaces with its witness. When run's time limit
   passes, out is not exact and has the best value found and the upper bound 1. Errors: N, MEMORY, INTERRUPTED. */
koksma_status koksma__edge_space(const koksma_points *points, const koksma_run *run, koksma_value *out);

#endif
