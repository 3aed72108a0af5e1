/* SPDX-License-Identifier: Apache-2.0 */
/* The measure l2-disk for points that a warp has mapped to the disk: random disks. xs has the coordinates point by
   point. */
#ifndef KOKSMA_MEASURES_SHARED_WARP_L2_DISK_H
#define KOKSMA_MEASURES_SHARED_WARP_L2_DISK_H

#include <koksma/koksma.h>

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
