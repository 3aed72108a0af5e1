/* SPDX-License-Identifier: Apache-2.0 */
/* Points into the cells of a grid, both coordinates of several points at once. A quotient by a power of two is a
   product by its reciprocal, to the bit; the reference divides. */
#include <math.h>

#include "kernels/kernels.h"
#include "kernels/lanes64.h"

void KERNEL_NAME(cells_2d)(double start, double width, size_t nx, size_t ny, double *xs);
void KERNEL_NAME(rooks_2d)(const uint32_t *words, const uint32_t *rows, size_t first, size_t count, size_t n,
                           double *xs);

enum { POINTS = LANES64 / 2 };

/* Numbers of cells along x and y; the lanes alternate. exact: both are powers of two. */
typedef struct grid {
    double m[2];
    lanes64_d ms, inverses;
    bool exact;
} grid;

static grid make_grid(size_t nx, size_t ny)
{
    grid g = {.m = {(double)nx, (double)ny}, .exact = (nx & (nx - 1)) == 0 && (ny & (ny - 1)) == 0};
    for (int l = 0; l < LANES64; l++) {
        g.ms[l] = g.m[l % 2];
        g.inverses[l] = 1 / g.m[l % 2];
    }
    return g;
}

/* koksma__in_cell, which takes the quotient if it is below the cell's end, else the double before the end. */
static inline lanes64_d in_cells(const grid *g, lanes64_d cells, lanes64_d u, bool exact)
{
    const lanes64_d places = cells + u, ends = cells + 1;
    const lanes64_d x = exact ? places * g->inverses : places / g->ms;
    const lanes64_d last = (exact ? ends * g->inverses : ends / g->ms) * (1 - 0x1p-53);
    const lanes64_u below = (lanes64_u)(x < last);
    return (lanes64_d)(((lanes64_u)x & below) | ((lanes64_u)last & ~below));
}

static double in_cell(const grid *g, int k, double cell, double u)
{
    const double x = (cell + u) / g->m[k], end = (cell + 1) / g->m[k];
    return x < end ? x : end * (1 - 0x1p-53);
}

static inline __attribute__((always_inline)) void place_cells(const grid *g, double start, double width, bool exact,
                                                              size_t nx, size_t ny, double *xs)
{
    lanes64_d first, next, along_x;
    for (int l = 0; l < LANES64; l++) {
        first[l] = l % 2 ? l / 2 : 0;
        next[l] = l % 2 ? POINTS : 0;
        along_x[l] = l % 2 ? 0 : 1;
    }
    for (size_t i = 0; i < nx; i++, first += along_x) {
        size_t j = 0;
        lanes64_d cells = first;
        for (; j + POINTS <= ny; j += POINTS, xs += LANES64, cells += next) {
            lanes64_d u;
            memcpy(&u, xs, sizeof u);
            u = in_cells(g, cells, start + width * u, exact);
            memcpy(xs, &u, sizeof u);
        }
        for (; j < ny; j++, xs += 2) {
            xs[0] = in_cell(g, 0, (double)i, start + width * xs[0]);
            xs[1] = in_cell(g, 1, (double)j, start + width * xs[1]);
        }
    }
}

void KERNEL_NAME(cells_2d)(double start, double width, size_t nx, size_t ny, double *xs)
{
    const grid g = make_grid(nx, ny);
    if (g.exact) {
        place_cells(&g, start, width, true, nx, ny, xs);
    } else {
        place_cells(&g, start, width, false, nx, ny, xs);
    }
}

typedef uint32_t half_lanes __attribute__((vector_size(4 * LANES64)));

/* cell 2^32 + word, below 2^52: the lower bits of the mantissa of 2^52. Times 2^-32 / n it is the place. With n <=
   2^20 the quotient is below the cell's end: they are 2^-52 apart, and the double before 1 is 2^-53 from it. */
static inline __attribute__((always_inline)) size_t
place_rooks(const uint32_t *words, const uint32_t *rows, size_t first, size_t count, double n, bool exact, double *xs)
{
    const lanes64_u exponent = 0x4330000000000000u - (lanes64_u){0};
    const lanes64_d whole = n * 0x1p32 - (lanes64_d){0}, inverse = 1 / whole;
    lanes64_u column = (lanes64_count() + (uint64_t)first) << 32 | exponent;
    size_t i = 0;
    for (; i + LANES64 <= count; i += LANES64, column += (uint64_t)LANES64 << 32) {
        half_lanes row;
        lanes64_u word;
        memcpy(&row, rows + i, sizeof row);
        memcpy(&word, words + 2 * i, sizeof word);
        const lanes64_u in_row = __builtin_convertvector(row, lanes64_u) << 32 | exponent;
        const lanes64_d x = (lanes64_d)(lanes64_even_words(word) | column) - 0x1p52;
        const lanes64_d y = (lanes64_d)(lanes64_odd_words(word) | in_row) - 0x1p52;
        lanes64_interleave(exact ? x * inverse : x / whole, exact ? y * inverse : y / whole, xs + 2 * i);
    }
    return i;
}

void KERNEL_NAME(rooks_2d)(const uint32_t *words, const uint32_t *rows, size_t first, size_t count, size_t n,
                           double *xs)
{
    size_t i = 0;
    if (n <= (size_t)1 << 20) {
        i = (n & (n - 1)) == 0 ? place_rooks(words, rows, first, count, (double)n, true, xs)
                               : place_rooks(words, rows, first, count, (double)n, false, xs);
    }
    const grid g = make_grid(n, n);
    for (; i < count; i++) {
        xs[2 * i] = in_cell(&g, 0, (double)(first + i), words[2 * i] * 0x1p-32);
        xs[2 * i + 1] = in_cell(&g, 1, (double)rows[i], words[2 * i + 1] * 0x1p-32);
    }
}
