/* SPDX-License-Identifier: Apache-2.0 */
/* Searches among the disks through two points of the torus, for the measure `disk`. */
#ifndef KOKSMA_MEASURES_SHARED_DISK_PENCIL_H
#define KOKSMA_MEASURES_SHARED_DISK_PENCIL_H

#include <koksma/koksma.h>

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

#endif
