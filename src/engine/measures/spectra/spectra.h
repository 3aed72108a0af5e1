/* SPDX-License-Identifier: Apache-2.0 */
/* Power spectra: amplitudes summed directly and by a nonuniform transform. */
#ifndef KOKSMA_MEASURES_SPECTRA_SPECTRA_H
#define KOKSMA_MEASURES_SPECTRA_SPECTRA_H

#include <koksma/koksma.h>
#include <koksma/spectrum.h>

#include "core/visibility.h"

/* ---- amplitudes_exact.c ------------------------------------------------------------------------------------ */

/* The power spectrum of the first two coordinates of the points: power[ky * (2 half + 1) + half + kx] =
   |sum_j exp(-2 pi i k.x_j)|^2 / n for |kx| <= half, 0 <= ky <= half, summed directly. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__power_exact(const koksma_points *points, int half, const koksma_run *run, double *power);

/* ---- amplitudes_fast.c ------------------------------------------------------------------------------------- */

/* The power spectrum of the first two coordinates of the points: power[ky * (2 half + 1) + half + kx] =
   |sum_j exp(-2 pi i k.x_j)|^2 / n for |kx| <= half, 0 <= ky <= half, by a nonuniform
   fast Fourier transform. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__power_fast(const koksma_points *points, int half, const koksma_run *run, double *power);

/* ---- spectrum.c -------------------------------------------------------------------------------------------- */

/* Fails if the spectrum was not initialised by koksma_spectrum_init. Errors: ARGUMENT. */
KOKSMA__LAB koksma_status koksma__spectrum_check(const koksma_spectrum *spectrum);

#endif
