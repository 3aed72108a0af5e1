/* SPDX-License-Identifier: Apache-2.0 */
/* The domains that warps lead to, each with the uniform measure of mass 1. */
#ifndef KOKSMA_MEASURES_SHARED_WARP_DOMAINS_H
#define KOKSMA_MEASURES_SHARED_WARP_DOMAINS_H

#include "measures/shared/edge_sweep.h"

typedef enum koksma__domain_kind { KOKSMA__DISK, KOKSMA__TRIANGLE, KOKSMA__HEMISPHERE } koksma__domain_kind;

extern const koksma__domain koksma__domains[2]; /* of the disk and the triangle */

/* sigma: the probability that a random line that meets the domain (on the hemisphere: a plane through its centre)
   separates two points; P and C as in measures/l2_edge.c. */
double koksma__domain_separates(koksma__domain_kind kind, const double *p, const double *q);
double koksma__domain_potential(koksma__domain_kind kind, const double *p);
double koksma__domain_constant(koksma__domain_kind kind);

/* The area that disks of radius 1 and r share whose centres are at this distance. */
double koksma__disks_share(double r, double distance);

#endif
