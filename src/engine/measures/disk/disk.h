/* SPDX-License-Identifier: Apache-2.0 */
/* Algorithms for disk discrepancies: laws of disks, pencils of circles, covers. */
#ifndef KOKSMA_MEASURES_DISK_DISK_H
#define KOKSMA_MEASURES_DISK_DISK_H

#include <koksma/koksma.h>

/* ---- disk_laws.c ------------------------------------------------------------------------------------------- */

/* FIXED: the radius is r. RADIUS: the radius is uniform in (0, r). AREA: the area is uniform in (0, pi r^2), for
   balls the volume in (0, 4/3 pi r^3). */
typedef enum koksma__disk_law { KOKSMA__DISKS_FIXED, KOKSMA__DISKS_RADIUS, KOKSMA__DISKS_AREA } koksma__disk_law;

extern const char *const koksma__disk_laws[]; /* the values of the parameter `law` */

/* Returns the radius for the parameter r of a measure: r itself, or for r = 0 the default, which is 1/4 for FIXED and
   1/2 for the other laws. */
double koksma__disk_radius(koksma__disk_law law, double r);

/* Returns the area of a disk, averaged over its radius. */
double koksma__disk_area(koksma__disk_law law, double r);

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

/* ---- disk_pencil.c ----------------------------------------------------------------------------------------- */

/* A point is on the rim of a disk if its squared distance from the centre differs from the squared radius by at most
   this. */
#define KOKSMA__DISK_RIM 4e-15

typedef struct koksma__disk_set {
    size_t n, m; /* number of points; number of distinct points */
    double r;    /* the largest radius */
    double *xs, *ys;
    size_t *weights; /* multiplicity of each distinct point */
} koksma__disk_set;

typedef struct koksma__disk_best {
    double value;
    koksma_witness witness;
} koksma__disk_best;

/* Sets *best to the disk with `count` points if its |count/n - area| exceeds the value of *best. */
void koksma__disk_try(const koksma__disk_set *set, koksma__disk_best *best, bool closed, size_t count,
                      const double *centre, double square_radius);

/* Tries the critical disks (at which the discrepancy can be largest, see disk.c) with point i and any point j > i on
   their rim. Errors: MEMORY. */
koksma_status koksma__disk_pencils(const koksma__disk_set *set, size_t i, koksma__disk_best *best);

/* Tries the critical disks with points i and j on their rim, where (dx, dy) is the vector from i to the image of j.
   Errors: MEMORY. */
koksma_status koksma__disk_pair(const koksma__disk_set *set, size_t i, size_t j, double dx, double dy,
                                koksma__disk_best *best);

/* ---- disk_cover.c ------------------------------------------------------------------------------------------ */

/* Raises *best to the best of all disks by branch and bound. *upper is an upper bound for all disks; it exceeds the
   value of *best if the search stopped early, at the deadline or, without one, after 2^28 point tests. Errors:
   MEMORY, INTERRUPTED. */
koksma_status koksma__disk_cover(const koksma__disk_set *set, const koksma_run *run, double deadline_s,
                                 koksma__disk_best *best, double *upper);

#endif
