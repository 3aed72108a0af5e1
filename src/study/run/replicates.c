/* SPDX-License-Identifier: Apache-2.0 */
/* A picture from many independent renders, and how far it is off: for k replicates with the sample deviation s of a
   pixel's luminance, a normal error of deviation s / sqrt k has the mean absolute value sqrt(2/pi) s / sqrt k; the
   mean of that over the pixels is the picture's own expected absolute error (of luminance, as all errors of images:
   image/compare.c). Deviations are updated replicate by replicate (Welford 1962), so that equal ones have none. */
#include "study/run/replicates.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "image/formats.h"

size_t koksma__replicates_numbers(const koksma__replicates *s)
{
    return s->pixels * (s->channels + 2);
}

koksma__replicates koksma__replicates_over(double *numbers, size_t n, size_t pixels)
{
    double *luminance = numbers + (n - 2 * pixels);
    return (koksma__replicates){.sum = numbers,
                                .luminance = luminance,
                                .squares = luminance + pixels,
                                .pixels = pixels,
                                .channels = n / pixels - 2};
}

koksma_status koksma__replicates_init(koksma__replicates *s, size_t pixels, size_t channels)
{
    const size_t n = koksma__replicates_numbers(&(koksma__replicates){.pixels = pixels, .channels = channels});
    double *zeros = calloc(n, sizeof *zeros);
    KOKSMA__REQUIRE_MEMORY(zeros, n * sizeof *zeros);
    *s = koksma__replicates_over(zeros, n, pixels);
    return KOKSMA_OK;
}

koksma_status koksma__replicates_add(koksma__replicates *s, const koksma_image *image)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    KOKSMA__TRY(s->sum ? KOKSMA_OK : koksma__replicates_init(s, pixels, (size_t)image->channels));
    s->n++;
    for (size_t i = 0; i < pixels * s->channels; i++) {
        s->sum[i] += (double)image->pixels[i];
    }
    for (size_t p = 0; p < pixels; p++) {
        const double y = koksma__luminance(image, p), off = y - s->luminance[p];
        s->luminance[p] += off / (double)s->n;
        s->squares[p] += off * (y - s->luminance[p]);
    }
    return KOKSMA_OK;
}

static double standard_error(const koksma__replicates *s)
{
    const double k = (double)s->n;
    double total = 0;
    for (size_t p = 0; p < s->pixels; p++) {
        total += sqrt(2 / M_PI * s->squares[p] / (k - 1) / k);
    }
    return s->n < 2 ? (double)NAN : total / (double)s->pixels;
}

koksma_status koksma__replicates_mean(const koksma__replicates *s, int width, int height, koksma_image *out,
                                      double *error)
{
    const koksma_status status = koksma_image_init(out, width, height, (int)s->channels);
    for (size_t i = 0; !status && i < s->pixels * s->channels; i++) {
        out->pixels[i] = (float)(s->sum[i] / (double)s->n);
    }
    *error = standard_error(s);
    return status;
}
