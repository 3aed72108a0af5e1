/* SPDX-License-Identifier: Apache-2.0 */
/* JPEG as an image format. This file recognises JPEG files. The module koksma-jpeg.so, which is loaded when the first
   JPEG file is read or written, does the reading and writing. */
#include "image/formats.h"

static const koksma__module module = {
    "jpeg", "libjpeg-turbo", {koksma__fail, koksma__fail_memory, &koksma__codec_functions}};

static koksma_status read(const unsigned char *bytes, size_t size, koksma__image_part part, koksma_image *out)
{
    (void)part; /* levels are sRGB and numbers are linear, whatever is asked for */
    return koksma__codec_read(&module, bytes, size, out);
}

static koksma_status write(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out)
{
    return koksma__codec_write(&module, layers, n, metadata, out);
}

/* The error is that of four levels at 1, where the sRGB curve is steepest. */
const koksma__image_format koksma__format_jpg = {.name = "jpg",
                                                 .magic = {"\xff\xd8\xff"},
                                                 .read = read,
                                                 .write = write,
                                                 .error = 4.0 / 255 * 2.4 / 1.055,
                                                 .module = &module};
