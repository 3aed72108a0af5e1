/* SPDX-License-Identifier: Apache-2.0 */
/* The interface between the image formats whose library is a module (exr.c, jpg.c) and these modules, koksma-exr.so
   (exr_openexr.c) and koksma-jpeg.so (jpeg_turbo.c). */
#ifndef KOKSMA_IMAGE_CODEC_H
#define KOKSMA_IMAGE_CODEC_H

#include "image/formats.h"

/* Functions that a module provides; koksma__image_format (formats.h) says what they do. */
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
