/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_TORUS_H
#define KOKSMA_CORE_TORUS_H

#include <stddef.h>
#include <stdint.h>

/* b - a on the torus: the difference modulo 1 that is in [-1/2, 1/2]. */
static inline double koksma__torus_difference(double a, double b)
{
    const double t = b - a;
    return t > 0.5 ? t - 1 : t < -0.5 ? t + 1 : t;
}

/* The cell of x in [0,1) among `cells` equal ones; where x cells rounds up to `cells`, it is the last. */
static inline uint32_t koksma__cell_along(double x, uint32_t cells)
{
    const uint32_t cell = (uint32_t)(x * cells);
    return cell < cells ? cell : cells - 1;
}

/* The index, by rows, of the cell of a point of [0,1)^dim in a grid of `cells` cells along each axis. */
static inline size_t koksma__cell_index(const double *x, int dim, uint32_t cells)
{
    size_t cell = 0;
    for (int k = 0; k < dim; k++) {
        cell = cell * cells + koksma__cell_along(x[k], cells);
    }
    return cell;
}

#endif
