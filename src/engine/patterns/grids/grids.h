/* SPDX-License-Identifier: Apache-2.0 */
/* Points in the cells of grids, and uniform numbers. Each section is the interface of the file of its name. */
#ifndef KOKSMA_PATTERNS_GRIDS_GRIDS_H
#define KOKSMA_PATTERNS_GRIDS_GRIDS_H

#include <koksma/koksma.h>

#include "core/random.h" /* the purposes */
#include "core/visibility.h"

/* ---- Fill ------------------------------------------------------------------------------------------------ */

/* Fills xs with `count` independent uniform doubles in [0,1): xs[2i] and xs[2i+1] are the random pair of index i and
   lane 0. Large arrays are filled on several threads; the result does not depend on their number. */
koksma_status koksma__fill_uniform(uint64_t seed, uint32_t purpose, const koksma_run *run, size_t count, double *xs);

/* Fills xs with the numbers first .. first + count - 1 of the array that koksma__fill_uniform makes. */
koksma_status koksma__range_uniform(uint64_t seed, uint32_t purpose, const koksma_run *run, uint64_t first,
                                    size_t count, double *xs);

/* ---- Cells ----------------------------------------------------------------------------------------------- */

/* Helpers of the patterns on a grid of cells: they factor n into numbers of cells and put points into cells. */

/* Returns the coordinate at the fraction u, in [0,1), of cell number `cell` of m cells. The result is at least the
   double nearest to cell/m and below the double nearest to (cell+1)/m: if rounding reaches the latter, the result is
   the double before it. For u = 1/2 the result is the double nearest to the cell's centre. */
static inline double koksma__in_cell(double cell, double u, double m)
{
    const double x = (cell + u) / m, end = (cell + 1) / m;
    return x < end ? x : end * (1 - 0x1p-53);
}

/* The parameter `columns` of patterns on grids of cells; koksma__fill_cells expects it as params[0]. */
#define KOKSMA__PARAM_COLUMNS                                                                                        \
    {                                                                                                                \
        "columns", "only in 2D: number of cells along x, with n / columns cells along y; 0: equal numbers", 0, 0,    \
            1 << 28, NULL, true                                                                                      \
    }

/* The parameter `columns` of those patterns on grids of cells that accept any n. */
#define KOKSMA__PARAM_DIVISOR                                                                                        \
    {                                                                                                                \
        "columns", "number of cells along x, a divisor of n; 0: the largest divisor up to the root of n", 0, 0,      \
            1 << 28, NULL, true                                                                                      \
    }

/* Factors n into columns * rows; `wanted` is the parameter `columns`. Fails with KOKSMA_N and a message that names
   possible n. */
KOKSMA__LAB koksma_status koksma__divisors(const char *name, size_t n, double wanted, size_t *columns, size_t *rows);

/* Computes the number of cells along the first coordinate and along every other coordinate, such that there are
   out->n cells. The two numbers can differ only in 2D with columns > 0. Fails with KOKSMA_N and a message that names
   possible n. */
KOKSMA__LAB koksma_status koksma__cells(const char *name, const koksma_points *out, double columns, size_t *along_x,
                                        size_t *along_rest);

/* Computes points args->first, args->first + 1, ... of a set with one point in every cell, in order of the cells (the
   cell along the last coordinate changes fastest). A point is at the cell's centre + (u - 1/2) * width cell sizes,
   with u uniform in [0,1)^dim and width in [0,1]. */
koksma_status koksma__fill_cells(const char *name, uint64_t seed, const koksma_args *args, double width,
                                 koksma_points *out);

/* Moves the points of `out`, which begin with point args->first of a set of along_x * along_rest^(dim - 1) cells, from the
   unit cube into their cells: u becomes start + width u of the cell. */
void koksma__place_in_cells(const koksma_args *args, double start, double width, size_t along_x, size_t along_rest,
                            koksma_points *out);

/* ---- Jittered time --------------------------------------------------------------------------------------- */

/* Fills `out` with 3D points in order of the cells: x and y are jittered in a grid of params[0] columns (0: as many as
   rows), t is uniform. */
koksma_status koksma__fill_jittered_time(const char *name, uint64_t seed, const koksma_args *args,
                                         koksma_points *out);

#endif
