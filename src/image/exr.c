/* SPDX-License-Identifier: Apache-2.0 */
/* EXR as an image format. This file recognises EXR files. The module koksma-exr.so, which is loaded when the first
   EXR file is read or written, does the reading and writing. */
#include <string.h>

#include "image/exr.h"

#include "image/image.h"
#include "image/layers.h"

static const koksma__exr_host host = {koksma__bytes_put, koksma__image_claim, koksma__layer_channel,
                                      koksma__layers_find, koksma_image_fini};
static const koksma__module module = {"exr", "OpenEXR", {koksma__fail, koksma__fail_memory, &host}};

static bool recognises(const unsigned char *bytes, size_t size)
{
    static const unsigned char magic[4] = {0x76, 0x2f, 0x31, 0x01};
    return size >= 4 && !memcmp(bytes, magic, 4);
}

static koksma_status read(const unsigned char *bytes, size_t size, koksma_image *out)
{
    const void *functions;
    const koksma_status status = koksma__module_load(&module, &functions);
    return status ? status : ((const koksma__exr_functions *)functions)->read(bytes, size, out);
}

static koksma_status write(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out)
{
    const void *functions;
    const koksma_status status = koksma__module_load(&module, &functions);
    return status ? status : ((const koksma__exr_functions *)functions)->write(layers, n, metadata, out);
}

const koksma__image_format koksma__format_exr = {
    .name = "exr", .recognises = recognises, .read = read, .write = write, .has_layers = true, .module = &module};
