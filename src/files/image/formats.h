/* SPDX-License-Identifier: Apache-2.0 */
/* The table of image formats. Files are read from memory and written into memory, so that a format needs no file, a
   file is written whole or not at all, and a fuzzer can call the readers. */
#ifndef KOKSMA_IMAGE_FORMATS_H
#define KOKSMA_IMAGE_FORMATS_H

#include <koksma/image.h>

#include "core/files.h"
#include "modules/module.h"

/* A growing array of bytes. */
typedef struct koksma__bytes {
    unsigned char *data;
    size_t size, capacity;
} koksma__bytes;

typedef struct koksma__image_format {
    const char *name;
    bool (*recognises)(const unsigned char *bytes, size_t size);
    /* Reads an image. Errors do not name the file: the caller puts its name in front of the text. On failure the
       caller releases *out. */
    koksma_status (*read)(const unsigned char *bytes, size_t size, koksma_image *out);
    /* NULL, or reads an image as `read` does, but always with sRGB's transfer function, whatever function the file
       states. */
    koksma_status (*read_srgb)(const unsigned char *bytes, size_t size, koksma_image *out);
    /* NULL, or reads the numbers of the file, which `read` converts to other colours */
    koksma_status (*read_numbers)(const unsigned char *bytes, size_t size, koksma_image *out);
    /* NULL, or reads the transparency as an image of one channel, 1 where a pixel is opaque; the image is empty if
       the file has no transparency. */
    koksma_status (*read_alpha)(const unsigned char *bytes, size_t size, koksma_image *out);
    /* Writes the first of n layers, or all of them if has_layers is set. */
    koksma_status (*write)(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out);
    bool has_layers; /* whether a file can hold several layers */
    /* 0 if every float is kept exactly; otherwise numbers are clamped to [0,1], and this is their largest error */
    double error;
    const char *left_out; /* the library that the format needs and this build lacks, in which case read and write are
                             NULL; otherwise NULL */
    const koksma__module *module; /* the module that read and write load; NULL: none */
} koksma__image_format;

#define FORMAT(name) extern const koksma__image_format koksma__format_##name;
#include "image/formats.def"
#undef FORMAT

/* maximum length of a layer's name; capacity for a channel's name: the layer's name, ".R" and the final 0 */
enum { KOKSMA__LAYER_NAME = 63, KOKSMA__CHANNEL_NAME = KOKSMA__LAYER_NAME + 3 };

/* The maximum number of pixels of an image that a scene or model names: 8192 x 8192. */
enum { KOKSMA__TEXTURE_PIXELS = 1 << 26 };

/* Luminance of linear red, green and blue (Rec. 709), in doubles. */
#define KOKSMA__LUMINANCE(rgb) (0.2126 * (rgb)[0] + 0.7152 * (rgb)[1] + 0.0722 * (rgb)[2])

#endif
