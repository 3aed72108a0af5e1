/* SPDX-License-Identifier: Apache-2.0 */
/* Power spectra by a fast transform. */
#ifndef KOKSMA_MEASURES_SHARED_AMPLITUDES_FAST_H
#define KOKSMA_MEASURES_SHARED_AMPLITUDES_FAST_H

#include <koksma/koksma.h>

/* The power spectrum of the first two coordinates of the points: power[ky * (2 half + 1) + half + kx] =
   |sum_j exp(-2 pi i k.x_j)|^2 / n for |kx| <= half, 0 <= ky <= half, by a nonuniform
   fast Fourier transform. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__power_fast(const koksma_points *points, int half, const koksma_run *run, double *power);

#endif
