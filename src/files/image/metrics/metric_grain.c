/* SPDX-License-Identifier: Apache-2.0 */
/*
 * grain: the coarse part of the error. With e the error in luminance on W x H pixels, and e_f the part of e that is made
 * of its Fourier frequencies with 0 < |(u / W, v / H)| < `below` cycles a pixel,
 *
 *     grain = sqrt(sum e_f^2 / (W H)) = sqrt(sum over these (u, v) of |E(u, v)|^2) / (W H)
 *
 * by Parseval's theorem: the square is the share of rmse^2 that lies at low frequencies, without the mean of the error.
 * Mitchell 1992 calls images with a larger component of low-frequency noise grainier. The default of 0.05, waves of 20
 * pixels and longer, is 3.4 cycles a degree at the 67 pixels a degree of FLIP, where contrast sensitivity peaks (2 to 5
 * cycles a degree): finer noise is seen less, the finer the less. An image has no such wave, and no grain, if neither side
 * is longer than 1 / below pixels.
 *
 * The transform is applied to rows and columns, twice: the second gives W H times the values, mirrored. O(n log n).
 */
#include <math.h>
#include <stdlib.h>

#include "core/dft.h"
#include "core/status.h"
#include "image/metrics/metrics.h"

/* Transforms every line of `length` numbers: number i of line l is at index l * next + i * stride. */
static koksma_status transform(size_t length, size_t stride, size_t lines, size_t next, double *re, double *im)
{
    const size_t padded = koksma__dft_padded(length), room = padded > length ? padded : length;
    koksma__fourier tables = {0};
    koksma__dft dft = {0};
    double *scratch = malloc(2 * room * sizeof *scratch);
    koksma_status status = scratch ? KOKSMA_OK : koksma__fail_memory(2 * room * sizeof *scratch);
    status = status ? status : koksma__fourier_init(&tables, padded ? padded : 1);
    status = status ? status : koksma__dft_init(&dft, &tables, length);
    for (size_t l = 0; !status && l < lines; l++) {
        koksma__dft_transform(&dft, &tables, stride, re + l * next, im + l * next, scratch, scratch + room);
    }
    koksma__dft_fini(&dft);
    koksma__fourier_fini(&tables);
    free(scratch);
    return status;
}

static koksma_status transform_plane(size_t width, size_t height, double *re, double *im)
{
    const koksma_status status = transform(width, 1, height, width, re, im);
    return status ? status : transform(height, width, width, 1, re, im);
}

/* Keeps the frequencies of grain alone. */
static void keep_low(size_t width, size_t height, double below, double *re, double *im)
{
    for (size_t i = 0; i < width * height; i++) {
        const size_t u = i % width, v = i / width;
        const double x = (double)(2 * u > width ? width - u : u) / (double)width;
        const double y = (double)(2 * v > height ? height - v : v) / (double)height;
        if (i == 0 || x * x + y * y >= below * below) {
            re[i] = im[i] = 0;
        }
    }
}

static koksma_status errors(const koksma_metric_input *in, double *out)
{
    const size_t width = (size_t)in->width, height = (size_t)in->height, n = width * height;
    double *re = malloc(2 * n * sizeof *re), *im = re ? re + n : NULL;
    KOKSMA__REQUIRE_MEMORY(re, 2 * n * sizeof *re);
    for (size_t p = 0; p < n; p++) {
        re[p] = in->image[p] - in->reference[p];
        im[p] = 0;
    }
    koksma_status status = transform_plane(width, height, re, im);
    if (!status) {
        keep_low(width, height, in->params[0], re, im);
        status = transform_plane(width, height, re, im);
    }
    for (size_t p = 0; !status && p < n; p++) {
        const size_t x = (width - p % width) % width, y = (height - p / width) % height;
        const double e = re[y * width + x] / (double)n;
        out[p] = e * e;
    }
    free(re);
    return status;
}

static const koksma_param params[] = {
    {"below", "frequency, in cycles a pixel, below which an error is grain", 0.05, 0.001, 0.5, NULL, false},
    {0},
};

const koksma_metric koksma__metric_grain = {
    .name = "grain",
    .title = "low-frequency part of the root mean square error",
    .cite = "mitchell1992",
    .params = params,
    .channels = 1,
    .root = true,
    .order = 1,
    .errors = errors,
};
