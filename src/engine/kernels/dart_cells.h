/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A tile of cells in the form that the dart throwing kernels read. A cell has at most one point, whose "place" is its
 * position packed into one 32-bit word: x in the lower half and y in the upper half, measured from the tile's corner,
 * rounded to 2^-12 of a cell, modulo 16 cells. If two places are less than 8 cells apart, the differences of their
 * halves, read as signed 16-bit numbers, are the differences of the positions. One instruction squares and adds the
 * halves of eight words. The place of an empty cell is 6 cells beyond its middle in y, too far away to affect any
 * result.
 */
#ifndef KOKSMA_KERNELS_DART_CELLS_H
#define KOKSMA_KERNELS_DART_CELLS_H

#include <stddef.h>
#include <stdint.h>

enum { KOKSMA__PLACE_BITS = 12, KOKSMA__PLACE_UNITS = 1 << KOKSMA__PLACE_BITS, KOKSMA__PACKED_LEVEL = 8 };

typedef struct koksma__dart_cells {
    const uint32_t *places; /* the places of all cells, row by row, beginning with cell (-2, -2) */
    size_t stride;          /* number of cells in a row, including three spare cells because kernels read past the end
                            */
    int level;              /* squares are 2^-level cells wide; level is at most KOKSMA__PACKED_LEVEL */
    uint32_t count;
    const uint32_t *squares; /* the squares, sorted by cell: x and y in units of their width, packed like a place */
} koksma__dart_cells;

static inline uint32_t koksma__place(uint32_t x, uint32_t y)
{
    return (x & 0xffff) | y << 16;
}

static inline uint32_t koksma__no_place(uint32_t cell_x, uint32_t cell_y)
{
    return koksma__place((2 * cell_x + 1) * (KOKSMA__PLACE_UNITS / 2), (2 * cell_y + 13) * (KOKSMA__PLACE_UNITS / 2));
}

/* Returns the squared distance of two places that are less than 8 cells apart in x and in y. */
static inline int32_t koksma__place_distance(uint32_t a, uint32_t b)
{
    const int32_t x = (int16_t)(b - a), y = (int16_t)((b >> 16) - (a >> 16));
    return x * x + y * y;
}

/* Returns the place of a dart at the fractions words[1] / 2^32 (in x) and words[2] / 2^32 (in y) of a square. */
static inline uint32_t koksma__dart_place(const koksma__dart_cells *c, uint32_t square, const uint32_t *words)
{
    const int finer = KOKSMA__PLACE_BITS - c->level;
    const uint32_t x = ((words[1] >> (31 - finer)) + 1) >> 1, y = ((words[2] >> (31 - finer)) + 1) >> 1;
    return koksma__place(((square & 0xffff) << finer) + x, ((square >> 16) << finer) + y);
}

/* Returns the index in c->places at which the 5 rows of 8 cells around the cell of a square begin. */
static inline size_t koksma__dart_corner(const koksma__dart_cells *c, uint32_t square)
{
    return (square >> 16 >> c->level) * c->stride + ((square & 0xffff) >> c->level);
}

#endif
