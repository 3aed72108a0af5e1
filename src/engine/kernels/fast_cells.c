/* SPDX-License-Identifier: Apache-2.0 */
/* Puts points into the cells of a grid, both coordinates of several points at once. Division by a power of two is
   done as multiplication by its reciprocal, which gives the same bits as the division in the reference. */

#include "kernels/kernels.h"
#include "kernels/lanes64.h"

enum { POINTS = LANES64 / 2 };

/* The numbers of cells along x (in even lanes) and y (in odd lanes). exact: both numbers are powers of two. */
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

/* Does the same as koksma__in_cell in each lane: returns the quotient if it is below the end of the cell, otherwise
   the double just below that end. */
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
