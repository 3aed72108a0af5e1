/* SPDX-License-Identifier: Apache-2.0 */
/* Measures of points that a warp has mapped. Each section is the interface of the file of its name. */
#ifndef KOKSMA_MEASURES_WARPED_WARPED_H
#define KOKSMA_MEASURES_WARPED_WARPED_H

#include <koksma/koksma.h>
#include <koksma/warp.h>

#include "measures/edge/edge.h"

/* ---- Warp domains ---------------------------------------------------------------------------------------- */

/* The domains to which warps map points, each with the uniform measure of total mass 1. */

typedef enum koksma__domain_kind {
    KOKSMA__DISK,
    KOKSMA__TRIANGLE,
    KOKSMA__HEMISPHERE,
    KOKSMA__SPHERE
} koksma__domain_kind;

extern const koksma__domain koksma__domains[2]; /* domains[kind] for the disk and the triangle; the others are not
                                                   plane domains */

/* Returns sigma, the probability that a random line that meets the domain (on the hemisphere and the sphere: a
   plane through the centre) separates two points; the potential P and the constant C are defined in measures/l2_edge.c. */
double koksma__domain_separates(koksma__domain_kind kind, const double *p, const double *q);
double koksma__domain_potential(koksma__domain_kind kind, const double *p);
double koksma__domain_constant(koksma__domain_kind kind);

/* Returns the area of the overlap of two disks of radius 1 and r whose centres are at this distance. */
double koksma__disks_share(double r, double distance);

/* ---- Warp caps ------------------------------------------------------------------------------------------- */

/* The measure l2-disk for points that a warp has mapped to a hemisphere or the sphere: random caps. xs has the
   coordinates point by point. */

/*
 * Computes the root mean square, over spherical caps {y.z >= t}, z uniform on the sphere and t on (-1,1), of the
 * difference between the share of points in the cap and the share of the domain's measure in it: a hemisphere's, uniform
 * or weighted by the cosine, or the sphere's.
 *
 * Formula (Stolarsky's invariance principle, for a measure on a part of the sphere): a random cap separates x and y
 * with probability |x - y|/4, so square = ((1/n) sum_i P(x_i) - (1/n^2) sum_{i<j} |x_i - x_j| - C/2)/4. P, the mean
 * distance of x from a hemisphere, is an integral of complete elliptic integrals over the circles of latitude; C,
 * the mean of P, is 32/(9 pi) or, with the cosine weight, 2048/(675 pi) (found from 18 digits, not proven, but
 * tested). On the sphere both are 4/3, and twice the square is the squared L2 discrepancy of spherical caps of
 * Brauchart & Dick 2012, who integrate over t.
 * Source: Stolarsky 1973; Alexander 1990.
 * Known exactly: P is 2 sqrt(2)/3 at the pole and 4/3 at the rim; with the cosine weight 8 sqrt(2)/15 and 64/(15 pi). One
 * point of the sphere has the square 1/6, two opposite ones 1/24.
 * For random points the mean of the square is C/(8n).
 * Limits: P and the square have errors of about 1e-15.
 * Errors: MEMORY, INTERRUPTED.
 */
koksma_status koksma__warp_caps(size_t n, const double *xs, koksma_warp_domain domain, const koksma_run *run,
                                koksma_value *out);

/* Return the potential P of a point of the domain, and the constant C, which the formula of koksma__warp_caps
   contains. */
double koksma__cap_potential(const double *x, koksma_warp_domain domain);
double koksma__cap_constant(koksma_warp_domain domain);

/* ---- Warp l2 disk ---------------------------------------------------------------------------------------- */

/* The measure l2-disk for points that a warp has mapped to the disk: random disks. xs has the coordinates point by
   point. */

/*
 * Computes the root mean square, over disks of radius 0 < r <= 1 that meet the unit disk D with centres uniform
 * within 1 + r, of the difference between the share of points in the disk and the share of D's area in it.
 *
 * Formula: with lens(d) the overlap of two disks of radius r at distance d, L(p) the area of D in a disk of radius r
 * whose centre is at distance p from the origin, and A = pi (1+r)^2, square = (n^-2 sum_ij lens(|x_i - x_j|) - (2/n)
 * sum_i a(|x_i|) + c)/A, where a(s) is the integral of L(p)/pi over the centres within r of a point at distance s
 * from the origin, and c is the integral of 2 pi p (L(p)/pi)^2 over p.
 * Source: derived.
 * Known exactly: random points, the mean of the square is (r^2 - c/pi)/((1+r)^2 n).
 * Limits: a and c have relative errors of about 1e-14; the square has an error of about 1e-15.
 * Errors: MEMORY, INTERRUPTED.
 */
koksma_status koksma__warp_l2_disk(size_t n, const double *xs, double r, const koksma_run *run, koksma_value *out);

#endif
