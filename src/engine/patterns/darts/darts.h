/* SPDX-License-Identifier: Apache-2.0 */
/* Dart throwing without wasted darts, in the plane and in 3 to 6 dimensions. Each section is the interface of the file
   of its name. */
#ifndef KOKSMA_PATTERNS_DARTS_DARTS_H
#define KOKSMA_PATTERNS_DARTS_DARTS_H

#include <koksma/koksma.h>

#include "core/visibility.h"
#include "kernels/kernels.h"

/* ---- Dart tiles ------------------------------------------------------------------------------------------ */

/* The state of dart throwing: points, cells, tiles and squares. */

typedef struct koksma__square {
    uint32_t x, y; /* position in the whole grid, in units of the side of a square */
} koksma__square;

/* A dart that waits for the end of the round. */
typedef struct koksma__dart {
    double x, y, time;
    uint32_t place, tile, next;
    uint16_t cell_x, cell_y;
} koksma__dart;

/* A tile of the grid: its cells are x .. x + nx - 1 by y .. y + ny - 1. */
typedef struct koksma__tile {
    uint32_t number, x, y, nx, ny;
} koksma__tile;

enum {
    KOKSMA__DART_WORDS = 256,
    KOKSMA__DART_BORDER = 2,
    KOKSMA__DART_TILE = 128 /* largest number of cells on a side of a tile */
};

typedef struct koksma__disks {
    const koksma__kernel_table *kernels;
    double d;
    size_t n, room; /* n: number of points; room: capacity of xs in points */
    double *xs;     /* the points, x and y alternating */
    double *times;  /* arrival times of the points of this round; used only with several tiles */
    uint32_t cells; /* number of cells on a side of the torus; a cell has at most one point */
    uint32_t tiles; /* number of tiles on a side of the torus */
    size_t wide;    /* number of cells on a side of the largest tile */
    size_t stride;  /* length of a row of cells: `wide`, a border of two cells on each side, and three spare ones */
    size_t block;   /* distance in `places` from one tile to the next */
    size_t places_room, who_room;
    uint32_t *places;  /* fixed-point position of the point in each cell, by tile, with borders */
    uint32_t *who;     /* index of the point in each cell, by tile, without borders; UINT32_MAX: none */
    int32_t low, high; /* squared fixed-point distances: below `low` a point is near, above `high` it is not; between
                          them doubles decide */
    int32_t cover;     /* if the far corner of a square has a smaller squared distance, the square is certainly
                       covered */
    int level;         /* squares are 2^-level cells wide */
    size_t n_squares, square_room, spare_room, first_room;
    void *squares, *spare; /* squares by tile: packed words (kernels/kernels.h) up to KOKSMA__PACKED_LEVEL, then
                              koksma__square */
    size_t *first;         /* index of the first square of each tile; at the end the number of squares */
    koksma__dart *waiting;
    size_t n_waiting, waiting_room;
    uint64_t seed, dart; /* the random stream of darts and the next dart's number in it */
    uint32_t words[4 * KOKSMA__DART_WORDS];
    size_t used, drawn; /* number of groups of four random words used so far, and number drawn so far */
} koksma__disks;

/* Prepares an empty set for distance d in (0, 0.75]; koksma__disks_fini frees all memory of `disks`. */
koksma_status koksma__disks_init(koksma__disks *disks, uint64_t seed, double d);
void koksma__disks_fini(koksma__disks *disks);

/* Makes an empty grid for distance d; the array of points stays. Errors: MEMORY. */
koksma_status koksma__disks_clear(koksma__disks *disks, double d);

/* Puts point number i into its cell and into the copies of the cell in borders of other tiles. */
void koksma__disks_put(koksma__disks *disks, const koksma__tile *tile, uint32_t cell_x, uint32_t cell_y,
                       uint32_t place, size_t i);

/* Returns the first cell of tile number `tile` along an axis. */
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

