/* SPDX-License-Identifier: Apache-2.0 */
/*
 * EXR as an image format. This file recognises EXR files. The module koksma-exr.so, which is loaded when the first EXR
 * file is read or written, does the reading and writing.
 *
 * OpenEXR takes time quadratic in the numbers of attributes and channels: 100,000 channels, in 2.4 MB, take a minute. So
 * both are counted, over all parts of a file, before OpenEXR sees the file. Films have some hundreds of channels.
 */
#include <string.h>

#include "image/exr.h"

#include "core/status.h"
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

enum { MOST_ATTRIBUTES = 4096, MOST_CHANNELS = 4096 };

/* The position after the text at `at` and its zero byte; `size` if it has no end. */
static size_t skip_text(const unsigned char *bytes, size_t size, size_t at)
{
    const unsigned char *end = at < size ? memchr(bytes + at, 0, size - at) : NULL;
    return end ? (size_t)(end - bytes) + 1 : size;
}

/* A channel is its name with a zero byte and 16 more bytes; an empty name ends the list. */
static size_t count_channels(const unsigned char *value, size_t size)
{
    size_t n = 0;
    for (size_t at = 0; at < size && value[at]; n++) {
        at = skip_text(value, size, at) + 16;
    }
    return n;
}

/* An attribute is name, type, size and value; an empty name ends a header, and an empty header ends the headers of a
   file of several parts (https://openexr.com/en/latest/OpenEXRFileLayout.html). At a size that is wrong counting ends,
   as reading does. */
static koksma_status check_header(const unsigned char *bytes, size_t size)
{
    const bool parts = size > 8 && (bytes[5] & 0x10);
    size_t attributes = 0, channels = 0;
    for (size_t at = 8; at < size && bytes[at] && attributes <= MOST_ATTRIBUTES && channels <= MOST_CHANNELS;) {
        const size_t type = skip_text(bytes, size, at), length = skip_text(bytes, size, type);
        if (size - length < 4) {
            break;
        }
        const size_t value = bytes[length] | (size_t)bytes[length + 1] << 8 | (size_t)bytes[length + 2] << 16 |
                             (size_t)bytes[length + 3] << 24;
        const size_t left = size - length - 4;
        attributes++;
        channels += strcmp((const char *)bytes + type, "chlist") != 0
                        ? 0
                        : count_channels(bytes + length + 4, value < left ? value : left);
        at = value < left ? length + 4 + value : size;
        at += parts && at + 1 < size && !bytes[at];
    }
    if (attributes > MOST_ATTRIBUTES || channels > MOST_CHANNELS) {
        return koksma__refused(koksma__fail(KOKSMA_MALFORMED, "as an EXR: more than %d attributes or %d channels",
                                            MOST_ATTRIBUTES, MOST_CHANNELS));
    }
    return KOKSMA_OK;
}

static koksma_status read(const unsigned char *bytes, size_t size, koksma_image *out)
{
    KOKSMA__TRY(check_header(bytes, size));
    const void *functions;
    const koksma_status status = koksma__module_load(&module, &functions);
    return status ? status : ((const koksma__exr_functions *)functions)->read(bytes, size, out);
}

static koksma_status write(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out)
{
    const void *functions;
    size_t channels = 0;
    for (size_t i = 0; i < n; i++) {
        channels += (size_t)layers[i].image->channels;
    }
    KOKSMA__FAIL_IF(channels > MOST_CHANNELS, KOKSMA_ARGUMENT, "layers of %zu channels: an EXR has at most %d here",
                    channels, MOST_CHANNELS);
    const koksma_status status = koksma__module_load(&module, &functions);
    return status ? status : ((const koksma__exr_functions *)functions)->write(layers, n, metadata, out);
}

const koksma__image_format koksma__format_exr = {
    .name = "exr", .recognises = recognises, .read = read, .write = write, .has_layers = true, .module = &module};
