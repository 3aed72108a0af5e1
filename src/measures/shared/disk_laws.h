/* SPDX-License-Identifier: Apache-2.0 */
/* Disks, and balls in 3 dimensions, on the unit torus and the laws of their radius. */
#ifndef KOKSMA_MEASURES_SHARED_DISK_LAWS_H
#define KOKSMA_MEASURES_SHARED_DISK_LAWS_H

#include <koksma/koksma.h>

/* FIXED: the radius is r. RADIUS: uniform in (0, r). AREA: the area is uniform in (0, pi r^2), of balls
   the volume in (0, 4/3 pi r^3). */
typedef enum koksma__disk_law { KOKSMA__DISKS_FIXED, KOKSMA__DISKS_RADIUS, KOKSMA__DISKS_AREA } koksma__disk_law;

extern const char *const koksma__disk_laws[]; /* the words for a parameter */

/* A parameter r of 0 means 1/4 for a fixed radius and 1/2 for the other laws. */
double koksma__disk_radius(koksma__disk_law law, double r);

/* The mean over the law of the area that two disks share whose centres are sqrt(distance2) apart; 0 from 2r on. */
double koksma__disk_overlap(koksma__disk_law law, double r, double distance2);

/* The derivative of the overlap of disks, or with dim = 3 of balls, by their distance. */
double koksma__overlap_slope(koksma__disk_law law, int dim, double r, double distance);

/* The mean over the law of the area's square. */
double koksma__disk_square(koksma__disk_law law, double r);

/* For balls: the overlap of two of them, the mean over the law of the squared volume. */
double koksma__ball_overlap(koksma__disk_law law, double r, double distance2);
double koksma__ball_square(koksma__disk_law law, double r);

/* Disk `index` of a seed: centre and the square of its radius. */
void koksma__random_disk(koksma__disk_law law, double r, uint64_t seed, uint64_t index, int dim, double centre[3],
                         double *radius2);

#endif
