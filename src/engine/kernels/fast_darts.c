/* SPDX-License-Identifier: Apache-2.0 */
/* Distance tests of dart throwing (see kernels.h), without branches. They find the darts that are far enough from
   all points, and the quarters of squares that no point covers. */
#include "core/random.h"
#include "kernels/kernels.h"
#include "kernels/lanes8.h"

LANES8_INLINE void nearest_of_rows(const uint32_t *cells, size_t stride, uint32_t place, lanes8 *least)
{
    lanes8_pairs at;
    lanes8_splat(place, &at);
    for (int r = 0; r < 5; r++, cells += stride) {
        lanes8_pairs other;
        lanes8 squares;
        lanes8_load(cells, &other);
        other -= at;
        lanes8_squares(&other, &squares);
        if (r) {
            lanes8_min(&squares, least);
        } else {
            *least = squares;
        }
    }
}

int32_t KERNEL_NAME(nearest_place)(const uint32_t *cells, size_t stride, uint32_t place)
{
    lanes8 least;
    nearest_of_rows(cells, stride, place, &least);
    return lanes8_least(&least);
}

size_t KERNEL_NAME(far_darts)(const koksma__dart_cells *c, int32_t low, size_t count, const uint32_t *words,
                              uint32_t *far)
{
    const koksma__dart_cells own = *c;
    size_t found = 0;
    for (size_t i = 0; i < count; i++, words += 4) {
        const uint32_t square = own.squares[koksma__below(words[0], own.count)];
        lanes8 least;
        nearest_of_rows(own.places + koksma__dart_corner(&own, square), own.stride,
                        koksma__dart_place(&own, square, words), &least);
        least -= low;
        far[found] = (uint32_t)i;
        found += !lanes8_signs(&least);
    }
    return found;
}

/* Writes to `out` the places of the points in the 21 cells around a cell (5 x 5 without the corners, whose points
   hardly ever reach a square of the cell), then eight places of an empty cell, so that `out` can be read eight at a
   time. Returns the number of points. */
LANES8_INLINE size_t look_around(const uint32_t *cells, size_t stride, uint32_t cell_x, uint32_t cell_y,
                                 uint32_t *out)
{
    /* After `start` is subtracted, y is in the first 8 of 16 cells for points and in the last 8 for empty cells, so
       that its sign bit distinguishes the two. */
    lanes8_pairs start;
    size_t count = 0;
    lanes8_splat((4 * cell_y - 17) << (KOKSMA__PLACE_BITS + 14), &start);
    for (int r = 0; r < 5; r++, cells += stride) {
        lanes8_pairs places;
        lanes8_load(cells, &places);
        const lanes8 moved = (lanes8)(places - start);
        const unsigned bits = ~lanes8_signs(&moved) & (r % 4 ? 31 : 14);
        lanes8_pick5(&places, bits, out + count);
        count += (size_t)__builtin_popcount(bits);
    }
    lanes8_pairs far;
    lanes8_splat(koksma__no_place(cell_x, cell_y), &far);
    memcpy(out + count, &far, sizeof far);
    return count;
}

/* The four quarters of a square: their centres `at`, half of their side (in x and in y), and squared distances to
   places. */
typedef struct four {
    lanes8_pairs at[4], half;
    lanes8 least[4]; /* the smallest squared distance, in each lane, from a place to a quarter's far corner */
} four;

LANES8_INLINE void set_quarters(uint32_t square, uint32_t half, four *q)
{
    const uint32_t x = (4 * (square & 0xffff) + 1) * half, y = (4 * (square >> 16) + 1) * half;
    lanes8_splat(koksma__place(x, y), &q->at[0]);
    lanes8_splat(koksma__place(x + 2 * half, y), &q->at[1]);
    lanes8_splat(koksma__place(x, y + 2 * half), &q->at[2]);
    lanes8_splat(koksma__place(x + 2 * half, y + 2 * half), &q->at[3]);
    lanes8_splat(koksma__place(half, half), &q->half);
}

