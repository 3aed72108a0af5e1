/* SPDX-License-Identifier: Apache-2.0 */
/* Algorithms for edge discrepancies: laws of lines and planes, sweeps, covers, half-spaces. */
#ifndef KOKSMA_MEASURES_EDGE_EDGE_H
#define KOKSMA_MEASURES_EDGE_EDGE_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* ---- edge_domain.c ----------------------------------------------------------------------------------------- */

/* Convex domains in the plane, and half-planes that cut them. */
enum { KOKSMA__MAX_CHORDS = 3 };

/* The direction of a chord as two exact differences, (across[0] - across[1], up[0] - up[1]); both are 0 if there is
   no chord. */
typedef struct koksma__chord {
    double across[2], up[2];
} koksma__chord;

/* A convex domain in the plane with the uniform measure of total mass 1. */
typedef struct koksma__domain {
    /* returns the mass of the half-plane a x + b y <= a p[0] + b p[1] */
    double (*area_below_through)(double a, double b, const double p[2]);
    /* computes the chords with midpoint p. These chords lie on the lines through p for which the mass on one side is
       stationary as the line turns about p. There is at least one chord; if p is a corner of the domain, the chords
       are the two adjacent sides */
    void (*chords)(const double p[2], koksma__chord chords[KOKSMA__MAX_CHORDS]);
    double radius; /* radius of a circle that contains the domain */
} koksma__domain;

/* A half-plane: a x + b y <= c if it is closed, else a x + b y < c. */
typedef struct koksma__edge_line {
    double value, a, b, c, mass;
    size_t count;
    bool closed;
} koksma__edge_line;

/* ---- edge_space.c ------------------------------------------------------------------------------------------ */

/* Computes the measure `edge` in 3 dimensions: the largest |count/n - volume| over all half-spaces, with its witness.
   If run's time limit passes, out is not exact: it receives the best value found and the upper bound 1. Errors: N,
   MEMORY, INTERRUPTED. */
koksma_status koksma__edge_space(const koksma_points *points, const koksma_run *run, koksma_value *out);

/* ---- edge_sweep.c ------------------------------------------------------------------------------------------ */

/* Computes the largest |count/n - mass| over half-planes whose border goes through a point, with its witness. If
   run's time limit passes, out is not exact: it receives the best value found and an upper bound. Errors: N, MEMORY,
   INTERRUPTED. */
koksma_status koksma__edge_sweep(const koksma__domain *domain, size_t n, const double *xs, const koksma_run *run,
                                 koksma_value *out);

/* ---- edge_cover.c ------------------------------------------------------------------------------------------ */

/* Cuts the directions into intervals until the deadline. Sets *upper to an upper bound of the values of all lines.
   Replaces *best, the best line known before, by the best line in the middle direction of any interval if that has a
   larger value. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__edge_cover(const koksma__domain *domain, size_t n, const double *xs, const koksma_run *run,
                                 double deadline_s, koksma__edge_line *best, double *upper);

/* ---- lines.c ----------------------------------------------------------------------------------------------- */

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

/* ---- planes.c ---------------------------------------------------------------------------------------------- */

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
