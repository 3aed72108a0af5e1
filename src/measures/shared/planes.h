/* SPDX-License-Identifier: Apache-2.0 */
/* Half-spaces and the unit cube. */
#ifndef KOKSMA_MEASURES_SHARED_PLANES_H
#define KOKSMA_MEASURES_SHARED_PLANES_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Returns the volume of the part of the cube with a . x <= c; a is not 0. */
KOKSMA__LAB double koksma__volume_below(const double a[3], double c);

/* Returns the volume of the part of the cube with a . x <= a . p, without rounding the product a . p first. */
KOKSMA__LAB double koksma__volume_below_through(const double a[3], const double p[3]);

/* Returns the potential P(p): the integral over x in the cube of |p - x| / 3, which is the probability sigma that a
   random plane that meets the cube separates p and x. The planes have the distribution that is invariant under
   translation and rotation. */
KOKSMA__LAB double koksma__plane_potential(const double p[3]);
/* Compute the derivatives of P by p, and (koksma__plane_constant) the constant C, which is the integral of P over the
   cube. */
void koksma__plane_potential_slope(const double p[3], double slope[3]);
KOKSMA__LAB double koksma__plane_constant(void);

/* Computes random plane `index` of a seed, a . x = c, from the invariant distribution of planes that meet the cube.
   */
KOKSMA__LAB void koksma__random_plane(uint64_t seed, uint64_t index, double a[3], double *c);

#endif
