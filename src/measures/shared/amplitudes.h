/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_AMPLITUDES_H
#define KOKSMA_MEASURES_SHARED_AMPLITUDES_H

#include <koksma/koksma.h>

/* Computes the power spectrum of the first two coordinates of the points: power[ky * (2 half + 1) + half + kx] =
   |sum_j exp(-2 pi i k.x_j)|^2 / n for |kx| <= half, 0 <= ky <= half. `exact` sums directly, `fast` by a nonuniform
   fast Fourier transform. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__power_exact(const koksma_points *points, int half, const koksma_run *run, double *power);
koksma_status koksma__power_fast(const koksma_points *points, int half, const koksma_run *run, double *power);

#endif
