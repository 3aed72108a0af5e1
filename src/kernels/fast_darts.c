/* SPDX-License-Identifier: Apache-2.0 */
/* The questions of dart throwing (dart_cells.h), of many darts and of many squares at a time without branches. */
#include "core/random.h"
#include "kernels/kernels.h"
#include "kernels/lanes8.h"

int32_t KERNEL_NAME(nearest_place)(const uint32_t *cells, size_t stride, uint32_t place);
size_t KERNEL_NAME(far_darts)(const koksma__dart_cells *c, int32_t low, size_t count, const uint32_t *words,
                              uint32_t *far);
size_t KERNEL_NAME(open_quarters)(const koksma__dart_cells *c, int32_t low, koksma__square *out);

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
        const koksma__square square = own.squares[koksma__below(words[0], own.count)];
        lanes8 least;
        nearest_of_rows(own.places + koksma__dart_corner(&own, square), own.stride,
                        koksma__dart_place(&own, square, words), &least);
        least -= low;
        far[found] = (uint32_t)i;
        found += !lanes8_signs(&least);
    }
    return found;
}

/* The points of the cells that a square of the cell can be in reach of, but those at the corners, which hardly are:
   21 of them, and at least eight places far away. Returns how many. */
LANES8_INLINE size_t look_around(const uint32_t *cells, size_t stride, uint32_t cell_x, uint32_t cell_y,
                                 uint32_t *out)
{
    /* Moved so that points are in the first 8 cells of y, of 16, and the places of empty cells are not. */
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

/* Bit 4q and the following: whether places cover quarter q of a square. */
LANES8_INLINE unsigned covered(size_t count, const uint32_t *places, const uint32_t middles[4], uint32_t half,
                               int32_t low)
{
    lanes8_pairs at[4], reach;
    lanes8 least[4];
    lanes8_splat(half << 16 | half, &reach);
    for (int q = 0; q < 4; q++) {
        lanes8_splat(middles[q], &at[q]);
        least[q] = (lanes8){0} + INT32_MAX;
    }
    for (size_t i = 0; i < count; i += 8) {
        lanes8_pairs some;
        lanes8_load(places + i, &some);
        for (int q = 0; q < 4; q++) {
            lanes8_pairs far_end = some - at[q];
            lanes8 squares;
            lanes8_absolute(&far_end);
            far_end += reach;
            lanes8_squares(&far_end, &squares);
            lanes8_min(&squares, &least[q]);
        }
    }
    unsigned found = 0;
    for (int q = 0; q < 4; q++) {
        least[q] -= low;
        found |= (unsigned)(lanes8_signs(&least[q]) != 0) << q;
    }
    return found;
}

size_t KERNEL_NAME(open_quarters)(const koksma__dart_cells *c, int32_t low, koksma__square *out)
{
    const koksma__dart_cells own = *c;
    const uint32_t half = KOKSMA__PLACE_UNITS / 4 >> own.level;
    uint32_t cell_x = UINT32_MAX, cell_y = UINT32_MAX, around[40];
    size_t kept = 0, count = 0;
    bool full = false;
    for (size_t i = 0; i < own.count; i++) {
        const koksma__square square = own.squares[i];
        const uint32_t in_x = (square.x >> own.level) - own.x, in_y = (square.y >> own.level) - own.y;
        if (in_x != cell_x || in_y != cell_y) {
            const uint32_t *cells = own.places + in_y * own.stride + in_x;
            cell_x = in_x;
            cell_y = in_y;
            full = cells[2 * own.stride + 2] != koksma__no_place(cell_x, cell_y);
            if (!full) {
                count = look_around(cells, own.stride, cell_x, cell_y, around);
            }
        }
        if (full) {
            continue;
        }
        const uint32_t x = (4 * square.x + 1) * half - (own.x << KOKSMA__PLACE_BITS);
        const uint32_t y = (4 * square.y + 1) * half - (own.y << KOKSMA__PLACE_BITS);
        const uint32_t middles[4] = {koksma__place(x, y), koksma__place(x + 2 * half, y),
                                     koksma__place(x, y + 2 * half), koksma__place(x + 2 * half, y + 2 * half)};
        const unsigned without = ~covered(count, around, middles, half, low);
        for (uint32_t q = 0; q < 4; q++) {
            out[kept] = (koksma__square){2 * square.x + (q & 1), 2 * square.y + (q >> 1)};
            kept += without >> q & 1;
        }
    }
    return kept;
}
