/* SPDX-License-Identifier: Apache-2.0 */
/* What the patterns on a grid of cells share: how n is cut into cells, and placing a number in its cell. */
#ifndef KOKSMA_PATTERNS_SHARED_CELLS_H
#define KOKSMA_PATTERNS_SHARED_CELLS_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* A place u in [0,1) of cell `cell` of m. The result is at least the double nearest to cell/m and below the one
   nearest to (cell+1)/m: where rounding takes it there, it is the double before. Cell centres stay exact. */
static inline double koksma__in_cell(double cell, double u, double m)
{
    const double x = (cell + u) / m, end = (cell + 1) / m;
    return x < end ? x : end * (1 - 0x1p-53);
}

/* The parameter that the patterns on cells share: params[0] of those that use KOKSMA__PARAM_COLUMNS. */
#define KOKSMA__PARAM_COLUMNS                                                                                        \
    {                                                                                                                \
        "columns", "2D: cells along x, with n / columns along y; 0: as many as along y", 0, 0, 1 << 28, NULL, true   \
    }

/* `columns` for patterns of cells that make any number of points. */
#define KOKSMA__PARAM_DIVISOR                                                                                        \
    {                                                                                                                \
        "columns", "cells along x, a divisor of n; 0: the one nearest to the root of n from below", 0, 0, 1 << 28,   \
            NULL, true                                                                                               \
    }

/* columns * rows = n. Errors: N, with the n that would do. */
KOKSMA__LAB koksma_status koksma__divisors(const char *name, size_t n, double wanted, size_t *columns, size_t *rows);

/* Cells along x (2D with columns > 0), and along every other coordinate, such that their product is out->n.
   Errors: N, with the n that would do. */
KOKSMA__LAB koksma_status koksma__cells(const char *name, const koksma_points *out, double columns, size_t *along_x,
                                        size_t *along_rest);

/* The range of points that args wants of those with one in every cell, in order of the cells (the last coordinate's
   changes fastest): the point is at centre + (u - 1/2) * width of its cell, with u uniform; width in [0,1]. */
koksma_status koksma__fill_cells(const char *name, uint64_t seed, const koksma_args *args, double width,
                                 koksma_points *out);

#endif
