/* SPDX-License-Identifier: Apache-2.0 */
/* Reads and writes image files in the formats of formats.def; checks which layers may be written together, and names their
   channels. */
#include "image/formats.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"

static const koksma__image_format *const formats[] = {
#define FORMAT(name) &koksma__format_##name,
#include "image/formats.def"
#undef FORMAT
    NULL,
};

const koksma__image_format *koksma__image_format_at(size_t i)
{
    return i < sizeof formats / sizeof *formats ? formats[i] : NULL;
}

bool koksma__image_recognises(const koksma__image_format *format, const unsigned char *bytes, size_t size)
{
    bool begins = false;
    for (int k = 0; k < 2 && format->magic[k]; k++) {
        const size_t length = strlen(format->magic[k]);
        begins |= size >= length && !memcmp(bytes, format->magic[k], length);
    }
    return begins;
}

/* The library that a format needs and this build lacks, or NULL. */
static const char *missing(const koksma__image_format *format)
{
    return format->module && !koksma__module_exists(format->module) ? format->module->library : format->left_out;
}

const char *koksma_image_format(size_t i, const char **left_out)
{
    KOKSMA__REQUIRE_OR(NULL, left_out);
    const koksma__image_format *format = koksma__image_format_at(i);
    *left_out = format ? missing(format) : NULL;
    return format ? format->name : NULL;
}

static koksma_status no_library(const koksma__image_format *format)
{
    return format->module ? koksma__module_missing(format->module)
                          : koksma__fail(KOKSMA_UNSUPPORTED, "this build has no %s: it can't read or write .%s",
                                         format->left_out, format->name);
}

/* Lists the names of all formats as in "exr, png or pfm": before each name comes the text `before`; names are in
   capitals or lower case. */
static const char *list_names(const char *before, bool capitals, const char *comma, const char *last, char *text,
                              size_t size)
{
    size_t used = 0;
    for (size_t i = 0; formats[i] && used < size; i++) {
        const char *between = i == 0 ? "" : formats[i + 1] ? comma : last;
        used += (size_t)snprintf(text + used, size - used, "%s%s", between, before);
        for (const char *letter = formats[i]->name; *letter && used + 1 < size; letter++) {
            text[used++] = capitals ? (char)(*letter - 'a' + 'A') : *letter;
            text[used] = '\0';
        }
    }
    return text;
}

static koksma_status find_format(const unsigned char *bytes, size_t size, const koksma__image_format **out)
{
    char names[128];
    for (size_t i = 0; formats[i]; i++) {
        if (koksma__image_recognises(formats[i], bytes, size)) {
            *out = formats[i];
            return missing(formats[i]) ? no_library(formats[i]) : KOKSMA_OK;
        }
    }
    return size ? koksma__fail(KOKSMA_MALFORMED, "neither %s",
                               list_names("", true, " nor ", " nor ", names, sizeof names))
                : koksma__fail(KOKSMA_MALFORMED, "empty");
}

static _Thread_local char remark[160];

void koksma__image_remark(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    koksma__vsnprintf(remark, sizeof remark, format, arguments);
    va_end(arguments);
}

const char *koksma_image_remark(void)
{
    return remark;
}

koksma_status koksma__image_check_start(const unsigned char *bytes, size_t size)
{
    const koksma__image_format *format;
    return find_format(bytes, size, &format);
}

/* Applies the inverse sRGB curve, to undo the curve that png.c and jpeg_turbo.c apply. */
static void uncurve(koksma_image *image)
{
    const size_t n = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    for (size_t i = 0; i < n; i++) {
        image->pixels[i] = (float)koksma__to_srgb((double)image->pixels[i]);
    }
}

/* Reads a part of an image that has at most so many pixels. After an error *out has no pixels, but their size. */
static koksma_status read_part(const unsigned char *bytes, size_t size, koksma__image_part part, size_t most,
                               koksma_image *out)
{
    const koksma__image_format *format;
    *out = (koksma_image){0};
    *remark = 0;
    KOKSMA__TRY(find_format(bytes, size, &format));
    koksma__image_limit(most);
    const koksma_status status =
        part == KOKSMA__IMAGE_ALPHA && !format->has_alpha ? KOKSMA_OK : format->read(bytes, size, part, out);
    if (status) {
        free(out->pixels);
        out->pixels = NULL;
    } else if (part == KOKSMA__IMAGE_NUMBERS && format->error > 0) {
        uncurve(out);
    }
    return status;
}

