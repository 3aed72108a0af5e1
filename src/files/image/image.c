/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Images in memory: allocation, checks of sizes and numbers, and the error of one image against another, as Shirley 1991
 * (section 5.5.6) measures it: e is the difference of the luminances, and mean, SD and maximum are those of |e| over all
 * pixels.
 *
 *     Y = 0.2126 R + 0.7152 G + 0.0722 B   (Rec. 709, linear)
 *     mean = sum |e| / n,  sd = sqrt(sum (|e| - mean)^2 / n),  rmse = sqrt(sum e^2 / n)
 */
#include "image/image.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/sum.h"

bool koksma__bytes_put(koksma__bytes *bytes, size_t offset, const void *data, size_t size)
{
    if (offset + size > bytes->capacity) {
        const size_t capacity = 2 * (offset + size) + 4096;
        unsigned char *more = realloc(bytes->data, capacity);
        if (!more) {
            return false;
        }
        bytes->data = more;
        bytes->capacity = capacity;
    }
    if (offset > bytes->size) {
        memset(bytes->data + bytes->size, 0, offset - bytes->size);
    }
    memcpy(bytes->data + offset, data, size);
    bytes->size = offset + size > bytes->size ? offset + size : bytes->size;
    return true;
}

koksma_status koksma__image_check_shape(int width, int height, int channels)
{
    KOKSMA__FAIL_IF(width < 1 || height < 1 || width > KOKSMA_MAX_IMAGE_SIDE || height > KOKSMA_MAX_IMAGE_SIDE ||
                        (size_t)width * (size_t)height > KOKSMA_MAX_PIXELS,
                    KOKSMA_ARGUMENT,
                    "%d x %d pixels: each side must be 1 to %d, and the number of pixels at most %zu", width, height,
                    KOKSMA_MAX_IMAGE_SIDE, KOKSMA_MAX_PIXELS);
    KOKSMA__FAIL_IF(channels != 1 && channels != 3, KOKSMA_ARGUMENT, "%d channels: an image has 1 or 3", channels);
    return KOKSMA_OK;
}

koksma_status koksma__image_usable(const koksma_image *image)
{
    KOKSMA__FAIL_IF(!image->pixels, KOKSMA_ARGUMENT, "an image without pixels");
    return koksma__image_check_shape(image->width, image->height, image->channels);
}

koksma_status koksma__image_check_sizes(const koksma_image *a, const koksma_image *b)
{
    KOKSMA__TRY(koksma__image_usable(a));
    KOKSMA__TRY(koksma__image_usable(b));
    KOKSMA__FAIL_IF(a->width != b->width || a->height != b->height, KOKSMA_ARGUMENT,
                    "an image of %d x %d pixels can't be compared with one of %d x %d", a->width, a->height, b->width,
                    b->height);
    return KOKSMA_OK;
}

koksma_status koksma_image_init(koksma_image *image, int width, int height, int channels)
{
    KOKSMA__REQUIRE(image);
    *image = (koksma_image){0};
    KOKSMA__TRY(koksma__image_check_shape(width, height, channels));
    const size_t count = (size_t)width * (size_t)height * (size_t)channels;
    image->pixels = calloc(count, sizeof *image->pixels);
    KOKSMA__REQUIRE_MEMORY(image->pixels, count * sizeof *image->pixels);
    image->width = width;
    image->height = height;
    image->channels = channels;
    return KOKSMA_OK;
}

void koksma_image_fini(koksma_image *image)
{
    if (image) {
        free(image->pixels);
        *image = (koksma_image){0};
    }
}

/* The largest number of pixels that this thread accepts in an image file. */
static _Thread_local size_t most_pixels = KOKSMA_MAX_PIXELS;

void koksma__image_limit(size_t pixels)
{
    most_pixels = pixels;
}

