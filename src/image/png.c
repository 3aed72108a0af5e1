/* SPDX-License-Identifier: Apache-2.0 */
/*
 * PNG by libpng. 8-bit files are sRGB, whose curve (IEC 61966-2-1) is applied here in double precision:
 *     linear = s / 12.92 for s <= 0.04045, else ((s + 0.055) / 1.055)^2.4
 * 16-bit files come as linear numbers from libpng. Transparency is put over black. Written are 8 bits sRGB.
 */
#ifdef KOKSMA_PNG
#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "image/formats.h"

static bool recognises(const unsigned char *bytes, size_t size)
{
    return size >= 8 && !png_sig_cmp(bytes, 0, 8);
}

static void to_linear(const unsigned char *bytes, size_t count, float *out)
{
    float table[256];
    for (int i = 0; i < 256; i++) {
        const double s = i / 255.0;
        table[i] = (float)(s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4));
    }
    for (size_t i = 0; i < count; i++) {
        out[i] = table[bytes[i]];
    }
}

/* libpng makes room for what a chunk claims to hold before it reads it, up to 2 GiB: so no chunk may claim more than
   the file has. */
static koksma_status check_chunks(const unsigned char *bytes, size_t size)
{
    for (size_t at = 8; size - at >= 12;) {
        const size_t length = (size_t)bytes[at] << 24 | (size_t)bytes[at + 1] << 16 | (size_t)bytes[at + 2] << 8 |
                              (size_t)bytes[at + 3];
        if (length > size - at - 12) {
            return koksma__fail(KOKSMA_MALFORMED, "as a PNG: cut short: a chunk claims %zu bytes, and %zu are left",
                                length, size - at - 12);
        }
        if (!memcmp(bytes + at + 4, "IEND", 4)) {
            break;
        }
        at += 12 + length;
    }
    return KOKSMA_OK;
}

static koksma_status read(const unsigned char *bytes, size_t size, koksma_image *out)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    koksma_status status = check_chunks(bytes, size);
    if (status) {
        return status;
    }
    if (!png_image_begin_read_from_memory(&png, bytes, size)) {
        return koksma__fail(KOKSMA_MALFORMED, "as a PNG: %s", png.message);
    }
    const bool wide = (png.format & PNG_FORMAT_FLAG_LINEAR) != 0;
    const int channels = png.format & PNG_FORMAT_FLAG_COLOR ? 3 : 1;
    /* Deflate packs 1032 bytes into one at most, and a pixel has 1 bit at least. */
    status = koksma__image_claim(png.width, png.height, channels, size, 8 * 1032, out);
    const size_t count = (size_t)png.width * png.height * (size_t)channels;
    void *buffer = status ? NULL : calloc(count, wide ? 2 : 1);
    if (!status && !buffer) {
        status = koksma__fail_memory(count);
    }
    if (!status) {
        png.format = channels == 3 ? (wide ? PNG_FORMAT_LINEAR_RGB : PNG_FORMAT_RGB)
                                   : (wide ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_GRAY);
        const png_color black = {0};
        if (!png_image_finish_read(&png, &black, buffer, 0, NULL)) {
            status = koksma__fail(KOKSMA_MALFORMED, "as a PNG: %s", png.message);
        }
    }
    if (!status && wide) {
        for (size_t i = 0; i < count; i++) {
            out->pixels[i] = (float)((const png_uint_16 *)buffer)[i] / 65535.0f;
        }
    } else if (!status) {
        to_linear(buffer, count, out->pixels);
    }
    free(buffer);
    png_image_free(&png);
    return status;
}

static unsigned char to_srgb(float linear)
{
    const double x = linear >= 0 ? fmin((double)linear, 1) : 0; /* NaN is 0 */
    const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
    return (unsigned char)(255 * s + 0.5);
}

typedef struct sink {
    koksma__bytes *out;
    bool failed;
    char message[128];
} sink;

static void put(png_structp png, png_bytep data, size_t size)
{
    sink *s = png_get_io_ptr(png);
    if (!koksma__bytes_put(s->out, s->out->size, data, size)) {
        png_error(png, "out of memory");
    }
}

static void flush(png_structp png)
{
    (void)png;
}

static void on_error(png_structp png, png_const_charp message)
{
    sink *s = png_get_error_ptr(png);
    strncpy(s->message, message, sizeof s->message - 1);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void put_metadata(png_structp png, png_infop info, const char *metadata)
{
    char key[] = "Comment";
    png_text text = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = key};
    text.text = (char *)(uintptr_t)metadata; /* libpng copies it */
    text.text_length = strlen(metadata);
    if (*metadata) {
        png_set_text(png, info, &text, 1);
    }
}

/* All that may longjmp; nothing here that would need releasing. */
static bool put_image(png_structp png, png_infop info, const koksma_image *image, const char *metadata,
                      unsigned char *row)
{
    if (setjmp(png_jmpbuf(png))) {
        return false;
    }
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8,
                 image->channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    put_metadata(png, info, metadata);
    png_write_info(png, info);
    const size_t count = (size_t)image->width * (size_t)image->channels;
    for (int y = 0; y < image->height; y++) {
        for (size_t i = 0; i < count; i++) {
            row[i] = to_srgb(image->pixels[(size_t)y * count + i]);
        }
        png_write_row(png, row);
    }
    png_write_end(png, NULL);
    return true;
}

static koksma_status write(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out)
{
    const koksma_image *image = layers->image; /* one has a place */
    (void)n;
    sink s = {.out = out};
    const size_t count = (size_t)image->width * (size_t)image->channels;
    unsigned char *row = malloc(count);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &s, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    koksma_status status = KOKSMA_OK;
    if (!row || !info) {
        status = koksma__fail_memory(count);
    } else {
        png_set_write_fn(png, &s, put, flush);
        if (!put_image(png, info, image, metadata, row)) {
            status = koksma__fail(KOKSMA_MEMORY, "as a PNG: %s", s.message);
        }
    }
    png_destroy_write_struct(&png, &info);
    free(row);
    return status;
}

const koksma__image_format koksma__format_png = {"png", recognises, read, write, NULL};
#else

#include <string.h>

#include "image/formats.h"

static bool recognises(const unsigned char *bytes, size_t size)
{
    static const unsigned char magic[4] = {0x89, 'P', 'N', 'G'};
    return size >= 4 && !memcmp(bytes, magic, 4);
}

const koksma__image_format koksma__format_png = {"png", recognises, NULL, NULL, "libpng"};

#endif
