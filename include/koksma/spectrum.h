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
#include <koksma/series.h>

#ifdef __cplusplus
extern "C" {
#endif

/* EXACT sums over all points at each frequency (1e-13 of n). FAST spreads the points on a grid for an FFT: the
   amplitudes are within 1e-9 of n, whatever the points. */
typedef enum koksma_spectrum_method { KOKSMA_SPECTRUM_EXACT, KOKSMA_SPECTRUM_FAST } koksma_spectrum_method;

/* Power at the frequencies (kx, ky), |kx|, |ky| <= half: (1/n) |sum_j exp(-2 pi i k.x_j)|^2, 1 in the mean for random
   points. As the power at -k is that at k, only ky >= 0 is kept. */
typedef struct koksma_spectrum {
    int half;
    size_t sets;
    double points;       /* the mean number of points of a set */
    double *power;       /* the mean over sets at [ky * (2 half + 1) + half + kx] */
    koksma_tally *rings; /* [frequency]: of the sets' ring means */
} koksma_spectrum;

enum { KOKSMA_SPECTRUM_MAX_HALF = 4096 };

/* Memory grows as half^2: with FAST 1 GB for half = 2047, 4 GB for 4096. Errors: ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_spectrum_init(koksma_spectrum *spectrum, int half);
KOKSMA_API void koksma_spectrum_fini(koksma_spectrum *spectrum);

/* Adds a set of 2D points. Errors: ARGUMENT (no points, a coordinate outside [0,1], a spectrum without init), DIM,
   MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_spectrum_add(koksma_spectrum *spectrum, const koksma_points *points,
                                             koksma_spectrum_method method, const koksma_run *run);

/* The mean power at a frequency; NaN outside |k| <= half. */
KOKSMA_API double koksma_spectrum_power(const koksma_spectrum *spectrum, int kx, int ky);

/* Writes the power as koksma_points_write does points: rows of ky = -half .. half, in each kx = -half .. half.
   Errors: ARGUMENT (a spectrum without init), MEMORY, IO. */
KOKSMA_API koksma_status koksma_spectrum_write(const char *path, const koksma_spectrum *spectrum);

/* The frequencies with frequency - 1/2 <= |k| < frequency + 1/2. */
typedef struct koksma_ring {
    double frequency;
    double power, standard_error; /* the mean over the ring and the sets; NaN error for one set */
    /* Ulichney's (1987): 10 log10(s^2 / power^2), with P(k) the mean over the sets, s^2 the sum over the ring's
       frequencies, one of k and -k, of (P(k) - power)^2 divided by their number less 1, and power the ring's mean.
       FAST leaves up to 1e-18 n of power where there is none, and a relative 2e-9 sqrt(n/power) of spread. With
       either method it is NaN for a ring of no more power than that, and -infinity for no more spread. */
    double anisotropy_db;
} koksma_ring;

/* rings[0 .. half-1] for frequencies 1 .. half. At least one set was added. Errors: MEMORY. */
KOKSMA_API koksma_status koksma_spectrum_rings(const koksma_spectrum *spectrum, koksma_ring *rings);

/* Heck, Schlomer and Deussen 2013, on the radial mean p(f) of sets of n points. */
typedef struct koksma_spectrum_quality_values {
    /* Half of the largest f, before the mean of p over all frequencies up to f, by area, passes 1/2 (at sqrt(n)/2 or
       beyond), at which that mean is at most 1/10: a signal of that frequency and its mirror are that far apart. */
    double effective_nyquist;
    /* Over sqrt(n)/2, that of a square lattice of infinitely many points. f is a whole number, so that this is a
       multiple of 1/sqrt(n): 3/4 for the square lattice of 16 points, 31/32 for that of 1,024. */
    double relative_nyquist;
    /* 10 sqrt of the mean, by area, of (p - 1)^2 from where p first comes to 0.98 up to 5 sqrt(n) beyond. NaN when
       the spectrum ends before that: half >= 6.5 sqrt(n) is enough for blue noise. */
    double oscillation;
} koksma_spectrum_quality_values;

/* At least one set was added. */
KOKSMA_API void koksma_spectrum_quality(const koksma_spectrum *spectrum, koksma_spectrum_quality_values *out);

/* Pair correlation on the unit torus: values[b] = the density of pairs at distances b .. b+1 (times r_max/bins) over
   that of random points, n(n-1)/2 pairs in the ring's share of the area; NaN for n = 1. r_max <= 1/2. Cell lists:
   O(n (1 + n r_max^2)) for spread points, O(n^2) for points that lie together; run may be NULL. Errors: DIM, ARGUMENT
   (r_max, bins, no points, a coordinate outside [0,1]), INTERRUPTED, MEMORY. */
KOKSMA_API koksma_status koksma_pair_correlation(const koksma_points *points, double r_max, size_t bins,
                                                 const koksma_run *run, double *values);

#ifdef __cplusplus
}
#endif

#endif
