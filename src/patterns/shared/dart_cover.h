/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Dart throwing on the 2D torus without wasted darts. The distribution is that of throwing uniform darts and keeping
 * those at least d from all kept ones. Darts are thrown at a cover of the free area only, made of squares of equal
 * size, so that a dart that lands in the free area is uniform there. The cover is the flat quadtree of Ebeida,
 * Mitchell, Patney, Davidson & Owens (2012): after each round of darts each square is cut into four, and squares
 * without free area are dropped.
 *
 * A grid that fits into the cache is one tile. A larger grid is cut into tiles that fit. In each tile the darts of a
 * round arrive as a Poisson process in time; together these are one Poisson process over the cover. Whether a dart
 * is kept depends only on earlier darts near it. So a tile decides its darts in order of time, except those near its
 * border, which may depend on another tile, and later ones near such a dart: these wait for the end of the round and
 * are then decided in order of time. The distribution is therefore the same, and most darts need only memory that is
 * in the cache.
 *
 * Places are also kept in 2^-12 of a cell (kernels/dart_cells.h): enough to decide all but the closest cases, which
 * are decided by the doubles. Darts are drawn in batches of some hundreds. Those too near to points of earlier
 * batches are dropped together; the rest is decided one by one. The cover may hold squares without free area, since
 * a dart there is too near to a point and is dropped; so for large squares only the nearest cells are examined.
 */
#ifndef KOKSMA_PATTERNS_SHARED_DART_COVER_H
#define KOKSMA_PATTERNS_SHARED_DART_COVER_H

#include <koksma/koksma.h>

#include "kernels/kernels.h"

typedef struct koksma__square {
    uint32_t x, y; /* in units of the squares' size, in the whole grid */
} koksma__square;

/* A dart that is not decided in its tile. */
typedef struct koksma__dart {
    double x, y, time;
    uint32_t place, tile, next;
    uint16_t cell_x, cell_y;
} koksma__dart;

/* A tile: cells x .. x + nx - 1, y .. y + ny - 1. */
typedef struct koksma__tile {
    uint32_t number, x, y, nx, ny;
} koksma__tile;

enum { KOKSMA__DART_WORDS = 256, KOKSMA__DART_BORDER = 2, KOKSMA__DART_TILE = 128 /* cells a side, at most */ };

typedef struct koksma__disks {
    const koksma__kernel_table *kernels;
    double d;
    size_t n, room; /* points, and how many xs has room for */
    double *xs;     /* pairs */
    double *times;  /* of the points of this round, where there are several tiles */
    uint32_t cells; /* a side; none holds two points */
    uint32_t tiles; /* a side */
    size_t wide;    /* cells a side of the largest tile */
    size_t stride;  /* of the rows of cells, where each tile has a border of two copies, and three more after it */
    size_t block;   /* from tile to tile in places */
    size_t places_room, who_room;
    uint32_t *places;
    uint32_t *who;     /* the point of each cell, by tile, without border; UINT32_MAX: none */
    int32_t low, high; /* squares of distances of places: below is near, above is not, between the doubles tell */
    int32_t cover;     /* and of a place from the far end of a square: below is surely covered */
    int level;         /* squares are cells / 2^level wide */
    size_t n_squares, square_room, spare_room, first_room;
    void *squares, *spare; /* by tile; packed words (kernels/dart_cells.h) up to KOKSMA__PACKED_LEVEL, then squares */
    size_t *first;         /* square of each tile, and the number of squares */
    koksma__dart *waiting;
    size_t n_waiting, waiting_room;
    uint64_t seed, dart; /* the stream of darts */
    uint32_t words[4 * KOKSMA__DART_WORDS];
    size_t used, drawn; /* of the words, in fours */
} koksma__disks;

/* No points yet, for distance d in (0, 0.75]; fini frees what init and the others got. */
koksma_status koksma__disks_init(koksma__disks *disks, uint64_t seed, double d);
void koksma__disks_fini(koksma__disks *disks);

