/* SPDX-License-Identifier: Apache-2.0 */
/* Computes the power of an image's error at every Fourier frequency (image/fourier.c) and averages it over rings of
   frequencies, in O(n log n) for n pixels. */
#include "study/report/error_spectrum.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "image/coherence.h"
#include "image/formats.h"
#include "image/image.h"

/* Averages the powers over rings. The errors are real, so the columns above W/2 mirror those below W/2, which
   therefore count twice. */
static void add_rings(const double *powers, size_t width, size_t height, size_t n_rings, double *power)
{
    const size_t half = width / 2 + 1;
    double sums[KOKSMA__SPECTRUM_RINGS] = {0}, counts[KOKSMA__SPECTRUM_RINGS] = {0};
    for (size_t u = 0; u < half; u++) {
        const double times = u == 0 || 2 * u == width ? 1 : 2, fx = (double)u / (double)width;
        for (size_t v = 0; v < height; v++) {
            const double fy = (double)(2 * v <= height ? v : height - v) / (double)height;
            const size_t ring = (size_t)(2 * (double)n_rings * sqrt(fx * fx + fy * fy));
            if (ring >= n_rings || (u == 0 && v == 0)) {
                continue;
            }
            sums[ring] += times * powers[v * half + u] / ((double)width * (double)height);
            counts[ring] += times;
        }
    }
    for (size_t r = 0; r < n_rings; r++) {
        power[r] = counts[r] > 0 ? sums[r] / counts[r] : (double)NAN;
    }
}

size_t koksma__spectrum_rings(int width, int height)
{
    const int side = width < height ? width : height;
    return side < 4 ? 1 : side / 2 < KOKSMA__SPECTRUM_RINGS ? (size_t)side / 2 : (size_t)KOKSMA__SPECTRUM_RINGS;
}

koksma_status koksma__spectrum_add(koksma__error_spectrum *spectrum, const koksma_image *image,
                                   const koksma_image *reference)
{
    KOKSMA__FAIL_IF(image->width != reference->width || image->height != reference->height, KOKSMA_ARGUMENT,
                    "an image of %d x %d pixels cannot be compared with a reference of %d x %d", image->width,
                    image->height, reference->width, reference->height);
    const size_t width = (size_t)image->width, height = (size_t)image->height;
    const size_t pixels = width * height, doubles = pixels + koksma__fourier_columns(image->width) * height;
    double *errors = malloc(doubles * sizeof *errors), *powers = errors + pixels;
    KOKSMA__REQUIRE_MEMORY(errors, doubles * sizeof *errors);
    for (size_t i = 0; i < pixels; i++) {
        errors[i] = koksma__luminance(image, i) - koksma__luminance(reference, i);
    }
    const koksma_status status = koksma__fourier_power(image->width, image->height, errors, powers);
    if (!status) {
        double power[KOKSMA__SPECTRUM_RINGS];
        spectrum->n = koksma__spectrum_rings(image->width, image->height);
        add_rings(powers, width, height, spectrum->n, power);
        const double before = (double)spectrum->images++;
        for (size_t r = 0; r < spectrum->n; r++) {
            spectrum->power[r] = (spectrum->power[r] * before + power[r]) / (before + 1);
        }
    }
    free(errors);
    return status;
}
