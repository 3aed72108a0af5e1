/* SPDX-License-Identifier: Apache-2.0 */
/* Half-planes and the unit square, and the two laws of random lines. */
#ifndef KOKSMA_MEASURES_SHARED_LINES_H
#define KOKSMA_MEASURES_SHARED_LINES_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* The law of a random line that hits the square. ISOTROPIC: the measure that moving and turning does not change.
   MITCHELL: the second paper's recipe, y = m x + b with m = (r1 - 1/2)/(r2 - 1/2) and b uniform over the square's
   range, which its text takes for the same; its angles are not (up to 1.84 to 1 at 45 degrees, where it should
   be 1.36). */
typedef enum koksma__line_law { KOKSMA__LINES_ISOTROPIC, KOKSMA__LINES_MITCHELL } koksma__line_law;

extern const char *const koksma__line_laws[]; /* the words for a parameter */

/* The error of MITCHELL in 3 dimensions: it is a law of lines only. */
koksma_status koksma__fail_law_of_plane(const char *measure);

/* The area of the square where a x + b y <= c. */
double koksma__area_below(double a, double b, double c);

/* The area of the square where a x + b y <= a p[0] + b p[1]: computed from p, so that no rounded sum enters. */
double koksma__area_below_through(double a, double b, const double p[2]);

/* sigma(|dx|, |dy|): the probability that a line separates two points at that distance; symmetric, homogeneous. */
double koksma__line_separates(koksma__line_law law, double dx, double dy);

/* P(x) = the integral of sigma over the square from p, and C = the integral of P. */
double koksma__line_potential(koksma__line_law law, const double p[2]);
/* The derivatives of sigma by dx and dy, and of P by p; 0 where dx and dy are. */
void koksma__line_separates_slope(koksma__line_law law, double dx, double dy, double slope[2]);
void koksma__line_potential_slope(koksma__line_law law, const double p[2], double slope[2]);
double koksma__line_constant(koksma__line_law law);

/* Line `index` of a seed: a x + b y = c. */
KOKSMA__LAB void koksma__random_line(koksma__line_law law, uint64_t seed, uint64_t index, double *a, double *b,
                                     double *c);

#endif