/* Returns the index in `places` at which the 5 x 8 cells around a cell of a tile begin. */
static inline size_t koksma__disks_corner(const koksma__disks *s, uint32_t tile, uint32_t cell_x, uint32_t cell_y)
{
    return tile * s->block + cell_y * s->stride + cell_x;
}

/* Returns the cells and squares of a tile as kernels need them; valid only up to KOKSMA__PACKED_LEVEL, while squares
   are packed. */
static inline koksma__dart_cells koksma__disks_cells(const koksma__disks *s, const koksma__tile *t)
{
    const size_t first = s->first[t->number], end = s->first[t->number + 1];
    return (koksma__dart_cells){.places = s->places + t->number * s->block,
                                .stride = s->stride,
                                .level = s->level,
                                .count = (uint32_t)(end - first),
                                .squares = (const uint32_t *)s->squares + first};
}

/* Returns square number i of all lists, which has to belong to tile t. */
static inline koksma__square koksma__disks_square(const koksma__disks *s, const koksma__tile *t, size_t i)
{
    if (s->level > KOKSMA__PACKED_LEVEL) {
        return ((const koksma__square *)s->squares)[i];
    }
    const uint32_t packed = ((const uint32_t *)s->squares)[i];
    return (koksma__square){(t->x << s->level) + (packed & 0xffff), (t->y << s->level) + (packed >> 16)};
}

/* Returns the index in `who` of a cell of a tile. */
static inline size_t koksma__disks_own(const koksma__disks *s, uint32_t tile, uint32_t cell_x, uint32_t cell_y)
{
    return (tile * s->wide + cell_y) * s->wide + cell_x;
}

/* Returns the index of the point in a cell of the grid; UINT32_MAX: none. */
static inline uint32_t koksma__disks_who(const koksma__disks *s, uint32_t cell_x, uint32_t cell_y)
{
    const uint32_t tx = koksma__disks_tile_of(s, cell_x), ty = koksma__disks_tile_of(s, cell_y);
    return s->who[koksma__disks_own(s, ty * s->tiles + tx, cell_x - koksma__disks_start(s, tx),
                                    cell_y - koksma__disks_start(s, ty))];
}

/* ---- Dart cover ------------------------------------------------------------------------------------------ */

/*
 * Dart throwing on the 2D torus without wasted darts. The points have the distribution of simple dart throwing: darts
 * are uniform, and a dart is kept if it is at least d from all darts kept before. Darts are thrown only at a cover of
 * the free area, made of squares of equal size, so that a dart that lands in the free area is uniform there. The
 * cover is the flat quadtree of Ebeida, Mitchell, Patney, Davidson & Owens (2012): after each round of darts each
 * square is cut into four, and squares without free area are dropped.
 *
 * A grid that fits into the cache is one tile. A larger grid is cut into tiles that fit. In each tile the darts of a
 * round arrive as a Poisson process in time; all tiles together are one Poisson process over the cover. Whether a
 * dart is kept depends only on earlier darts near it. Each tile thus decides its darts in order of time. Darts near
 * its border may depend on another tile; these darts, and later darts near them, wait until the end of the round and
 * are then decided in order of time. The points therefore have the same distribution as with a single tile, and most
 * darts access only memory in the cache.
 *
 * Positions are also stored as fixed-point numbers in units of 2^-12 of a cell (kernels/kernels.h), which decide
 * almost all cases; only the closest ones are decided with doubles. Darts are drawn in batches of some hundreds.
 * The darts of a batch that are too near to points of earlier batches are dropped in one pass; the others are decided
 * one by one. The cover may contain squares without free area, because all darts in them are dropped anyway.
 * Therefore only the nearest cells are examined for large squares.
 */

/* Throws darts until there are n points or no free area is left; with n = SIZE_MAX until no free area is left. When
   it stops at n points, the grid may be incomplete and must not be used. */
koksma_status koksma__disks_fill(koksma__disks *disks, size_t n, const koksma_run *run);

/* Keeps the first n points and makes the cover of the free area for the smaller distance d. */
koksma_status koksma__disks_shrink(koksma__disks *disks, size_t n, double d);

