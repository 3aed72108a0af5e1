/* SPDX-License-Identifier: Apache-2.0 */
/* Reading and writing of image files within the library. */
#ifndef KOKSMA_IMAGE_REGISTRY_H
#define KOKSMA_IMAGE_REGISTRY_H

#include <koksma/image.h>

#include "core/files.h"
#include "image/formats.h"

/* Reads an image as koksma_image_read does; `kind` is the kind of the file, and `by` tells whether the user or
   another file named it (core/files.h). */
koksma_status koksma__image_read(const char *path, koksma__file_kind kind, koksma__named by, koksma_image *out);

/* The part of an image file to read. COLOURS: in linear light. SRGB: in linear light, with levels read as sRGB
   whatever transfer function the file states. NUMBERS: the numbers of the file, without a transfer function. ALPHA:
   the transparency, which a file may lack. After an error *out has no pixels, but the size of those that were allocated
   and perhaps decoded before it. */
typedef enum koksma__image_part {
    KOKSMA__IMAGE_COLOURS,
    KOKSMA__IMAGE_SRGB,
    KOKSMA__IMAGE_NUMBERS,
    KOKSMA__IMAGE_ALPHA
} koksma__image_part;
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

/* Format i of the table; NULL past the end. */
const koksma__image_format *koksma__image_format_at(size_t i);

/* Reads an image file in memory, whose format is found by its content; kind: IMAGE or TEXTURE. Errors do not name the
   file. */
koksma_status koksma__image_read_bytes(const unsigned char *bytes, size_t size, koksma__file_kind kind,
                                       koksma_image *out);

#endif