koksma_status koksma__image_read_part(const unsigned char *bytes, size_t size, koksma__image_part part,
                                      koksma_image *out)
{
    return read_part(bytes, size, part, KOKSMA__TEXTURE_PIXELS, out);
}

koksma_status koksma__image_read_bytes(const unsigned char *bytes, size_t size, koksma__file_kind kind,
                                       koksma_image *out)
{
    const size_t most = kind == KOKSMA__FILE_TEXTURE ? KOKSMA__TEXTURE_PIXELS : KOKSMA_MAX_PIXELS;
    const koksma_status status = read_part(bytes, size, KOKSMA__IMAGE_COLOURS, most, out);
    if (status) {
        *out = (koksma_image){0};
    }
    return status;
}

koksma_status koksma__image_read(const char *path, koksma__file_kind kind, koksma__named by, koksma_image *out)
{
    KOKSMA__REQUIRE(path, out);
    unsigned char *bytes;
    size_t size;
    *out = (koksma_image){0};
    KOKSMA__TRY(koksma__read_file(path, kind, by, koksma__image_check_start, &bytes, &size));
    const koksma_status status = koksma__image_read_bytes(bytes, size, kind, out);
    free(bytes);
    return status ? koksma__fail_in(status, path) : KOKSMA_OK;
}

koksma_status koksma_image_read(const char *path, koksma_image *out)
{
    return koksma__image_read(path, KOKSMA__FILE_IMAGE, KOKSMA__BY_USER, out);
}

/* ---- Layers --------------------------------------------------------------------------------------------- */

/* Writes the name of channel k of a layer. */
static void layer_channel(const koksma_layer *layer, int k, char name[KOKSMA__CHANNEL_NAME])
{
    const char *dot = *layer->name ? "." : "";
    if (layer->image->channels == 1 && *layer->name) {
        snprintf(name, KOKSMA__CHANNEL_NAME, "%s", layer->name);
    } else {
        snprintf(name, KOKSMA__CHANNEL_NAME, "%s%s%c", layer->name, dot,
                 "YRGB"[layer->image->channels == 3 ? k + 1 : 0]);
    }
}

/* Returns the index of the first layer that has a channel of this name, or n if none has; *k is set to the index of
   the channel in the layer. */
static size_t layers_find(const koksma_layer *layers, size_t n, const char *wanted, int *k)
{
    char name[KOKSMA__CHANNEL_NAME];
    for (size_t l = 0; l < n; l++) {
        for (*k = 0; *k < layers[l].image->channels; ++*k) {
            layer_channel(&layers[l], *k, name);
            if (!strcmp(name, wanted)) {
                return l;
            }
        }
    }
    return n;
}

static koksma_status check_layer(const koksma_layer *layer, const koksma_image *first)
{
    KOKSMA__FAIL_IF(!layer->name || !layer->image, KOKSMA_ARGUMENT, "a layer without %s",
                    layer->name ? "an image" : "a name");
    KOKSMA__TRY(koksma__image_usable(layer->image));
    KOKSMA__FAIL_IF(strlen(layer->name) > KOKSMA__LAYER_NAME, KOKSMA_ARGUMENT, "the layer's name '%s' is too long",
                    layer->name);
    KOKSMA__FAIL_IF(layer->image->width != first->width || layer->image->height != first->height, KOKSMA_ARGUMENT,
                    "layer '%s' is of another size", layer->name);
    return KOKSMA_OK;
}

