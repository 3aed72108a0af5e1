/* SPDX-License-Identifier: Apache-2.0 */
#include "study/error_spectrum.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "image/formats.h"

/* cos and sin of 2 pi k / n */
static void fill_turns(double *turns, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        const double angle = 2 * M_PI * (double)k / (double)n;
        turns[2 * k] = cos(angle);
        turns[2 * k + 1] = sin(angle);
    }
}

/* sum_k values[stride k] exp(-2 pi i u k / n); values are pairs. */
static void transform_one(const double *values, size_t stride, size_t n, const double *turns, size_t u, double out[2])
{
    double re = 0, im = 0;
    for (size_t k = 0, turn = 0; k < n; k++) {
        const double *v = values + 2 * stride * k, c = turns[2 * turn], s = turns[2 * turn + 1];
        re += v[0] * c + v[1] * s;
        im += v[1] * c - v[0] * s;
        turn += u;
        turn -= turn >= n ? n : 0;
    }
    out[0] = re;
    out[1] = im;
}

/* The errors are real: columns above W/2 mirror those below, and count there twice. */
static void add_rings(const double *rows, size_t width, size_t height, const double *turns, size_t n_rings,
                      double *power)
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
            double value[2];
            transform_one(rows + 2 * u, half, height, turns, v, value);
            sums[ring] += times * (value[0] * value[0] + value[1] * value[1]) / ((double)width * (double)height);
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
    const size_t width = (size_t)image->width, height = (size_t)image->height, half = width / 2 + 1;
    if (image->width != reference->width || image->height != reference->height) {
        return koksma__fail(KOKSMA_ARGUMENT, "an image of %d x %d pixels has no error against one of %d x %d",
                            image->width, image->height, reference->width, reference->height);
    }
    const size_t longest = width > height ? width : height;
    const size_t doubles = 2 * (longest + width + half * height);
    double *turns = malloc(doubles * sizeof *turns), *row = turns + 2 * longest, *rows = row + 2 * width;
    if (!turns) {
        return koksma__fail_memory(doubles * sizeof *turns);
    }
    fill_turns(turns, width);
    for (size_t y = 0; y < height; y++) {
        for (size_t x = 0; x < width; x++) {
            const size_t pixel = y * width + x;
            row[2 * x] = koksma__luminance(image, pixel) - koksma__luminance(reference, pixel);
            row[2 * x + 1] = 0;
        }
        for (size_t u = 0; u < half; u++) {
            transform_one(row, 1, width, turns, u, rows + 2 * (y * half + u));
        }
    }
    double power[KOKSMA__SPECTRUM_RINGS];
    fill_turns(turns, height);
    spectrum->n = koksma__spectrum_rings(image->width, image->height);
    add_rings(rows, width, height, turns, spectrum->n, power);
    const double before = (double)spectrum->images++;
    for (size_t r = 0; r < spectrum->n; r++) {
        spectrum->power[r] = (spectrum->power[r] * before + power[r]) / (before + 1);
    }
    free(turns);
    return KOKSMA_OK;
}
