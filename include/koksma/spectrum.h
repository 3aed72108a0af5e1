/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Measures of plane point sets that are functions: the power spectrum, its radial mean and anisotropy, and the pair
 * correlation; each the mean over any number of sets, with standard errors.
 *
 *     koksma_spectrum spectrum;
 *     koksma_spectrum_init(&spectrum, 64);
 *     for each set: koksma_spectrum_add(&spectrum, &points, KOKSMA_SPECTRUM_FAST, NULL);
 *     koksma_ring rings[64];
 *     koksma_spectrum_rings(&spectrum, rings);
 */
#ifndef KOKSMA_SPECTRUM_H
#define KOKSMA_SPECTRUM_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* EXACT sums over all points at each frequency (1e-13 of n). FAST spreads the points on a grid for an FFT: the
   amplitudes are within 1e-10 of n, whatever the points. */
typedef enum koksma_spectrum_method { KOKSMA_SPECTRUM_EXACT, KOKSMA_SPECTRUM_FAST } koksma_spectrum_method;

/* Power at the frequencies (kx, ky), |kx|, |ky| <= half: (1/n) |sum_j exp(-2 pi i k.x_j)|^2, 1 in the mean for random
   points. As the power at -k is that at k, only ky >= 0 is kept. */
typedef struct koksma_spectrum {
    int half;
    size_t sets;
    double points; /* the mean number of points of a set */
    double *power; /* the sum over sets at [ky * (2 half + 1) + half + kx] */
    double *rings; /* two numbers a ring: sum and sum of squares, over sets, of the set's ring mean */
} koksma_spectrum;

enum { KOKSMA_SPECTRUM_MAX_HALF = 4096 };

/* Errors: ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_spectrum_init(koksma_spectrum *spectrum, int half);
KOKSMA_API void koksma_spectrum_fini(koksma_spectrum *spectrum);

/* Adds a set of 2D points. Errors: DIM, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_spectrum_add(koksma_spectrum *spectrum, const koksma_points *points,
                                             koksma_spectrum_method method, const koksma_run *run);

/* The mean power at a frequency; NaN outside |k| <= half. */
KOKSMA_API double koksma_spectrum_power(const koksma_spectrum *spectrum, int kx, int ky);

/* The frequencies with frequency - 1/2 <= |k| < frequency + 1/2. */
typedef struct koksma_ring {
    double frequency;
    double power, standard_error; /* the mean over the ring and the sets; NaN error for one set */
    double anisotropy_db;         /* 10 log10 of the variance along the ring, of the mean over sets, over power^2 */
} koksma_ring;

/* rings[0 .. half-1] for frequencies 1 .. half. At least one set was added. */
KOKSMA_API void koksma_spectrum_rings(const koksma_spectrum *spectrum, koksma_ring *rings);

/* After Heck, Schlomer and Deussen 2013, on the radial mean p(f). The effective Nyquist frequency is the largest f
   such that the mean of p over the frequencies up to f, by area, is at most 0.1; the oscillation is 10 sqrt of the
   mean of (p - 1)^2 over the frequencies from there to half, by area. */
KOKSMA_API void koksma_spectrum_quality(const koksma_spectrum *spectrum, double *effective_nyquist,
                                        double *oscillation);

/* Pair correlation on the unit torus: values[b] = the density of pairs at distances b .. b+1 (times r_max/bins) over
   that of random points, n(n-1)/2 pairs in the ring's share of the area. r_max <= 1/2. Cell lists: O(n (1 + n
   r_max^2)). Errors: DIM, ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_pair_correlation(const koksma_points *points, double r_max, size_t bins,
                                                 double *values);

#ifdef __cplusplus
}
#endif

#endif