koksma_status koksma__image_claim(long long width, long long height, int channels, size_t bytes, double pixels_a_byte,
                                  koksma_image *out)
{
    if (width < 1 || height < 1 || width > KOKSMA_MAX_IMAGE_SIDE || height > KOKSMA_MAX_IMAGE_SIDE ||
        (size_t)(width * height) > most_pixels) {
        return koksma__refused(koksma__fail(
            KOKSMA_MALFORMED,
            "it claims %lld x %lld pixels: each side must be 1 to %d, and the number of pixels at most %zu", width,
            height, KOKSMA_MAX_IMAGE_SIDE, most_pixels));
    }
    KOKSMA__FAIL_IF((double)width * (double)height > (double)bytes * pixels_a_byte, KOKSMA_MALFORMED,
                    "cut short: it claims %lld x %lld pixels but has only %zu bytes", width, height, bytes);
    return koksma_image_init(out, (int)width, (int)height, channels);
}

static size_t count_numbers(const koksma_image *image)
{
    return (size_t)image->width * (size_t)image->height * (size_t)image->channels;
}

static koksma_status refuse_number(const koksma_image *image, size_t i, const char *name)
{
    const size_t pixel = i / (size_t)image->channels, width = (size_t)image->width;
    return koksma__fail(KOKSMA_MALFORMED, "%s: pixel %zu,%zu has the value %g", name, pixel % width, pixel / width,
                        (double)image->pixels[i]);
}

koksma_status koksma__image_check(const koksma_image *image, const char *name)
{
    for (size_t i = 0; i < count_numbers(image); i++) {
        if (!(image->pixels[i] < 1e30f)) {
            return refuse_number(image, i, name);
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma_image_check_finite(const koksma_image *image, const char *name)
{
    KOKSMA__REQUIRE(image, name);
    KOKSMA__TRY(koksma__image_usable(image));
    for (size_t i = 0; i < count_numbers(image); i++) {
        if (!isfinite(image->pixels[i])) {
            return refuse_number(image, i, name);
        }
    }
    return KOKSMA_OK;
}

static double absolute_error(const koksma_image *image, const koksma_image *reference, size_t pixel)
{
    return fabs(koksma__luminance(image, pixel) - koksma__luminance(reference, pixel));
}

enum { BLOCK = 512 };

/* The errors of `size` pixels from `first` on, in lanes. */
static void absolute_errors(const koksma_image *image, const koksma_image *reference, size_t first, size_t size,
                            double *out)
{
    if (image->channels == 3 && reference->channels == 3) {
        for (size_t i = 0; i < size; i++) {
            const float *a = image->pixels + 3 * (first + i), *b = reference->pixels + 3 * (first + i);
            out[i] = fabs(koksma__luminance_of(a) - koksma__luminance_of(b));
        }
    } else {
        for (size_t i = 0; i < size; i++) {
            out[i] = absolute_error(image, reference, first + i);
        }
    }
}

koksma_status koksma_image_compare(const koksma_image *image, const koksma_image *reference, koksma_image_error *out)
{
    KOKSMA__REQUIRE(image, reference, out);
    KOKSMA__TRY(koksma__image_check_sizes(image, reference));
    const size_t n = (size_t)image->width * (size_t)image->height;
    koksma__sum sum = {0}, squares = {0}, deviations = {0};
    double max = 0, e[BLOCK];
    for (size_t first = 0; first < n; first += BLOCK) {
        const size_t size = n - first < BLOCK ? n - first : BLOCK;
        absolute_errors(image, reference, first, size, e);
        for (size_t i = 0; i < size; i++) {
            koksma__sum_add(&sum, e[i]);
            koksma__sum_add(&squares, e[i] * e[i]);
            max = e[i] > max || isnan(e[i]) ? e[i] : max;
        }
    }
    const double count = (double)n, mean = koksma__sum_value(&sum) / count;
    for (size_t first = 0; first < n; first += BLOCK) {
        const size_t size = n - first < BLOCK ? n - first : BLOCK;
        absolute_errors(image, reference, first, size, e);
        for (size_t i = 0; i < size; i++) {
            koksma__sum_add(&deviations, (e[i] - mean) * (e[i] - mean));
        }
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
