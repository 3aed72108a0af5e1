/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The error of one image against another, as Shirley 1991 (section 5.5.6) measures it: e is the difference of the
 * luminances, and mean, SD and maximum are those of |e| over all pixels.
 *
 *     Y = 0.2126 R + 0.7152 G + 0.0722 B   (Rec. 709, linear)
 *     mean = sum |e| / n,  sd = sqrt(sum (|e| - mean)^2 / n),  rmse = sqrt(sum e^2 / n)
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "core/sum.h"
#include "image/formats.h"
#include "image/image.h"
#include "image/usable.h"

static double absolute_error(const koksma_image *image, const koksma_image *reference, size_t pixel)
{
    return fabs(koksma__luminance(image, pixel) - koksma__luminance(reference, pixel));
}

koksma_status koksma_image_compare(const koksma_image *image, const koksma_image *reference, koksma_image_error *out)
{
    KOKSMA__REQUIRE(image, reference, out);
    KOKSMA__TRY(koksma__image_check_sizes(image, reference));
    const size_t n = (size_t)image->width * (size_t)image->height;
    koksma__sum sum = {0}, squares = {0}, deviations = {0};
    double max = 0;
    for (size_t i = 0; i < n; i++) {
        const double e = absolute_error(image, reference, i);
        koksma__sum_add(&sum, e);
        koksma__sum_add(&squares, e * e);
        max = e > max || isnan(e) ? e : max;
    }
    const double count = (double)n, mean = koksma__sum_value(&sum) / count;
    for (size_t i = 0; i < n; i++) {
        const double d = absolute_error(image, reference, i) - mean;
        koksma__sum_add(&deviations, d * d);
    }
    *out = (koksma_image_error){
        .mean = mean,
        .sd = sqrt(koksma__sum_value(&deviations) / count),
        .max = max,
        .rmse = sqrt(koksma__sum_value(&squares) / count),
    };
    return KOKSMA_OK;
}

koksma_status koksma_image_difference(const koksma_image *image, const koksma_image *reference, koksma_image *out)
{
    KOKSMA__REQUIRE(image, reference, out);
    *out = (koksma_image){0};
    koksma_status status = koksma__image_check_sizes(image, reference);
    if (!status) {
        status = koksma_image_init(out, image->width, image->height, 1);
    }
    for (size_t i = 0; !status && i < (size_t)image->width * (size_t)image->height; i++) {
        out->pixels[i] = (float)absolute_error(image, reference, i);
    }
    return status;
}
