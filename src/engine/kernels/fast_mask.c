/* SPDX-License-Identifier: Apache-2.0 */
/* The change of a mask's energy when a pixel gets another value (masks/mask_optimise.c). Sums run in eight lanes for
   every vector width, so that all instruction sets give the same bits. */
#include <math.h>
#include <string.h>

#include "kernels/kernels.h"

enum { LANES = 8 };

typedef float lanes __attribute__((vector_size(32)));
typedef int32_t lanes_bits __attribute__((vector_size(32)));

/* Vectors are passed by pointers, since the ways to pass them by value differ between instruction sets. */
static inline __attribute__((always_inline)) void absolute(lanes *v)
{
    *v = (lanes)((lanes_bits)*v & INT32_MAX);
}

static inline __attribute__((always_inline)) void root(lanes *v)
{
    float s[LANES];
    memcpy(s, v, sizeof s);
    for (int l = 0; l < LANES; l++) {
        s[l] = sqrtf(s[l]);
    }
    memcpy(v, s, sizeof s);
}

/* The loop for one number of coordinates, which the compiler knows. */
static inline __attribute__((always_inline)) float growth(size_t rows, size_t span, size_t stride, size_t plane,
                                                          int dim, const float *weights, const float *values,
                                                          const float *from, const float *to)
{
    lanes sum = {0};
    for (size_t y = 0; y < rows; y++, weights += span, values += stride) {
        for (size_t x = 0; x < span; x += LANES) {
            lanes old = {0}, new = {0}, weight, v;
            memcpy(&weight, weights + x, sizeof weight);
            for (int k = 0; k < dim; k++) {
                memcpy(&v, values + (size_t)k * plane + x, sizeof v);
                const lanes a = from[k] - v, b = to[k] - v;
                old = dim == 1 ? a : old + a * a;
                new = dim == 1 ? b : new + b *b;
            }
            if (dim == 1) {
                absolute(&old);
                absolute(&new);
            } else {
                root(&old);
                root(&new);
            }
            sum += weight * (old - new);
        }
    }
    float s[LANES];
    memcpy(s, &sum, sizeof s);
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

float KERNEL_NAME(mask_growth)(size_t rows, size_t span, size_t stride, size_t plane, int dim, const float *weights,
                               const float *values, const float *from, const float *to)
{
    switch (dim) {
    case 1:
        return growth(rows, span, stride, plane, 1, weights, values, from, to);
    case 2:
        return growth(rows, span, stride, plane, 2, weights, values, from, to);
    case 3:
        return growth(rows, span, stride, plane, 3, weights, values, from, to);
    default:
        return growth(rows, span, stride, plane, 4, weights, values, from, to);
    }
}
