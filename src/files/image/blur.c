/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Blurs pictures by a Gaussian: rows and then columns, with weights exp(-x^2 / (2 sd^2)) for |x| <= 4 sd, divided by the
 * sum of those that lie inside the picture, so that a constant stays constant up to the edges. O(n sd).
 */
#include "image/blur.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/status.h"
#include "image/image.h"

/* Blurs `lines` lines of `length` numbers: number i of line l is at index l * next + i * stride. scratch: `length`
   numbers. */
static void blur_lines(size_t length, size_t stride, size_t lines, size_t next, const double *weights, size_t radius,
                       double *values, double *scratch)
{
    for (size_t l = 0; l < lines; l++) {
        double *line = values + l * next;
        for (size_t i = 0; i < length; i++) {
            const size_t first = i > radius ? i - radius : 0, end = i + radius < length ? i + radius + 1 : length;
            double sum = 0, total = 0;
            for (size_t j = first; j < end; j++) {
                const double w = weights[j > i ? j - i : i - j];
                sum += w * line[j * stride];
                total += w;
            }
            scratch[i] = sum / total;
        }
        for (size_t i = 0; i < length; i++) {
            line[i * stride] = scratch[i];
        }
    }
}

koksma_status koksma__blur(int width, int height, double sd, double *values)
{
    const size_t w = (size_t)width, h = (size_t)height, longest = w > h ? w : h;
    const size_t radius = (size_t)ceil(4 * sd), size = (radius + 1 + longest) * sizeof(double);
    if (!(sd > 0)) {
        return KOKSMA_OK;
    }
    double *weights = malloc(size);
    KOKSMA__REQUIRE_MEMORY(weights, size);
    for (size_t i = 0; i <= radius; i++) {
        weights[i] = koksma__exp(-(double)(i * i) / (2 * sd * sd));
    }
    blur_lines(w, 1, h, w, weights, radius, values, weights + radius + 1);
    blur_lines(h, w, w, 1, weights, radius, values, weights + radius + 1);
    free(weights);
    return KOKSMA_OK;
}

koksma_status koksma_image_blur(const koksma_image *image, double sd, koksma_image *out)
{
    KOKSMA__REQUIRE(image, out);
    KOKSMA__TRY(koksma__image_usable(image));
    KOKSMA__FAIL_IF(!(sd >= 0 && sd <= KOKSMA__MOST_BLUR), KOKSMA_ARGUMENT, "sd = %g: it must be 0 to %d pixels", sd,
                    KOKSMA__MOST_BLUR);
    const size_t n = (size_t)image->width * (size_t)image->height, channels = (size_t)image->channels;
    KOKSMA__TRY(koksma_image_init(out, image->width, image->height, image->channels));
    double *plane = malloc(n * sizeof *plane);
    koksma_status status = plane ? KOKSMA_OK : koksma__fail_memory(n * sizeof *plane);
    for (size_t c = 0; !status && c < channels; c++) {
        for (size_t p = 0; p < n; p++) {
            plane[p] = (double)image->pixels[p * channels + c];
        }
        status = koksma__blur(image->width, image->height, sd, plane);
        for (size_t p = 0; p < n; p++) {
            out->pixels[p * channels + c] = (float)plane[p];
        }
    }
    free(plane);
    if (status) {
        koksma_image_fini(out);
    }
    return status;
}
