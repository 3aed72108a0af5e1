/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Dart throwing on the 2D torus that knows where there is still room. The law is that of throwing uniform darts and
 * keeping those no closer than d to the kept ones: darts are thrown at a shrinking cover of the room, made of squares
 * of equal size, so a dart that lands in the room is uniform there. The cover is the flat quadtree of Ebeida,
 * Mitchell, Patney, Davidson & Owens (2012): after each round of darts its squares are cut in four, and those without
 * room left out.
 */
#ifndef KOKSMA_PATTERNS_PARTS_DART_COVER_H
#define KOKSMA_PATTERNS_PARTS_DART_COVER_H

#include <koksma/koksma.h>

typedef struct koksma__square {
    uint32_t x, y; /* in units of the squares' size */
} koksma__square;

typedef struct koksma__disks {
    double d;
    size_t n, room; /* points, and places for them */
    double *xs;     /* pairs */
    uint32_t cells; /* a side; none holds two points */
    size_t stride;  /* of the rows of gx and gy, which have a border of copies: 2 before, 5 after, 2 above, 2 below */
    size_t places;
    double *gx, *gy;
    int level; /* squares are cells / 2^level wide */
    size_t n_squares, square_room;
    koksma__square *squares;
    uint64_t seed, dart; /* the stream of darts */
} koksma__disks;

/* No points yet, for distance d in (0, 0.5]; fini frees what init and the others got. */
koksma_status koksma__disks_init(koksma__disks *disks, uint64_t seed, double d);
void koksma__disks_fini(koksma__disks *disks);

/* Throws darts until there are n points or no room is left (n = SIZE_MAX: until no room is left). */
koksma_status koksma__disks_fill(koksma__disks *disks, size_t n, const koksma_run *run);

/* Keeps the first n points and looks for room again with the smaller distance d. */
koksma_status koksma__disks_shrink(koksma__disks *disks, size_t n, double d);

/* The smallest distance of two points; 2 when none are within reach. */
double koksma__disks_distance(const koksma__disks *disks);

#endif
