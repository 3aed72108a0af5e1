/* SPDX-License-Identifier: Apache-2.0 */
/* Points into the cells of a grid, both coordinates of several points at once. A quotient by a power of two is a
   product by its reciprocal, to the bit; the reference divides. */
#include <math.h>

#include "kernels/kernels.h"
#include "kernels/lanes64.h"

void KERNEL_NAME(cells_2d)(double start, double width, size_t nx, size_t ny, double *xs);

enum { POINTS = LANES64 / 2 };

static bool is_power_of_two(size_t m)
{
    return (m & (m - 1)) == 0;
}

static inline double scaled(double x, double m, double inverse, bool exact)
{
    return exact ? x * inverse : x / m;
}

static void place_one(double cell, double m, double inverse, bool exact, double u, double *x)
{
    const double place = scaled(cell + u, m, inverse, exact), end = scaled(cell + 1, m, inverse, exact);
    *x = place < end ? place : end * (1 - 0x1p-53);
}

static inline __attribute__((always_inline)) void place_rows(double start, double width, size_t nx, size_t ny,
                                                             bool exact, double *xs)
{
    const double m[2] = {(double)nx, (double)ny}, inverse[2] = {1 / m[0], 1 / m[1]};
    lanes64_d ms, inverses, along_y, cells;
    for (int l = 0; l < LANES64; l++) {
        ms[l] = m[l % 2];
        inverses[l] = inverse[l % 2];
        along_y[l] = l % 2 ? POINTS : 0;
    }
    for (size_t i = 0; i < nx; i++) {
        size_t j = 0;
        for (int l = 0; l < LANES64; l++) {
            cells[l] = l % 2 ? (double)(l / 2) : (double)i;
        }
        for (; j + POINTS <= ny; j += POINTS, xs += LANES64, cells += along_y) {
            lanes64_d u;
            memcpy(&u, xs, sizeof u);
            const lanes64_d places = cells + (start + width * u), ends = cells + 1;
            const lanes64_d x = exact ? places * inverses : places / ms;
            const lanes64_d last = (exact ? ends * inverses : ends / ms) * (1 - 0x1p-53);
            const lanes64_u below = (lanes64_u)(x < last); /* at most last: the same as place_one's choice */
            const lanes64_u bits = ((lanes64_u)x & below) | ((lanes64_u)last & ~below);
            memcpy(xs, &bits, sizeof bits);
        }
        for (; j < ny; j++, xs += 2) {
            place_one((double)i, m[0], inverse[0], exact, start + width * xs[0], &xs[0]);
            place_one((double)j, m[1], inverse[1], exact, start + width * xs[1], &xs[1]);
        }
    }
}

void KERNEL_NAME(cells_2d)(double start, double width, size_t nx, size_t ny, double *xs)
{
    if (is_power_of_two(nx) && is_power_of_two(ny)) {
        place_rows(start, width, nx, ny, true, xs);
    } else {
        place_rows(start, width, nx, ny, false, xs);
    }
}
