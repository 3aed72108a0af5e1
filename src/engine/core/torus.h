/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_TORUS_H
#define KOKSMA_CORE_TORUS_H

#include <stddef.h>
#include <stdint.h>

/* Returns b - a on the torus: the difference modulo 1, in [-1/2, 1/2]. */
static inline double koksma__torus_difference(double a, double b)
{
    const double t = b - a;
    return t > 0.5 ? t - 1 : t < -0.5 ? t + 1 : t;
}

/* Returns the index of the cell of x in [0,1) among `cells` equal cells. If the product of x and `cells` rounds up to
   `cells`, the result is the last cell. */
static inline uint32_t koksma__cell_along(double x, uint32_t cells)
{
    const uint32_t cell = (uint32_t)(x * cells);
    return cell < cells ? cell : cells - 1;
}

/* Returns the row-major index of the cell of a point of [0,1)^dim in a grid with `cells` cells along each axis. */
static inline size_t koksma__cell_index(const double *x, int dim, uint32_t cells)
{
    size_t cell = 0;
    for (int k = 0; k < dim; k++) {
        cell = cell * cells + koksma__cell_along(x[k], cells);
    }
    return cell;
}

#endif
