/* SPDX-License-Identifier: Apache-2.0 */
/* Power spectra by direct summation. */
#ifndef KOKSMA_MEASURES_SHARED_AMPLITUDES_EXACT_H
#define KOKSMA_MEASURES_SHARED_AMPLITUDES_EXACT_H

#include <koksma/koksma.h>

/* The power spectrum of the first two coordinates of the points: power[ky * (2 half + 1) + half + kx] =
   |sum_j exp(-2 pi i k.x_j)|^2 / n for |kx| <= half, 0 <= ky <= half, summed directly. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__power_exact(const koksma_points *points, int half, const koksma_run *run, double *power);

#endif
