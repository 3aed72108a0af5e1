/* SPDX-License-Identifier: Apache-2.0 */
/* Image files: the table of formats, reading and writing, and layers. Files are read from memory and written into
   memory, so that a format needs no file, a file is written whole or not at all, and a fuzzer can call the readers. */
#ifndef KOKSMA_IMAGE_FORMATS_H
#define KOKSMA_IMAGE_FORMATS_H

#include <koksma/image.h>

#include "core/files.h"
#include "image/image.h"
#include "modules/module.h"

/* The part of an image file to read. COLOURS: in linear light. SRGB: in linear light, with levels read as sRGB
   whatever transfer function the file states. NUMBERS: the numbers of the file, without a transfer function. ALPHA:
   the transparency, which a file may lack. */
typedef enum koksma__image_part {
    KOKSMA__IMAGE_COLOURS,
    KOKSMA__IMAGE_SRGB,
    KOKSMA__IMAGE_NUMBERS,
    KOKSMA__IMAGE_ALPHA
} koksma__image_part;

typedef struct koksma__image_format {
    const char *name;
    const char *magic[2]; /* files begin with one of them */
    /* Reads a part of an image; the transparency is an image of one channel, 1 where a pixel is opaque, which is empty if
       the file has none. Errors do not name the file: the caller puts its name in front of the text. On failure the caller
       releases *out. */
    koksma_status (*read)(const unsigned char *bytes, size_t size, koksma__image_part part, koksma_image *out);
    bool has_alpha; /* whether a file can have a transparency */
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

/* Levels for a PNG file without a transfer function: channels is 1, 3 or 4, bits 8 or 16. Errors: UNSUPPORTED (no libpng),
   MEMORY. */
typedef struct koksma__levels {
    int width, height, channels, bits;
    const uint16_t *levels;
} koksma__levels;
koksma_status koksma__png_levels(const koksma__levels *levels, koksma__bytes *out);

/* ---- Reading and writing ---- */

/* Reads an image as koksma_image_read does; `kind` is the kind of the file, and `by` tells whether the user or
   another file named it (core/files.h). */
koksma_status koksma__image_read(const char *path, koksma__file_kind kind, koksma__named by, koksma_image *out);

/* Reads a part of an image in memory. After an error *out has no pixels, but the size of those that were allocated and
   perhaps decoded before it. */
koksma_status koksma__image_read_part(const unsigned char *bytes, size_t size, koksma__image_part part,
                                      koksma_image *out);

/* Sets the text of koksma_image_remark for the image that this thread reads. */
void koksma__image_remark(const char *format, ...) KOKSMA_PRINTF(1, 2);

/* A check for koksma__read_file: fails unless the file begins like an image in a supported format. Errors: MALFORMED,
   UNSUPPORTED. */
koksma_status koksma__image_check_start(const unsigned char *bytes, size_t size);

/* Writes an image as koksma_image_write does, to the file `name` in `folder`; the program, not the user, has chosen
   the name (koksma__atomic_open). */
koksma_status koksma__image_write_in(const char *folder, const char *name, const koksma_image *image,
                                     const char *metadata);

/* Whether a file begins like those of a format. */
bool koksma__image_recognises(const koksma__image_format *format, const unsigned char *bytes, size_t size);

/* Format i of the table; NULL past the end. */
const koksma__image_format *koksma__image_format_at(size_t i);

/* Reads an image file in memory, whose format is found by its content; kind: IMAGE or TEXTURE. Errors do not name the
   file. */
koksma_status koksma__image_read_bytes(const unsigned char *bytes, size_t size, koksma__file_kind kind,
                                       koksma_image *out);

/* ---- Codecs in modules ---- */

/* Functions that a module provides; koksma__image_format says what they do. */
typedef struct koksma__codec {
    koksma_status (*read)(const unsigned char *bytes, size_t size, koksma_image *out);
    koksma_status (*write)(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out);
} koksma__codec;

/* Functions that the library provides to a module. */
typedef struct koksma__codec_host {
    bool (*bytes_put)(koksma__bytes *bytes, size_t offset, const void *data, size_t size);
    koksma_status (*image_claim)(long long width, long long height, int channels, size_t bytes, double pixels_a_byte,
                                 koksma_image *out);
    void (*layer_channel)(const koksma_layer *layer, int k, char name[KOKSMA__CHANNEL_NAME]);
    size_t (*layers_find)(const koksma_layer *layers, size_t n, const char *wanted, int *k);
    void (*image_fini)(koksma_image *image);
} koksma__codec_host;

#define KOKSMA__CODEC_HOST ((const koksma__codec_host *)koksma__own_host->functions)

extern const koksma__codec_host koksma__codec_functions;

/* Read and write by a module. Errors: those of koksma__module_load and of the module. */
koksma_status koksma__codec_read(const koksma__module *module, const unsigned char *bytes, size_t size,
                                 koksma_image *out);
koksma_status koksma__codec_write(const koksma__module *module, const koksma_layer *layers, size_t n,
                                  const char *metadata, koksma__bytes *out);
#endif
