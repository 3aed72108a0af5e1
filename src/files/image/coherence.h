/* SPDX-License-Identifier: Apache-2.0 */
/* The spectrum of a picture, and the coherence of errors (koksma/image.h) that are given as doubles instead of images. */
#ifndef KOKSMA_IMAGE_COHERENCE_H
#define KOKSMA_IMAGE_COHERENCE_H

#include <koksma/image.h>

/* Does what koksma_coherence_add does, from the errors of an image's pixels: errors[y * width + x], which the
   function overwrites. Errors: MALFORMED (an error is not a finite number), MEMORY. */
koksma_status koksma__coherence_add_errors(koksma_coherence *coherence, double *errors);

/* ---- The distribution of the coherence of errors that are white noise ---- */

/* The model of the power: a mean over `images` images; the share `common` of the squared error is the same in all of
   them. The spectrum of an image has `waves` pairs of conjugate frequencies (u, v) and (-u, -v), each pair counted
   once, and `real` frequencies that are their own conjugates; the mean (0, 0) is not counted. */
typedef struct koksma__coherence_law {
    size_t images, waves, real;
    double common;
} koksma__coherence_law;

/* Returns the probability that the largest power divided by the mean power exceeds x. */
double koksma__coherence_tail(const koksma__coherence_law *law, double x);

/* Returns the inverse of koksma__coherence_tail: the x that the largest power divided by the mean power exceeds with
   probability `tail`, 0 < tail < 1. */
double koksma__coherence_quantile(const koksma__coherence_law *law, double tail);

/* ---- The discrete Fourier transform of a picture of any size ---- */

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
