/* SPDX-License-Identifier: Apache-2.0 */
/* Half-planes and the unit square, and the two distributions ("laws") of random lines. */
#ifndef KOKSMA_MEASURES_SHARED_LINES_H
#define KOKSMA_MEASURES_SHARED_LINES_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* The distribution of a random line that meets the square. ISOTROPIC: the measure that is invariant under translation
   and rotation. MITCHELL: the recipe of Mitchell 1992, y = m x + b with m = (r1 - 1/2)/(r2 - 1/2) and b uniform over
   the values for which the line meets the square. The paper treats this distribution as isotropic, but it is not.
   Let t, from 0 to 45 degrees, be the angle between a line and the nearer axis. The fraction of lines with an angle
   below t is tan t, so the density 1 / cos^2 t is 2 times as high at 45 degrees as along an axis. For isotropic lines
   that fraction is 1 + sin t - cos t; its density cos t + sin t, the width of the square, is only sqrt(2) times as
   high. */
typedef enum koksma__line_law { KOKSMA__LINES_ISOTROPIC, KOKSMA__LINES_MITCHELL } koksma__line_law;

extern const char *const koksma__line_laws[]; /* the values of the parameter `law` */

/* Fails because the law MITCHELL is not defined for planes in 3 dimensions; only ISOTROPIC is. */
koksma_status koksma__fail_law_of_plane(const char *measure);

/* Returns the area of the part of the square with a x + b y <= c. */
double koksma__area_below(double a, double b, double c);

/* Returns the area of the part of the square with a x + b y <= a p[0] + b p[1], without rounding a p[0] + b p[1]
   first. */
double koksma__area_below_through(double a, double b, const double p[2]);

/* Returns sigma(|dx|, |dy|), the probability that a random line separates two points that differ by (dx, dy). This
   probability is symmetric in |dx| and |dy| and homogeneous of degree 1. */
double koksma__line_separates(koksma__line_law law, double dx, double dy);

/* Return the potential P(p), which is the integral of sigma(p - x) over x in the square, and the constant C, the
   integral of P over the square. */
double koksma__line_potential(koksma__line_law law, const double p[2]);
/* Compute the derivatives of sigma by dx and dy, which are 0 for dx = dy = 0, and of P by p. */
void koksma__line_separates_slope(koksma__line_law law, double dx, double dy, double slope[2]);
void koksma__line_potential_slope(koksma__line_law law, const double p[2], double slope[2]);
double koksma__line_constant(koksma__line_law law);

/* Computes random line `index` of a seed, a x + b y = c. */
KOKSMA__LAB void koksma__random_line(koksma__line_law law, uint64_t seed, uint64_t index, double *a, double *b,
                                     double *c);

#endif