/* Fails with ARGUMENT unless the layers are images of one size, and no two channels have the same name. */
static koksma_status check_layers(const koksma_layer *layers, size_t n)
{
    char name[KOKSMA__CHANNEL_NAME];
    koksma_status status = n ? koksma__array_check("layers", layers, n, sizeof *layers)
                             : koksma__fail(KOKSMA_ARGUMENT, "no image to write");
    for (size_t l = 0; !status && l < n; l++) {
        status = check_layer(&layers[l], layers->image);
    }
    for (size_t l = 0; !status && l < n; l++) {
        for (int k = 0; k < layers[l].image->channels; k++) {
            int first;
            layer_channel(&layers[l], k, name);
            KOKSMA__FAIL_IF(layers_find(layers, n, name, &first) != l || first != k, KOKSMA_ARGUMENT,
                            "two layers have a channel '%s'", name);
        }
    }
    return status;
}

/* ---- Modules ------------------------------------------------------------------------------------------- */

const koksma__codec_host koksma__codec_functions = {koksma__bytes_put, koksma__image_claim, layer_channel,
                                                    layers_find, koksma_image_fini};

koksma_status koksma__codec_read(const koksma__module *module, const unsigned char *bytes, size_t size,
                                 koksma_image *out)
{
    const void *codec;
    KOKSMA__TRY(koksma__module_load(module, &codec));
    return ((const koksma__codec *)codec)->read(bytes, size, out);
}

koksma_status koksma__codec_write(const koksma__module *module, const koksma_layer *layers, size_t n,
                                  const char *metadata, koksma__bytes *out)
{
    const void *codec;
    KOKSMA__TRY(koksma__module_load(module, &codec));
    return ((const koksma__codec *)codec)->write(layers, n, metadata, out);
}

/* ---- Writing -------------------------------------------------------------------------------------------- */

static const koksma__image_format *format_of_name(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && formats[i]; i++) {
        if (!strcmp(dot + 1, formats[i]->name)) {
            return formats[i];
        }
    }
    return NULL;
}

koksma_status koksma_image_check_path(const char *path)
{
    KOKSMA__REQUIRE(path);
    const koksma__image_format *format = format_of_name(path);
    if (!format) {
        char names[128];
        return koksma__fail(KOKSMA_ARGUMENT, "%s: the name of an image file must end in %s",
                            *path ? path : "the path is empty",
                            list_names(".", false, ", ", " or ", names, sizeof names));
    }
    return missing(format) ? koksma__fail_in(no_library(format), path) : KOKSMA_OK;
}

bool koksma_image_has_layers(const char *path)
{
    KOKSMA__REQUIRE_OR(false, path);
    const koksma__image_format *format = format_of_name(path);
    return format && format->has_layers;
}

static koksma_status write_file(const char *folder, const char *path, const koksma_layer *layers, size_t n,
                                const char *metadata)
{
    KOKSMA__REQUIRE(path, layers);
    koksma__bytes bytes = {0};
    KOKSMA__TRY(koksma_image_check_path(path));
    koksma_status status = check_layers(layers, n);
    status = status ? status : format_of_name(path)->write(layers, n, metadata ? metadata : "", &bytes);
    status = status ? koksma__fail_in(status, path) : koksma__atomic_put(folder, path, bytes.data, bytes.size);
    free(bytes.data);
    return status;
}

koksma_status koksma_image_write_layers(const char *path, const koksma_layer *layers, size_t n, const char *metadata)
{
    return write_file(NULL, path, layers, n, metadata);
}

koksma_status koksma__image_write_in(const char *folder, const char *name, const koksma_image *image,
                                     const char *metadata)
{
    const koksma_layer only = {"", image};
    return write_file(folder, name, &only, 1, metadata);
}

koksma_status koksma_image_write(const char *path, const koksma_image *image, const char *metadata)
{
    KOKSMA__REQUIRE(path, image);
    const koksma_layer only = {"", image};
    return koksma_image_write_layers(path, &only, 1, metadata);
}

koksma_status koksma_image_png_bytes(const koksma_image *image, unsigned char **bytes, size_t *size)
{
    KOKSMA__REQUIRE(image, bytes, size);
    koksma__bytes out = {0};
    const koksma_layer only = {"", image};
    koksma_status status = check_layers(&only, 1);
    if (!status) {
        status = missing(&koksma__format_png) ? no_library(&koksma__format_png)
                                              : koksma__format_png.write(&only, 1, "", &out);
    }
    if (status) {
        free(out.data);
        out = (koksma__bytes){0};
    }
    *bytes = out.data;
    *size = out.size;
    return status;
}
