/* SPDX-License-Identifier: Apache-2.0 */
/* The table of image formats. Files are read from memory and written into memory, so that a format needs no file, a
   file is written whole or not at all, and a fuzzer can call the readers. */
#ifndef KOKSMA_IMAGE_FORMATS_H
#define KOKSMA_IMAGE_FORMATS_H

#include <koksma/image.h>

#include "core/read_file.h"
#include "modules/module.h"

/* Bytes that grow. */
typedef struct koksma__bytes {
    unsigned char *data;
    size_t size, capacity;
} koksma__bytes;

/* Writes at an offset, filling a gap with zeros; false when memory runs out. */
bool koksma__bytes_put(koksma__bytes *bytes, size_t offset, const void *data, size_t size);

typedef struct koksma__image_format {
    const char *name;
    bool (*recognises)(const unsigned char *bytes, size_t size);
    /* Errors name no file: the caller puts its name in front. On failure *out is left for the caller to release. */
    koksma_status (*read)(const unsigned char *bytes, size_t size, koksma_image *out);
    /* NULL, or: the transparency, 1 where a pixel is opaque, as an image of one channel; none where the file has none. */
    koksma_status (*read_alpha)(const unsigned char *bytes, size_t size, koksma_image *out);
    /* Of n layers those that it has a place for: the first at least. */
    koksma_status (*write)(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out);
    bool has_layers; /* a file holds all layers; else the first alone */
    double error; /* 0: every float is kept exactly; else numbers in [0,1] to within this, others as the nearer end */
    const char *left_out; /* the library that this build does without: there is no read, no write; else NULL */
    const koksma__module *module; /* what read and write load; NULL: nothing */
} koksma__image_format;

#define FORMAT(name) extern const koksma__image_format koksma__format_##name;
#include "image/formats.def"
#undef FORMAT

enum { KOKSMA__LAYER_NAME = 63, KOKSMA__CHANNEL_NAME = KOKSMA__LAYER_NAME + 3 }; /* letters; room for ".R" and 0 */

/* What channel k of a layer is called. */
void koksma__layer_channel(const koksma_layer *layer, int k, char name[KOKSMA__CHANNEL_NAME]);

/* The first layer with a channel of that name, and which of its channels it is; n: none has it. */
size_t koksma__layers_find(const koksma_layer *layers, size_t n, const char *wanted, int *k);

/* ARGUMENT unless these are images, of one size, whose channels have a name each. Errors name no file. */
koksma_status koksma__layers_check(const koksma_layer *layers, size_t n);

/* ARGUMENT unless an image may have these. */
koksma_status koksma__image_check_shape(int width, int height, int channels);

/* NULL past the end. */
const koksma__image_format *koksma__image_format_at(size_t i);

/* The most pixels of an image that a scene or model names: 8192 x 8192. */
enum { KOKSMA__TEXTURE_PIXELS = 1 << 26 };

/* An image file in memory, known by its content; kind IMAGE or TEXTURE. Errors name no file. */
koksma_status koksma__image_read_bytes(const unsigned char *bytes, size_t size, koksma__file_kind kind,
                                       koksma_image *out);

/* Whether all its pixels are numbers below 1e30: a sun that is brighter than its file's numbers can say, or what was
   never computed, must not go dark without a word. MALFORMED names the first that is none, after `name`. */
koksma_status koksma__image_check(const koksma_image *image, const char *name);

/* koksma_image_init for sizes that a file claims: MALFORMED when they are out of range, or when `bytes` bytes can't
   hold so many pixels at `pixels_a_byte` at best. */
koksma_status koksma__image_claim(long long width, long long height, int channels, size_t bytes, double pixels_a_byte,
                                  koksma_image *out);

/* Rec. 709's, of linear red, green and blue in doubles. */
#define KOKSMA__LUMINANCE(rgb) (0.2126 * (rgb)[0] + 0.7152 * (rgb)[1] + 0.0722 * (rgb)[2])

/* Of a pixel. */
double koksma__luminance(const koksma_image *image, size_t pixel);

#endif
