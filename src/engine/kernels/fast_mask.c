/* SPDX-License-Identifier: Apache-2.0 */
/* The change of a mask's energy when a pixel gets another value (masks/mask_optimise.c). Sums run in eight lanes for
   every vector width, so that all instruction sets give the same bits; the loops over lanes become vectors. */
#include <math.h>

#include "kernels/kernels.h"

float KERNEL_NAME(mask_growth)(size_t rows, size_t span, size_t stride, size_t plane, int dim, const float *weights,
                               const float *values, const float *from, const float *to);

enum { LANES = 8 };

/* The loop for one number of coordinates, which the compiler knows. */
static inline __attribute__((always_inline)) float growth(size_t rows, size_t span, size_t stride, size_t plane,
                                                          int dim, const float *weights, const float *values,
                                                          const float *from, const float *to)
{
    float s[LANES] = {0};
    for (size_t y = 0; y < rows; y++, weights += span, values += stride) {
        for (size_t x = 0; x < span; x += LANES) {
            float old[LANES] = {0}, new[LANES] = {0};
            for (int k = 0; k < dim; k++) {
                const float *v = values + (size_t)k * plane + x;
                for (int l = 0; l < LANES; l++) {
                    const float a = from[k] - v[l], b = to[k] - v[l];
                    old[l] += dim == 1 ? fabsf(a) : a * a;
                    new[l] += dim == 1 ? fabsf(b) : b *b;
                }
            }
            for (int l = 0; l < LANES; l++) {
                s[l] += weights[x + (size_t)l] * (dim == 1 ? old[l] - new[l] : sqrtf(old[l]) - sqrtf(new[l]));
            }
        }
    }
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
