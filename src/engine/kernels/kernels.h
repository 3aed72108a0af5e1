/* SPDX-License-Identifier: Apache-2.0 */
/* The table of kernels, and the data that some of them read. */
#ifndef KOKSMA_KERNELS_KERNELS_H
#define KOKSMA_KERNELS_KERNELS_H

#include <koksma/koksma.h>

#include <stddef.h>
#include <stdint.h>

#include "core/random.h"
#include "core/visibility.h"

/* ---- Dart cells ------------------------------------------------------------------------------------------ */

/*
 * A tile of cells in the form that the dart throwing kernels read. A cell has at most one point, whose "place" is its
 * position packed into one 32-bit word: x in the lower half and y in the upper half, measured from the tile's corner,
 * rounded to 2^-12 of a cell, modulo 16 cells. If two places are less than 8 cells apart, the differences of their
 * halves, read as signed 16-bit numbers, are the differences of the positions. One instruction squares and adds the
 * halves of eight words. The place of an empty cell is 6 cells beyond its middle in y, too far away to affect any
 * result.
 */

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

/* ---- Nested node ----------------------------------------------------------------------------------------- */

/* The random bits of nested uniform scrambling in base 2 (the modifier owen): one for each node of the tree of the 53
   binary digits, which flips the next digit. One call of the generator at a node gives the 127 bits of the node and of
   the nodes in the six levels below it: level j has 2^j of them. */

enum {
    KOKSMA__NESTED_DIGITS = 53,
    KOKSMA__NESTED_LEVELS = 7,
    KOKSMA__NESTED_SPARE = 3 /* DIGITS + SPARE is a multiple of LEVELS */
};

/* The random bits at a node: bit 2^j + (the j digits after the node) of the two words, low and high, flips the digit
   that follows these j digits. flips: the flips of the 7 digits before the node, for the kernel nested_bits. */
typedef struct koksma__nested_node {
    uint64_t low, high, flips;
} koksma__nested_node;

/* Returns the random words of the node of the first `top` of the 53 digits of x. */
static inline koksma__words koksma__nested_words(uint64_t seed, uint64_t x, int top, uint32_t lane)
{
    return koksma__random(seed, KOKSMA__PURPOSE_NESTED, (uint64_t)1 << top | x >> (KOKSMA__NESTED_DIGITS - top),
                          lane);
}

static inline koksma__nested_node koksma__nested_node_of(koksma__words r)
{
    return (koksma__nested_node){r.w[0] | (uint64_t)r.w[1] << 32, r.w[2] | (uint64_t)r.w[3] << 32, 0};
}

/* Returns the flips of the 7 digits after a node, which are the lowest 7 bits of `path`. */
static inline uint64_t koksma__nested_flips(koksma__nested_node node, uint64_t path)
{
    const uint64_t p = path & 127;
    return (node.low >> 1 & 1) << 6 | (node.low >> (2 | p >> 6) & 1) << 5 | (node.low >> (4 | p >> 5) & 1) << 4 |
           (node.low >> (8 | p >> 4) & 1) << 3 | (node.low >> (16 | p >> 3) & 1) << 2 |
           (node.low >> (32 | p >> 2) & 1) << 1 | (node.high >> (p >> 1) & 1);
}

/* ---- The table -------------------------------------------------------------------------------------------------- */

typedef struct koksma__kernel_table {
    const char *isa; /* "ref", "baseline", "avx2", "avx512" */
#define KERNEL(result, name, arguments) result(*name) arguments;
#include "kernels/kernels.def"
#undef KERNEL
} koksma__kernel_table;

/* Returns the table of the fastest kernels that this machine supports, or the table that the environment variable
   KOKSMA_KERNELS names (KOKSMA_KERNELS=ref: the reference kernels). The first call makes the choice. */
KOKSMA__LAB const koksma__kernel_table *koksma__kernels(void);

/* Returns the table of kernels with this name, or NULL if this build or machine does not support it. Only for tests
   and benchmarks. */
KOKSMA__LAB const koksma__kernel_table *koksma__kernels_find(const char *isa);

/* In a kernel's source file, KERNEL_NAME(uniform) is the name of that kernel's function for the instruction set being
   compiled. */
#define KOKSMA__JOIN3(a, b, c) a##b##_##c
#define KOKSMA__JOIN(a, b, c) KOKSMA__JOIN3(a, b, c)
#define KERNEL_NAME(name) KOKSMA__JOIN(koksma__kernel_, name, KOKSMA_ISA)

#ifdef KOKSMA_ISA
#define KERNEL(result, name, arguments) result KERNEL_NAME(name) arguments;
#include "kernels/kernels.def"
#undef KERNEL
#endif

#endif
