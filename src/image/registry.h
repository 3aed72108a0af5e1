/* SPDX-License-Identifier: Apache-2.0 */
/* Image files for the library itself. */
#ifndef KOKSMA_IMAGE_REGISTRY_H
#define KOKSMA_IMAGE_REGISTRY_H

#include <koksma/image.h>

#include "core/read_file.h"

/* koksma_image_read of a kind of file, and who named it. */
koksma_status koksma__image_read(const char *path, koksma__file_kind kind, koksma__named by, koksma_image *out);

/* What is wanted of an image file: colours in linear light; numbers, as the file has them, which no curve belongs to;
   or the transparency, which may be none. */
typedef enum koksma__image_part {
    KOKSMA__IMAGE_COLOURS,
    KOKSMA__IMAGE_NUMBERS,
    KOKSMA__IMAGE_ALPHA
} koksma__image_part;
koksma_status koksma__image_read_part(const unsigned char *bytes, size_t size, koksma__image_part part,
                                      koksma_image *out);

/* For koksma__read_file: whether a file begins as an image that is read. Errors: MALFORMED, UNSUPPORTED. */
koksma_status koksma__image_check_start(const unsigned char *bytes, size_t size);

/* koksma_image_write of a file that the program names, below a folder (koksma__atomic_open). */
koksma_status koksma__image_write_in(const char *folder, const char *name, const koksma_image *image,
                                     const char *metadata);

#endif
