/* SPDX-License-Identifier: Apache-2.0 */
/* The disks through two points of the torus, for `disk`. */
#ifndef KOKSMA_MEASURES_SHARED_DISK_PENCIL_H
#define KOKSMA_MEASURES_SHARED_DISK_PENCIL_H

#include <koksma/koksma.h>

/* A point whose squared distance from the centre is this close to the squared radius is on the rim. */
#define KOKSMA__DISK_RIM 4e-15

typedef struct koksma__disk_set {
    size_t n, m; /* points; distinct points */
    double r;    /* the largest radius */
    double *xs, *ys;
    size_t *weights; /* how many points are at each place */
} koksma__disk_set;

typedef struct koksma__disk_best {
    double value;
    koksma_witness witness;
} koksma__disk_best;

/* Keeps the disk if it is better than the best. */
void koksma__disk_try(const koksma__disk_set *set, koksma__disk_best *best, bool closed, size_t count,
                      const double *centre, double square_radius);

/* Tries the critical disks with points i and any j > i on their rim. Errors: MEMORY. */
koksma_status koksma__disk_pencils(const koksma__disk_set *set, size_t i, koksma__disk_best *best);

/* Tries the critical disks with points i and j on their rim, j being seen at (dx, dy) from i on the torus. Errors:
   MEMORY. */
koksma_status koksma__disk_pair(const koksma__disk_set *set, size_t i, size_t j, double dx, double dy,
                                koksma__disk_best *best);

/* Raises *best to the best of all disks; or stops at the deadline or, without one, when enough work is done, and then
 *upper, a bound of all disks, is larger. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__disk_cover(const koksma__disk_set *set, const koksma_run *run, double deadline_s,
                                 koksma__disk_best *best, double *upper);

#endif
