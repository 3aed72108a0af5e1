/* SPDX-License-Identifier: Apache-2.0 */
/* The interface between JPEG as an image format (jpg.c) and the module koksma-jpeg.so (jpeg_turbo.c). */
#ifndef KOKSMA_IMAGE_JPEG_H
#define KOKSMA_IMAGE_JPEG_H

#include "image/formats.h"

/* Functions that the module provides; koksma__image_format (formats.h) says what they do. */
typedef struct koksma__jpeg_functions {
    koksma_status (*read)(const unsigned char *bytes, size_t size, koksma_image *out);
    koksma_status (*write)(const koksma_image *image, const char *metadata, koksma__bytes *out);
} koksma__jpeg_functions;

/* Functions that the library provides to the module; formats.h documents them. */
typedef struct koksma__jpeg_host {
    bool (*bytes_put)(koksma__bytes *bytes, size_t offset, const void *data, size_t size);
    koksma_status (*image_claim)(long long width, long long height, int channels, size_t bytes, double pixels_a_byte,
                                 koksma_image *out);
} koksma__jpeg_host;

#endif
