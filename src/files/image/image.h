/* SPDX-License-Identifier: Apache-2.0 */
/* Images in memory. */
#ifndef KOKSMA_IMAGE_IMAGE_H
#define KOKSMA_IMAGE_IMAGE_H

#include <koksma/image.h>

#include "image/formats.h"

/* Writes data at an offset of the array, which grows if needed, and fills a gap before it with zeros; returns false
   if memory runs out. */
bool koksma__bytes_put(koksma__bytes *bytes, size_t offset, const void *data, size_t size);

/* Fails with ARGUMENT unless an image can have this width, height and number of channels. */
koksma_status koksma__image_check_shape(int width, int height, int channels);

/* Checks that all pixels are numbers below 1e30. Other values come from a sun that is too bright for the file's
   number format, or from a failed computation; they must not be drawn as black without an error. Errors: MALFORMED
   (the message has `name` and the first bad pixel). */
koksma_status koksma__image_check(const koksma_image *image, const char *name);

/* Sets the largest number of pixels that koksma__image_claim accepts in this thread. */
void koksma__image_limit(size_t pixels);

/* Allocates an image, as koksma_image_init does, of the size that a file claims. Errors: MALFORMED (the size is out
   of range, or too large for a file of `bytes` bytes that has at most `pixels_a_byte` pixels for each byte),
   MEMORY. */
koksma_status koksma__image_claim(long long width, long long height, int channels, size_t bytes, double pixels_a_byte,
                                  koksma_image *out);

/* Returns the luminance of a pixel. */
double koksma__luminance(const koksma_image *image, size_t pixel);

#endif
