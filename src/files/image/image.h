/* SPDX-License-Identifier: Apache-2.0 */
/* Images in memory. */
#ifndef KOKSMA_IMAGE_IMAGE_H
#define KOKSMA_IMAGE_IMAGE_H

#include <koksma/image.h>

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"

/* A growing array of bytes. */
typedef struct koksma__bytes {
    unsigned char *data;
    size_t size, capacity;
} koksma__bytes;

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

/* Fails with ARGUMENT unless the image has pixels and valid dimensions. */
koksma_status koksma__image_usable(const koksma_image *image);

/* Fails with ARGUMENT unless both images have pixels and the same width and height. */
koksma_status koksma__image_check_sizes(const koksma_image *a, const koksma_image *b);

/* The maximum number of pixels of an image that a scene or model names: 8192 x 8192. */
enum { KOKSMA__TEXTURE_PIXELS = 1 << 26 };

/* Luminance of linear red, green and blue (Rec. 709), in doubles. */
#define KOKSMA__LUMINANCE(rgb) (0.2126 * (rgb)[0] + 0.7152 * (rgb)[1] + 0.0722 * (rgb)[2])

/* Returns the luminance of a pixel. */
static inline double koksma__luminance_of(const float rgb[3])
{
    return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

static inline double koksma__luminance(const koksma_image *image, size_t pixel)
{
    const float *p = image->pixels + pixel * (size_t)image->channels;
    return image->channels == 1 ? (double)p[0] : koksma__luminance_of(p);
}

/* The transfer function of sRGB (IEC 61966-2-1): linear light of a level of [0,1], its inverse, and the level of 8 bits. */
static inline double koksma__from_srgb(double level)
{
    return level <= 0.04045 ? level / 12.92 : koksma__pow((level + 0.055) / 1.055, 2.4);
}

static inline double koksma__to_srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * koksma__pow(linear, 1 / 2.4) - 0.055;
}

static inline unsigned char koksma__srgb_byte(float linear)
{
    const double x = linear >= 0 ? fmin((double)linear, 1) : 0; /* NaN is 0 */
    return (unsigned char)(255 * koksma__to_srgb(x) + 0.5);
}

/* A table of koksma__srgb_byte, for whole pictures: the least number of each byte, and the byte at the start of each
   128th of an octave from 2^-13 on, in which at most one byte begins (the steepest, at 1, has 78 an octave). */
enum { KOKSMA__SRGB_STEPS = 13 * 128, KOKSMA__SRGB_FIRST = 0x3900 }; /* the upper halves of floats: 2^-13 is 0x3900 */

typedef struct koksma__srgb_table {
    float least[257];
    unsigned char byte[KOKSMA__SRGB_STEPS + 1];
} koksma__srgb_table;

static inline void koksma__srgb_table_make(koksma__srgb_table *t)
{
    t->least[0] = 0;
    t->least[256] = HUGE_VALF;
    for (int b = 1; b < 256; b++) {
        float x = (float)koksma__from_srgb((b - 0.5) / 255);
        for (; koksma__srgb_byte(x) >= b; x = nextafterf(x, 0)) {
        }
        for (; koksma__srgb_byte(x) < b; x = nextafterf(x, 1)) {
        }
        t->least[b] = x;
    }
    for (uint32_t i = 0, b = 0; i <= KOKSMA__SRGB_STEPS; i++) {
        const uint32_t bits = (i + KOKSMA__SRGB_FIRST) << 16;
        float x;
        memcpy(&x, &bits, sizeof x);
        for (; t->least[b + 1] <= x; b++) {
        }
        t->byte[i] = (unsigned char)b;
    }
}

/* Does the same as koksma__srgb_byte. */
static inline unsigned char koksma__srgb_table_byte(const koksma__srgb_table *t, float linear)
{
    const float x = linear > 0 ? linear < 1 ? linear : 1 : 0; /* NaN and -0 are 0 */
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const uint32_t i = bits >> 16 > KOKSMA__SRGB_FIRST ? (bits >> 16) - KOKSMA__SRGB_FIRST : 0;
    return (unsigned char)(t->byte[i] + (t->least[t->byte[i] + 1] <= x));
}
#endif
