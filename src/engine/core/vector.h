/* SPDX-License-Identifier: Apache-2.0 */
/* Positions: vectors, the torus and its cells, selection by a coordinate. */
#ifndef KOKSMA_CORE_VECTOR_H
#define KOKSMA_CORE_VECTOR_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

static inline double koksma__dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The product of two vectors of n numbers. */
static inline double koksma__dot_of(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

static inline void koksma__cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void koksma__subtract(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] - b[k];
    }
}

/* Scales v to length 1. Returns false, and leaves v unchanged, if its length is at most 1e-12. */
static inline bool koksma__normalise(double v[3])
{
    const double length = sqrt(koksma__dot(v, v));
    if (!(length > 1e-12)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
    return true;
}

/* The cofactors of a matrix of 3 x 3 numbers, which are its determinant times the transpose of its inverse; returns
   the determinant. */
static inline double koksma__cofactors(const double m[9], double out[9])
{
    for (int i = 0; i < 9; i++) {
        const int r1 = (i / 3 + 1) % 3, r2 = (i / 3 + 2) % 3, c1 = (i + 1) % 3, c2 = (i + 2) % 3;
        out[i] = m[3 * r1 + c1] * m[3 * r2 + c2] - m[3 * r1 + c2] * m[3 * r2 + c1];
    }
    return koksma__dot(m, out);
}

/* Inverts a matrix of 3 x 3 numbers; returns false, and numbers that are not finite, if it has no inverse. */
static inline bool koksma__invert(const double m[9], double out[9])
{
    double c[9];
    const double determinant = koksma__cofactors(m, c);
    for (int i = 0; i < 9; i++) {
        out[i] = c[3 * (i % 3) + i / 3] / determinant;
    }
    return isfinite(1 / determinant);
}

/* ---- The torus and cells ---- */

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

/* ---- Selection among points by one coordinate, for trees whose nodes are halved ---- */

/* Quickselect (Hoare 1961): reorders the indices order[first .. end - 1] so that position `middle` has the index that
   sorting by coordinate k would put there, and no point before it has a larger coordinate. Point i has the
   coordinates xs[i * dim] to xs[i * dim + dim - 1]. The pivot is never the last point, so that no side
   is empty. */
static inline void koksma__select(uint32_t *order, size_t first, size_t end, size_t middle, const double *xs,
                                  size_t dim, size_t k)
{
    while (end - first > 1) {
        const double pivot = xs[order[first + (end - 1 - first) / 2] * dim + k];
        size_t i = first, j = end - 1;
        for (;; i++, j--) {
            while (xs[order[i] * dim + k] < pivot) {
                i++;
            }
            while (xs[order[j] * dim + k] > pivot) {
                j--;
            }
            if (i >= j) {
                break;
            }
            const uint32_t kept = order[i];
            order[i] = order[j];
            order[j] = kept;
        }
        if (middle <= j) {
            end = j + 1;
        } else {
            first = j + 1;
        }
    }
}

#endif
