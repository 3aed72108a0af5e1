/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The power spectrum of 2D point sets with its radial mean and anisotropy, and the pair correlation: averages over
 * any number of sets, with standard errors. Part of libkoksma.
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

/* EXACT sums over all points at each frequency in O(n half^2); the error of the amplitudes is 1e-13 n. FAST is a
   non-uniform fast Fourier transform in O(n + half^2 log half); its error is at most 1e-9 n for any points. */
typedef enum koksma_spectrum_method { KOKSMA_SPECTRUM_EXACT, KOKSMA_SPECTRUM_FAST } koksma_spectrum_method;

/* Power at the frequencies k = (kx, ky), |kx|, |ky| <= half, averaged over the sets:

       P(k) = (1/n) |sum_j exp(-2 pi i k.x_j)|^2.

   The mean of P is 1 for random points. P(-k) = P(k), so that only ky >= 0 is stored. */
typedef struct koksma_spectrum {
    int half;
    size_t sets;         /* number of sets added so far */
    double points;       /* mean number of points of a set */
    double *power;       /* P(k) at [ky * (2 half + 1) + half + kx] */
    koksma_tally *rings; /* [frequency]: statistics over the sets of the mean power of the ring at this frequency */
} koksma_spectrum;

enum { KOKSMA_SPECTRUM_MAX_HALF = 4096 };

/* Allocates a spectrum without sets. Memory grows with half^2: adding a set with FAST takes 1 GB for half = 2047
   and 4 GB for half = 4096.
     half  the largest frequency, 1 to KOKSMA_SPECTRUM_MAX_HALF
   Errors: ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_spectrum_init(koksma_spectrum *spectrum, int half);

/* Frees the arrays and zeroes the struct. spectrum may be NULL, or zeroed. */
KOKSMA_API void koksma_spectrum_fini(koksma_spectrum *spectrum);

/* Adds a set of 2D points; sets may have different numbers of points.
   Errors: ARGUMENT (no points, a coordinate outside [0,1], a spectrum without init), DIM, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_spectrum_add(koksma_spectrum *spectrum, const koksma_points *points,
                                             koksma_spectrum_method method, const koksma_run *run);

/* Returns the mean power at frequency (kx, ky), or NaN if |kx| or |ky| is above half. */
KOKSMA_API double koksma_spectrum_power(const koksma_spectrum *spectrum, int kx, int ky);

/* Writes the power to a file in the formats of koksma_points_write: one row for each ky = -half .. half, with
   columns kx = -half .. half. Errors: ARGUMENT (a spectrum without init), MEMORY, IO. */
KOKSMA_API koksma_status koksma_spectrum_write(const char *path, const koksma_spectrum *spectrum);

/* The ring of all k with frequency - 1/2 <= |k| < frequency + 1/2. */
typedef struct koksma_ring {
    double frequency;
    double power, standard_error; /* mean of P over the ring and the sets, and its standard error, which is NaN with
                                     one set */
    /* Anisotropy in decibels (Ulichney 1987): 10 log10(s^2 / power^2), where s^2 is the sample variance, over the
       frequencies k of the ring, of the mean of P(k) over the sets; k and -k count as one frequency. FAST has
       rounding errors of up to 1e-18 n in power and of up to 2e-9 sqrt(n/power) in s/power. With either method the
       anisotropy is NaN for a ring whose power is not above this error, and -infinity for a ring whose s/power is not
       above its error. */
    double anisotropy_db;
} koksma_ring;

/* Computes radial mean and anisotropy. At least one set must have been added.
     rings  receives half rings, of frequencies 1 .. half
   Errors: MEMORY. */
KOKSMA_API koksma_status koksma_spectrum_rings(const koksma_spectrum *spectrum, koksma_ring *rings);

/* Numbers for the quality of blue noise (Heck, Schlömer & Deussen 2013), from the radial mean p(f) of n
   points. */
typedef struct koksma_spectrum_quality_values {
    /* Effective Nyquist frequency: signals up to it alias little. It is half of the largest f at which the mean of
       p over the disk of frequencies up to f is at most 1/10; the search for f ends at the first f >= sqrt(n)/2
       where this mean exceeds 1/2. It is NaN if the spectrum ends before the search does; half >= 1.5 sqrt(n) is
       enough for blue noise and lattices. */
    double effective_nyquist;
    /* effective_nyquist divided by sqrt(n)/2, the limit for square lattices. As f is a whole number,
       relative_nyquist is a multiple of 1/sqrt(n): 3/4 for the square lattice of 16 points, 31/32 for the square
       lattice of 1,024 points. */
    double relative_nyquist;
    /* 10 times the root of the area-weighted mean of (p - 1)^2 over the frequencies from the first f with p(f) >=
       0.98 to f + 5 sqrt(n). It is NaN if the spectrum ends below f + 5 sqrt(n); half >= 6.5 sqrt(n) is enough for
       blue noise. */
    double oscillation;
} koksma_spectrum_quality_values;

/* Computes the quality of a spectrum. At least one set must have been added. */
KOKSMA_API void koksma_spectrum_quality(const koksma_spectrum *spectrum, koksma_spectrum_quality_values *out);

/* Computes the pair correlation of 2D points on the unit torus: values[b] is the density of pairs at distances from
   b r_max / bins (included) to (b + 1) r_max / bins (not), over n (n - 1) and the ring's area: 1 for random points;
   NaN with n = 1.
     r_max   above 0, at most 1/2
     values  receives bins numbers
   O(n (1 + n r_max^2)) for evenly spread points, O(n^2) if many lie close together.
   Errors: DIM, ARGUMENT (r_max, bins, no points, a coordinate outside [0,1]), INTERRUPTED, MEMORY. */
KOKSMA_API koksma_status koksma_pair_correlation(const koksma_points *points, double r_max, size_t bins,
                                                 const koksma_run *run, double *values);

#ifdef __cplusplus
}
#endif

#endif
