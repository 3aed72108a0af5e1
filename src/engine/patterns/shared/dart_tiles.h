/* SPDX-License-Identifier: Apache-2.0 */
/* The state of dart throwing (dart_cover.h): points, cells, tiles and squares. */
#ifndef KOKSMA_PATTERNS_SHARED_DART_TILES_H
#define KOKSMA_PATTERNS_SHARED_DART_TILES_H

#include <koksma/koksma.h>

#include "kernels/kernels.h"

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
    void *squares, *spare; /* squares by tile: packed words (kernels/dart_cells.h) up to KOKSMA__PACKED_LEVEL, then
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

#endif
