/* SPDX-License-Identifier: Apache-2.0 */
/* JPEG as an image format. This file recognises JPEG files. The module koksma-jpeg.so, which is loaded when the first
   JPEG file is read or written, does the reading and writing. */
#include <string.h>

#include "image/image.h"
#include "image/jpeg.h"

static const koksma__jpeg_host host = {koksma__bytes_put, koksma__image_claim};
static const koksma__module module = {"jpeg", "libjpeg-turbo", {koksma__fail, koksma__fail_memory, &host}};

static bool recognises(const unsigned char *bytes, size_t size)
{
    static const unsigned char magic[3] = {0xff, 0xd8, 0xff};
    return size >= 3 && !memcmp(bytes, magic, 3);
}

static koksma_status read(const unsigned char *bytes, size_t size, koksma_image *out)
{
    const void *functions;
    const koksma_status status = koksma__module_load(&module, &functions);
    return status ? status : ((const koksma__jpeg_functions *)functions)->read(bytes, size, out);
}

static koksma_status write(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out)
{
    const void *functions;
    const koksma_status status = koksma__module_load(&module, &functions);
    (void)n; /* a file holds one layer */
    return status ? status : ((const koksma__jpeg_functions *)functions)->write(layers->image, metadata, out);
}

const koksma__image_format koksma__format_jpg = {.name = "jpg",
                                                 .recognises = recognises,
                                                 .read = read,
                                                 .write = write,
                                                 .error = 4.0 / 255 * 2.4 /
                                                          /* error of four levels at 1, where the sRGB curve is
                                                             steepest */
                                                          1.055,
                                                 .module = &module};