/* Throws darts until there are n points or no room is left (n = SIZE_MAX: until no room is left). With n points, the
   grid may be looked at no more. */
koksma_status koksma__disks_fill(koksma__disks *disks, size_t n, const koksma_run *run);

/* Keeps the first n points and looks for room again with the smaller distance d. */
koksma_status koksma__disks_shrink(koksma__disks *disks, size_t n, double d);

/* Inside. A round of darts, on average `mean` at each square; no more than n points afterwards. */
koksma_status koksma__darts_throw(koksma__disks *disks, double mean, size_t n, const koksma_run *run);

/* Point number i goes into its cell and into the copies of the cell in borders. */
void koksma__disks_put(koksma__disks *disks, const koksma__tile *tile, uint32_t cell_x, uint32_t cell_y,
                       uint32_t place, size_t i);

/* Cuts the squares in four and keeps those with room. */
koksma_status koksma__disks_refine(koksma__disks *disks);

/* The first cell of tile number `tile` along an axis; below, the tile that holds a cell. */
static inline uint32_t koksma__disks_start(const koksma__disks *s, uint32_t tile)
{
    return (uint32_t)((uint64_t)tile * s->cells / s->tiles);
}

static inline uint32_t koksma__disks_tile_of(const koksma__disks *s, uint32_t cell)
{
    return (uint32_t)((((uint64_t)cell + 1) * s->tiles - 1) / s->cells);
}

static inline koksma__tile koksma__disks_tile(const koksma__disks *s, uint32_t number)
{
    const uint32_t tx = number % s->tiles, ty = number / s->tiles;
    koksma__tile t = {number, koksma__disks_start(s, tx), koksma__disks_start(s, ty), 0, 0};
    t.nx = koksma__disks_start(s, tx + 1) - t.x;
    t.ny = koksma__disks_start(s, ty + 1) - t.y;
    return t;
}

/* Where the 5 x 8 cells about a cell of a tile begin in places. */
static inline size_t koksma__disks_corner(const koksma__disks *s, uint32_t tile, uint32_t cell_x, uint32_t cell_y)
{
    return tile * s->block + cell_y * s->stride + cell_x;
}

/* A tile's cells and squares as the kernels see them; they can't see squares that are not packed. */
static inline koksma__dart_cells koksma__disks_cells(const koksma__disks *s, const koksma__tile *t)
{
    const size_t first = s->first[t->number], end = s->first[t->number + 1];
    return (koksma__dart_cells){.places = s->places + t->number * s->block,
                                .stride = s->stride,
                                .level = s->level,
                                .count = (uint32_t)(end - first),
                                .squares = (const uint32_t *)s->squares + first};
}

/* Number i of the list, which is one of a tile. */
static inline koksma__square koksma__disks_square(const koksma__disks *s, const koksma__tile *t, size_t i)
{
    if (s->level > KOKSMA__PACKED_LEVEL) {
        return ((const koksma__square *)s->squares)[i];
    }
    const uint32_t packed = ((const uint32_t *)s->squares)[i];
    return (koksma__square){(t->x << s->level) + (packed & 0xffff), (t->y << s->level) + (packed >> 16)};
}

/* The place in who. */
static inline size_t koksma__disks_own(const koksma__disks *s, uint32_t tile, uint32_t cell_x, uint32_t cell_y)
{
    return (tile * s->wide + cell_y) * s->wide + cell_x;
}

/* The point of a cell of the grid; UINT32_MAX: none. */
static inline uint32_t koksma__disks_who(const koksma__disks *s, uint32_t cell_x, uint32_t cell_y)
{
    const uint32_t tx = koksma__disks_tile_of(s, cell_x), ty = koksma__disks_tile_of(s, cell_y);
    return s->who[koksma__disks_own(s, ty * s->tiles + tx, cell_x - koksma__disks_start(s, tx),
                                    cell_y - koksma__disks_start(s, ty))];
}

#endif
