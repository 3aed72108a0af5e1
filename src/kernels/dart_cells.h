/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the kernels of dart throwing know of a tile of cells: the place of each cell's point, one word a cell, x in
 * its lower half and y in its upper half, in 2^-12 of a cell from the tile's corner, to the nearest, modulo 16 cells.
 * So the difference of two places less than 8 cells apart is that of their halves, whichever cells they are of, and
 * one instruction squares and adds the halves of eight. An empty cell has a place 6 cells beyond its middle in y.
 */
#ifndef KOKSMA_KERNELS_DART_CELLS_H
#define KOKSMA_KERNELS_DART_CELLS_H

#include <stddef.h>
#include <stdint.h>

enum { KOKSMA__PLACE_BITS = 12, KOKSMA__PLACE_UNITS = 1 << KOKSMA__PLACE_BITS, KOKSMA__PACKED_LEVEL = 8 };

typedef struct koksma__dart_cells {
    const uint32_t *places; /* of the cell two before cell (0, 0) in x and in y */
    size_t stride;          /* from row to row; three more cells than the rows need, for reading past them */
    int level;              /* squares are 2^-level of a cell wide, at most KOKSMA__PACKED_LEVEL */
    uint32_t count;
    const uint32_t *squares; /* x and y in their own widths from the tile's corner, as a place; a cell's in a row */
} koksma__dart_cells;

static inline uint32_t koksma__place(uint32_t x, uint32_t y)
{
    return (x & 0xffff) | y << 16;
}

static inline uint32_t koksma__no_place(uint32_t cell_x, uint32_t cell_y)
{
    return koksma__place((2 * cell_x + 1) * (KOKSMA__PLACE_UNITS / 2), (2 * cell_y + 13) * (KOKSMA__PLACE_UNITS / 2));
}

/* The square of the distance of two places less than 8 cells apart in x and in y. */
static inline int32_t koksma__place_distance(uint32_t a, uint32_t b)
{
    const int32_t x = (int16_t)(b - a), y = (int16_t)((b >> 16) - (a >> 16));
    return x * x + y * y;
}

/* A dart at fractions words[1] / 2^32 and words[2] / 2^32 of a square. */
static inline uint32_t koksma__dart_place(const koksma__dart_cells *c, uint32_t square, const uint32_t *words)
{
    const int finer = KOKSMA__PLACE_BITS - c->level;
    const uint32_t x = ((words[1] >> (31 - finer)) + 1) >> 1, y = ((words[2] >> (31 - finer)) + 1) >> 1;
    return koksma__place(((square & 0xffff) << finer) + x, ((square >> 16) << finer) + y);
}

/* Where the 5 x 8 cells about the cell of a square begin in places. */
static inline size_t koksma__dart_corner(const koksma__dart_cells *c, uint32_t square)
{
    return (square >> 16 >> c->level) * c->stride + ((square & 0xffff) >> c->level);
}

#endif
