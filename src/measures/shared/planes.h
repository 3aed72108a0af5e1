/* SPDX-License-Identifier: Apache-2.0 */
/* Half-spaces and the unit cube. */
#ifndef KOKSMA_MEASURES_SHARED_PLANES_H
#define KOKSMA_MEASURES_SHARED_PLANES_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* The volume of the cube where a . x <= c; a is not 0. */
KOKSMA__LAB double koksma__volume_below(const double a[3], double c);

/* The volume of the cube where a . x <= a . p: computed from p, so that no rounded product a . p enters. */
KOKSMA__LAB double koksma__volume_below_through(const double a[3], const double p[3]);

/* A random plane that hits the cube, by the measure that moving and turning does not change, separates two points
   with the probability distance / 3. P(x) = the integral of that over the cube from p, and C = the integral of P. */
KOKSMA__LAB double koksma__plane_potential(const double p[3]);
/* The derivatives of P by p. */
void koksma__plane_potential_slope(const double p[3], double slope[3]);
KOKSMA__LAB double koksma__plane_constant(void);

/* Plane `index` of a seed by that measure: a . x = c. */
KOKSMA__LAB void koksma__random_plane(uint64_t seed, uint64_t index, double a[3], double *c);

/* edge in 3 dimensions: the largest |#/n - volume| over all half-spaces with its witness. When run's time limit
   passes, out is not exact: the best that was found, and 1. Errors: N, MEMORY, INTERRUPTED. */
koksma_status koksma__edge_space(const koksma_points *points, const koksma_run *run, koksma_value *out);

#endif