/* Updates `least` with eight places; the first call for a square initialises it. */
LANES8_INLINE void look_at(const lanes8_pairs *places, bool first, four *q)
{
    for (int k = 0; k < 4; k++) {
        lanes8_pairs far_end = *places - q->at[k];
        lanes8 squares;
        lanes8_absolute(&far_end);
        far_end += q->half;
        lanes8_squares(&far_end, &squares);
        if (first) {
            q->least[k] = squares;
        } else {
            lanes8_min(&squares, &q->least[k]);
        }
    }
}

/* Appends those quarters of a square that are not covered. */
LANES8_INLINE size_t put_quarters(uint32_t square, unsigned covered, uint32_t *out)
{
    const lanes4 quarters = (lanes4){0, 1, 0x10000, 0x10001} + 2 * square;
    const unsigned open = ~covered & 15;
    lanes4_pick(&quarters, open, out);
    return (size_t)__builtin_popcount(open);
}

/* Used for squares so large that points outside the eight neighbour cells hardly ever cover a quarter. Each row is
   read as four cells, one more than needed. The loop has no branches, and its iterations are independent. */
static size_t open_large_quarters(const koksma__dart_cells *c, int32_t low, uint32_t *out)
{
    const koksma__dart_cells own = *c;
    const uint32_t half = KOKSMA__PLACE_UNITS / 4 >> own.level;
    size_t kept = 0;
    for (size_t i = 0; i < own.count; i++) {
        const uint32_t square = own.squares[i];
        const uint32_t cell_x = (square & 0xffff) >> own.level, cell_y = square >> 16 >> own.level;
        const uint32_t *cells = own.places + (cell_y + 1) * own.stride + cell_x + 1;
        lanes8_pairs above_below, beside;
        four q;
        lanes8_load_halves(cells, cells + 2 * own.stride, &above_below);
        lanes8_load_halves(cells + own.stride, cells + own.stride, &beside);
        set_quarters(square, half, &q);
        look_at(&above_below, true, &q);
        look_at(&beside, false, &q);
        const bool full = cells[own.stride + 1] != koksma__no_place(cell_x, cell_y);
        kept += put_quarters(square, lanes8_below(q.least, low) | (full ? 15u : 0), out + kept);
    }
    return kept;
}

/* Used for smaller squares: the places around a cell are collected once for all squares of the cell. */
static size_t open_small_quarters(const koksma__dart_cells *c, int32_t low, uint32_t *out)
{
    const koksma__dart_cells own = *c;
    const uint32_t half = KOKSMA__PLACE_UNITS / 4 >> own.level;
    const uint32_t mask = ~(((1u << own.level) - 1) * 0x10001); /* mask for the bits of a square that contain its cell
                                                                   */
    uint32_t cell = UINT32_MAX, around[40];
    size_t kept = 0, count = 0;
    bool full = false;
    for (size_t i = 0; i < own.count; i++) {
        const uint32_t square = own.squares[i];
        if ((square & mask) != cell) {
            const uint32_t cell_x = (square & 0xffff) >> own.level, cell_y = square >> 16 >> own.level;
            const uint32_t *cells = own.places + koksma__dart_corner(&own, square);
            cell = square & mask;
            full = cells[2 * own.stride + 2] != koksma__no_place(cell_x, cell_y);
            if (!full) {
                count = look_around(cells, own.stride, cell_x, cell_y, around);
            }
        }
        if (full) {
            continue;
        }
        lanes8_pairs places;
        four q;
        set_quarters(square, half, &q);
        lanes8_load(around, &places);
        look_at(&places, true, &q);
        for (size_t k = 8; k < count; k += 8) {
            lanes8_load(around + k, &places);
            look_at(&places, false, &q);
        }
        kept += put_quarters(square, lanes8_below(q.least, low), out + kept);
    }
    return kept;
}

size_t KERNEL_NAME(open_quarters)(const koksma__dart_cells *c, int32_t low, uint32_t *out)
{
    return c->level < 2 ? open_large_quarters(c, low, out) : open_small_quarters(c, low, out);
}
