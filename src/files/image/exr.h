/* SPDX-License-Identifier: Apache-2.0 */
/* The interface between EXR as an image format (exr.c) and the module koksma-exr.so (exr_openexr.c, exr_rgba.c). */
#ifndef KOKSMA_IMAGE_EXR_H
#define KOKSMA_IMAGE_EXR_H

#include "image/formats.h"

/* Functions that the module provides; koksma__image_format (formats.h) says what they do. */
typedef struct koksma__exr_functions {
    koksma_status (*read)(const unsigned char *bytes, size_t size, koksma_image *out);
    koksma_status (*write)(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out);
} koksma__exr_functions;

/* Functions that the library provides to the module; formats.h documents them. */
typedef struct koksma__exr_host {
    bool (*bytes_put)(koksma__bytes *bytes, size_t offset, const void *data, size_t size);
    koksma_status (*image_claim)(long long width, long long height, int channels, size_t bytes, double pixels_a_byte,
                                 koksma_image *out);
    void (*layer_channel)(const koksma_layer *layer, int k, char name[KOKSMA__CHANNEL_NAME]);
    size_t (*layers_find)(const koksma_layer *layers, size_t n, const char *wanted, int *k);
    void (*image_fini)(koksma_image *image);
} koksma__exr_host;

#define KOKSMA__EXR_HOST ((const koksma__exr_host *)koksma__own_host->functions)

#endif