/* Cuts each square into four and keeps the quarters with free area. */
koksma_status koksma__disks_refine(koksma__disks *disks);

/* ---- Dart round ------------------------------------------------------------------------------------------ */

/* One round of dart throwing. */

/* Throws a round of darts, on average `mean` at each square; stops at n points. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__darts_throw(koksma__disks *disks, double mean, size_t n, const koksma_run *run);

/* ---- Ball cover ------------------------------------------------------------------------------------------ */

/*
 * Dart throwing on the torus in 3 to 6 dimensions without wasted darts: the method of the plane for more
 * dimensions than 2. The points have the distribution of simple dart throwing: darts are uniform, and a dart is kept
 * if it is at least d from all darts kept before. Darts are thrown only at a cover of the free volume, made of cubes
 * of equal size; after each round each cube is cut into 2^dim, and those inside one ball of radius d are dropped.
 * Source: Ebeida, Mitchell, Patney, Davidson & Owens 2012.
 *
 * The number of cubes first grows and then shrinks. At its maximum it is about 12 times the number of points in 3
 * dimensions, 65 times in 4, 600 times in 5 and 4,500 times in 6. If the cover needs more than KOKSMA__BALL_BYTES, the
 * call fails with KOKSMA_IMPOSSIBLE and the error text of koksma__balls_fill.
 */

enum { KOKSMA__BALL_DIMS = 6 };

#define KOKSMA__BALL_BYTES ((size_t)1 << 30) /* limit of the memory of one list of cubes */

typedef struct koksma__balls {
    int dim;
    double d;
    size_t n, room; /* number of points, and capacity of xs and next */
    double *xs;
    uint32_t side;  /* number of cells along an axis, at least d wide; 1 if fewer than 3 would fit */
    uint32_t *head; /* the last point of each cell; UINT32_MAX: none */
    uint32_t *next; /* for each point: the point before it in the same cell, or UINT32_MAX */
    size_t head_room;
    uint32_t along;                        /* number of cubes along an axis of the torus */
    uint32_t *cubes;                       /* dim integer coordinates for each cube of the cover */
    size_t n_cubes, cube_room, most_cubes; /* most_cubes: the largest n_cubes so far */
    uint64_t seed, dart;                   /* the random stream of darts and the next dart's number in it */
} koksma__balls;

/* Prepares an empty set for distance d > 0 in 3 to KOKSMA__BALL_DIMS dimensions. */
koksma_status koksma__balls_init(koksma__balls *balls, uint64_t seed, int dim, double d);
void koksma__balls_fini(koksma__balls *balls);

/* Throws darts until there are n points or no free volume is left; n = SIZE_MAX: until none is left. */
koksma_status koksma__balls_fill(koksma__balls *balls, size_t n, const koksma_run *run);

/* Keeps the first n points and makes the cover of the free volume for the smaller distance d. */
koksma_status koksma__balls_shrink(koksma__balls *balls, size_t n, double d, const koksma_run *run);

/* Returns the mean of n d^dim over maximal sets in 2 and more dimensions, from saturated random sequential addition
   of balls of diameter d (Zhang & Torquato 2013). */
double koksma__balls_per_volume(int dim);

/* ---- Maximal search -------------------------------------------------------------------------------------- */

/* Maximal Poisson-disk sets of a given number of points. */

/* Keeps the first `kept` points of a set, lowers its distance to d and adds points until no point fits or it has n
   points; writes the number of its points to *found. */
typedef koksma_status (*koksma__maximal_try)(void *set, size_t kept, double d, size_t n, const koksma_run *run,
                                             size_t *found);

/* Extends a maximal set of `kept` < n points with the distance d to one of n points by lowering the distance. dim: the
   free volume grows as the power dim of a length (2 on a surface). Errors: IMPOSSIBLE (the search has ended without n
   points; another seed would do), and the errors of `attempt`. */
KOKSMA__LAB koksma_status koksma__maximal_shrink(int dim, double d, size_t kept, size_t n, const koksma_run *run,
                                                 koksma__maximal_try attempt, void *set);

#endif
