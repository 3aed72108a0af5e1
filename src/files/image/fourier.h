/* SPDX-License-Identifier: Apache-2.0 */
/* The discrete Fourier transform of a picture of any size. */
#ifndef KOKSMA_IMAGE_FOURIER_H
#define KOKSMA_IMAGE_FOURIER_H

#include <koksma/koksma.h>

/* The number of stored columns of frequencies of a picture of that width; the other columns mirror them. */
static inline size_t koksma__fourier_columns(int width)
{
    return (size_t)width / 2 + 1;
}

/* power[v * columns + u] = |sum_xy values[y * width + x] exp(-2 pi i (u x / width + v y / height))|^2 for u = 0 ..
   width / 2 and v = 0 .. height - 1. The error of power is about 1e-15 times the sum of values^2, for any size. O(n
   log n). The bits are the same on every instruction set and for any number of threads. Errors: MEMORY. */
koksma_status koksma__fourier_power(int width, int height, const double *values, double *power);

/* The same sum before its absolute value is taken: the real part of frequency (u, v) is complex[2 (v * columns + u)],
   and the imaginary part the next number. */
koksma_status koksma__fourier_transform(int width, int height, const double *values, double *complex);

#endif
