/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Dart throwing on the 2D torus that knows where there is still room. The law is that of throwing uniform darts and
 * keeping those no closer than d to the kept ones: darts are thrown at a shrinking cover of the room, made of squares
 * of equal size, so a dart that lands in the room is uniform there. The cover is the flat quadtree of Ebeida,
 * Mitchell, Patney, Davidson & Owens (2012): after each round of darts its squares are cut in four, and those without
 * room left out. In a round every square gets a Poisson number of darts, each at a random time: a Poisson process
 * over the cover. What became of a dart depends on the earlier ones near it only, so it can be asked for in any
 * order, and the order of the memory is the fastest.
 */
#ifndef KOKSMA_PATTERNS_PARTS_DART_COVER_H
#define KOKSMA_PATTERNS_PARTS_DART_COVER_H

#include <koksma/koksma.h>

typedef struct koksma__square {
    uint32_t x, y; /* in units of the squares' size */
} koksma__square;

/* A dart that no point of earlier rounds is near to. */
typedef struct koksma__dart {
    double x, y;
    uint64_t time; /* no two are equal */
    uint32_t cell_x, cell_y;
    bool decided, kept;
} koksma__dart;

typedef struct koksma__disks {
    double d;
    size_t n, room; /* points, and places for them */
    double *xs;     /* pairs */
    uint32_t cells; /* a side; none holds two points */
    size_t stride;  /* of the rows of gx and gy, which have a border of copies, 2 wide */
    size_t places;
    double *gx, *gy;
    int level; /* squares are cells / 2^level wide */
    size_t n_squares, square_room;
    koksma__square *squares;
    koksma__dart *darts; /* of this round, by cell */
    size_t n_darts, dart_room;
    uint32_t *starts; /* the first dart of each cell or of those after it, row by row */
    size_t start_room;
    uint64_t seed, dart; /* the stream of darts */
} koksma__disks;

/* No points yet, for distance d in (0, 0.5]; fini frees what init and the others got. */
koksma_status koksma__disks_init(koksma__disks *disks, uint64_t seed, double d);
void koksma__disks_fini(koksma__disks *disks);

/* Throws darts until there are n points or no room is left (n = SIZE_MAX: until no room is left). With n points, the
   grid may be looked at no more. */
koksma_status koksma__disks_fill(koksma__disks *disks, size_t n, const koksma_run *run);

/* Keeps the first n points and looks for room again with the smaller distance d. */
koksma_status koksma__disks_shrink(koksma__disks *disks, size_t n, double d);

/* Inside a round. push: a dart of the same cell as the last, or of one after it row by row, with the upper half of
   its time. decide: the number of darts that are kept; they are moved to the front of the list. sort: by time. */
koksma_status koksma__darts_push(koksma__disks *disks, koksma__dart dart);
size_t koksma__darts_decide(koksma__disks *disks);
void koksma__darts_sort(koksma__disks *disks, size_t count);

#endif
