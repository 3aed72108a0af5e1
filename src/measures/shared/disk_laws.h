/* SPDX-License-Identifier: Apache-2.0 */
/* Random disks, and balls in 3 dimensions, on the unit torus, and the distributions ("laws") of their radius. */
#ifndef KOKSMA_MEASURES_SHARED_DISK_LAWS_H
#define KOKSMA_MEASURES_SHARED_DISK_LAWS_H

#include <koksma/koksma.h>

/* FIXED: the radius is r. RADIUS: the radius is uniform in (0, r). AREA: the area is uniform in (0, pi r^2), for
   balls the volume in (0, 4/3 pi r^3). */
typedef enum koksma__disk_law { KOKSMA__DISKS_FIXED, KOKSMA__DISKS_RADIUS, KOKSMA__DISKS_AREA } koksma__disk_law;

extern const char *const koksma__disk_laws[]; /* the values of the parameter `law` */

/* Returns the radius for the parameter r of a measure: r itself, or for r = 0 the default, which is 1/4 for FIXED and
   1/2 for the other laws. */
double koksma__disk_radius(koksma__disk_law law, double r);

/* Returns the area of the overlap of two equal disks whose centres are sqrt(distance2) apart, averaged over their
   radius, which has the given law; it is 0 for distances of 2r and more. */
double koksma__disk_overlap(koksma__disk_law law, double r, double distance2);

/* Returns the derivative of the mean overlap of two disks (dim = 2) or balls (dim = 3) by the distance of their
   centres. */
double koksma__overlap_slope(koksma__disk_law law, int dim, double r, double distance);

/* Returns the squared area of a disk, averaged over its radius. */
double koksma__disk_square(koksma__disk_law law, double r);

/* Return the volume of the overlap of two equal balls, and the squared volume of a ball, averaged over the radius. */
double koksma__ball_overlap(koksma__disk_law law, double r, double distance2);
double koksma__ball_square(koksma__disk_law law, double r);

/* Computes the centre and the squared radius of random disk `index` of a seed. */
void koksma__random_disk(koksma__disk_law law, double r, uint64_t seed, uint64_t index, int dim, double centre[3],
                         double *radius2);

#endif
