/* SPDX-License-Identifier: Apache-2.0 */
/* The domains to which warps map points, each with the uniform measure of total mass 1. */
#ifndef KOKSMA_MEASURES_SHARED_WARP_DOMAINS_H
#define KOKSMA_MEASURES_SHARED_WARP_DOMAINS_H

#include "measures/edge/edge.h"

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

#endif
