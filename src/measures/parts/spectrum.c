/* SPDX-License-Identifier: Apache-2.0 */
/* Power spectra and what is read from them. Definitions: Ulichney 1988 for the radial mean and the anisotropy; Heck,
   Schlomer and Deussen 2013 for the effective Nyquist frequency and the oscillation, as koksma/spectrum.h words them.
 */
#include <math.h>
#include <stdlib.h>

#include <koksma/spectrum.h>

#include "core/status.h"
#include "measures/parts/amplitudes.h"

koksma_status koksma_spectrum_init(koksma_spectrum *spectrum, int half)
{
    *spectrum = (koksma_spectrum){0};
    if (half < 1 || half > KOKSMA_SPECTRUM_MAX_HALF) {
        return koksma__fail(KOKSMA_ARGUMENT, "spectrum: half = %d: it takes 1 to %d", half, KOKSMA_SPECTRUM_MAX_HALF);
    }
    const size_t rows = (size_t)half + 1, count = rows * (2 * (size_t)half + 1) + 2 * rows;
    spectrum->power = calloc(count, sizeof(double));
    if (!spectrum->power) {
        return koksma__fail_memory(count * sizeof(double));
    }
    spectrum->rings = spectrum->power + rows * (2 * (size_t)half + 1);
    spectrum->half = half;
    return KOKSMA_OK;
}

void koksma_spectrum_fini(koksma_spectrum *spectrum)
{
    if (spectrum) {
        free(spectrum->power);
        *spectrum = (koksma_spectrum){0};
    }
}

/* Calls of f for each frequency of the rings 1 .. half once, of k and -k only one. */
#define FOR_EACH_FREQUENCY(half, kx, ky, ring)                                                                       \
    for (int ky = 0; ky <= (half); ky++)                                                                             \
        for (int kx = ky ? -(half) : 1; kx <= (half); kx++)                                                          \
            for (int ring = (int)floor(hypot(kx, ky) + 0.5), once_ = 1; once_ && ring <= (half); once_ = 0)

/* Sums of the values and of their squares, and counts, by ring. */
static void sum_rings(int half, const double *power, double scale, double *sums, double *squares, double *counts)
{
    FOR_EACH_FREQUENCY(half, kx, ky, ring)
    {
        const double value = power[(size_t)ky * (2 * (size_t)half + 1) + (size_t)(half + kx)] * scale;
        sums[ring] += value;
        squares[ring] += value * value;
        counts[ring] += 1;
    }
}

koksma_status koksma_spectrum_add(koksma_spectrum *spectrum, const koksma_points *points,
                                  koksma_spectrum_method method, const koksma_run *run)
{
    const size_t rows = (size_t)spectrum->half + 1, count = rows * (2 * (size_t)spectrum->half + 1);
    if (points->dim != 2) {
        return koksma__fail(KOKSMA_DIM, "spectrum: it has no %d-dimensional form, only dim = 2", points->dim);
    }
    double *power = calloc(count + 3 * rows, sizeof *power), *sums = power + count;
    if (!power) {
        return koksma__fail_memory(count * sizeof *power);
    }
    const koksma_status status = (method == KOKSMA_SPECTRUM_EXACT ? koksma__power_exact : koksma__power_fast)(
        points, spectrum->half, run, power);
    if (!status) {
        for (size_t i = 0; i < count; i++) {
            spectrum->power[i] += power[i];
        }
        sum_rings(spectrum->half, power, 1, sums, sums + rows, sums + 2 * rows);
        for (size_t ring = 1; ring < rows; ring++) {
            const double mean = sums[ring] / sums[2 * rows + ring];
            spectrum->rings[2 * ring] += mean;
            spectrum->rings[2 * ring + 1] += mean * mean;
        }
        spectrum->points += ((double)points->n - spectrum->points) / (double)(spectrum->sets + 1);
        spectrum->sets++;
    }
    free(power);
    return status;
}

double koksma_spectrum_power(const koksma_spectrum *spectrum, int kx, int ky)
{
    const int half = spectrum->half, x = ky < 0 ? -kx : kx, y = abs(ky);
    if (abs(kx) > half || y > half) {
        return NAN;
    }
    return spectrum->power[(size_t)y * (2 * (size_t)half + 1) + (size_t)(half + x)] / (double)spectrum->sets;
}

void koksma_spectrum_rings(const koksma_spectrum *spectrum, koksma_ring *rings)
{
    const int half = spectrum->half;
    const double sets = (double)spectrum->sets;
    double *sums = calloc(3 * ((size_t)half + 1), sizeof *sums);
    if (sums) {
        sum_rings(half, spectrum->power, 1 / sets, sums, sums + half + 1, sums + 2 * (half + 1));
    }
    for (int ring = 1; ring <= half; ring++) {
        const double mean = spectrum->rings[2 * ring] / sets;
        const double variance = fmax(spectrum->rings[2 * ring + 1] / sets - mean * mean, 0);
        double anisotropy = NAN;
        if (sums) {
            const double count = sums[2 * (half + 1) + ring], along = sums[ring] / count;
            const double spread = fmax(sums[half + 1 + ring] / count - along * along, 0) * count / (count - 1);
            anisotropy = 10 * log10(spread / (along * along));
        }
        rings[ring - 1] = (koksma_ring){ring, mean, sets > 1 ? sqrt(variance / (sets - 1)) : (double)NAN, anisotropy};
    }
    free(sums);
}

void koksma_spectrum_quality(const koksma_spectrum *spectrum, double *effective_nyquist, double *oscillation)
{
    const double sets = (double)spectrum->sets;
    double energy = 0, area = 0, waves = 0, beyond = 0;
    *effective_nyquist = 0;
    for (int ring = 1; ring <= spectrum->half; ring++) {
        energy += ring * spectrum->rings[2 * ring] / sets;
        area += ring;
        if (energy <= 0.1 * area) {
            *effective_nyquist = ring;
        }
    }
    for (int ring = (int)*effective_nyquist + 1; ring <= spectrum->half; ring++) {
        const double off = spectrum->rings[2 * ring] / sets - 1;
        waves += ring * off * off;
        beyond += ring;
    }
    *oscillation = beyond > 0 ? 10 * sqrt(waves / beyond) : 0;
}
