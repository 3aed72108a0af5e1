/* SPDX-License-Identifier: Apache-2.0 */
/* The measure l2-disk for points that a warp has mapped to a hemisphere or the sphere: random caps. xs has the
   coordinates point by point. */
#ifndef KOKSMA_MEASURES_SHARED_WARP_CAPS_H
#define KOKSMA_MEASURES_SHARED_WARP_CAPS_H

#include <koksma/warp.h>

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

#endif
