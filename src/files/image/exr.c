/* SPDX-License-Identifier: Apache-2.0 */
/*
 * EXR as an image format. This file recognises EXR files. The module koksma-exr.so, which is loaded when the first EXR
 * file is read or written, does the reading and writing.
 *
 * OpenEXR takes time quadratic in the numbers of attributes and channels: 100,000 channels, in 2.4 MB, take a minute. So
 * both are counted, over all parts of a file, before OpenEXR sees the file. Films have some hundreds of channels. Its C++
 * library, which reads some files, allocates as much memory as the attributes claim, and ignores the stated size of some
 * types: both are checked here.
 *
 * The attribute `chromaticities` says which colours red, green, blue and white are; without it they are those of Rec. 709,
 * as everywhere here. Colours of others are converted: to CIE XYZ, and from there, without adaptation to another white.
 * With P the columns (x/y, 1, (1-x-y)/y) of the primaries, RGB = (1,1,1) is the white of luminance 1, so that XYZ = P
 * diag(s) RGB with P s = white (SMPTE RP 177).
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/codec.h"

static const koksma__module module = {
    "exr", "OpenEXR", {koksma__fail, koksma__fail_memory, &koksma__codec_functions}};

static bool recognises(const unsigned char *bytes, size_t size)
{
    static const unsigned char magic[4] = {0x76, 0x2f, 0x31, 0x01};
    return size >= 4 && !memcmp(bytes, magic, 4);
}

enum { MOST_ATTRIBUTES = 4096, MOST_CHANNELS = 4096 };

static uint32_t word_at(const unsigned char *b)
{
    return (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
}

/* The position after the text at `at` and its zero byte; `size` if it has no end. */
static size_t skip_text(const unsigned char *bytes, size_t size, size_t at)
{
    const unsigned char *end = at < size ? memchr(bytes + at, 0, size - at) : NULL;
    return end ? (size_t)(end - bytes) + 1 : size;
}

/* A channel is its name with a zero byte and 16 more bytes; an empty name ends the list. *whole: whether the list has
   exactly `size` bytes. */
static size_t count_channels(const unsigned char *value, size_t size, bool *whole)
{
    size_t n = 0, at = 0;
    for (; at < size && value[at]; n++) {
        at = skip_text(value, size, at) + 16;
    }
    *whole = at + 1 == size;
    return n;
}

/* Whether a value's stated size is that of its type, for the types in the table below. For these the C++ library
   ignores the stated size: if it differed from the type's, the library would find the next attribute at another
   position than readers that use the stated size. For all other types the C++ library uses the stated size. */
static bool value_fits(const char *type, size_t size)
{
    static const struct {
        const char *type;
        size_t size;
    } known[] = {{"box2i", 16},
                 {"box2f", 16},
                 {"chromaticities", 32},
                 {"compression", 1},
                 {"deepImageState", 1},
                 {"double", 8},
                 {"envmap", 1},
                 {"float", 4},
                 {"int", 4},
                 {"keycode", 28},
                 {"lineOrder", 1},
                 {"m33f", 36},
                 {"m33d", 72},
                 {"m44f", 64},
                 {"m44d", 128},
                 {"rational", 8},
                 {"tiledesc", 9},
                 {"timecode", 8},
                 {"v2i", 8},
                 {"v2f", 8},
                 {"v2d", 16},
                 {"v3i", 12},
                 {"v3f", 12},
                 {"v3d", 24}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (!strcmp(known[i].type, type)) {
            return size == known[i].size;
        }
    }
    return true;
}

/* What the header of the first part says: the place of its chromaticities, or NULL, and its compression. */
typedef struct header {
    const unsigned char *chromaticities;
    int compression;
} header;

static void note_attribute(const char *name, const unsigned char *value, size_t size, header *out)
{
    if (!strcmp(name, "chromaticities") && size == 32) {
        out->chromaticities = value;
    } else if (!strcmp(name, "compression") && size == 1) {
        out->compression = *value;
    }
}

/* An attribute is name, type, size and value; an empty name ends a header, and an empty header ends the headers of a
   file of several parts (https://openexr.com/en/latest/OpenEXRFileLayout.html). */
static koksma_status check_header(const unsigned char *bytes, size_t size, header *out)
{
    const bool parts = size > 8 && (bytes[5] & 0x10);
    size_t attributes = 0, channels = 0, at = 8;
    bool first = true, fits = true;
    while (fits && at < size && bytes[at] && attributes <= MOST_ATTRIBUTES && channels <= MOST_CHANNELS) {
        const size_t type = skip_text(bytes, size, at), length = skip_text(bytes, size, type);
        const size_t left = size - length < 4 ? 0 : size - length - 4;
        const size_t value = left ? word_at(bytes + length) : SIZE_MAX;
        const unsigned char *from = bytes + length + 4;
        fits = value <= left && value_fits((const char *)bytes + type, value);
        if (fits) {
            attributes++;
            channels += strcmp((const char *)bytes + type, "chlist") ? 0 : count_channels(from, value, &fits);
            if (first) {
                note_attribute((const char *)bytes + at, from, value, out);
            }
            at = length + 4 + value;
            first &= at < size && bytes[at];
            at += parts && at + 1 < size && !bytes[at]; /* the next header, or the empty one that ends the list */
        }
    }
    if (attributes > MOST_ATTRIBUTES || channels > MOST_CHANNELS) {
        return koksma__refused(koksma__fail(KOKSMA_MALFORMED, "as an EXR: more than %d attributes or %d channels",
                                            MOST_ATTRIBUTES, MOST_CHANNELS));
    }
    KOKSMA__FAIL_IF(!fits || at >= size, KOKSMA_MALFORMED,
                    "as an EXR: cut short, or an attribute of its header states a wrong size");
    return KOKSMA_OK;
}

/* ---- Colours ------------------------------------------------------------------------------------------- */

/* The determinant of the matrix whose columns are a, b and c. */
static double determinant(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
           c[0] * (a[1] * b[2] - a[2] * b[1]);
}

/* Solves a u + b v + c w = d by Cramer's rule; returns false if there is no solution. */
static bool solve(double columns[3][3], const double d[3], double out[3])
{
    const double whole = determinant(columns[0], columns[1], columns[2]);
    for (int k = 0; k < 3; k++) {
        out[k] = determinant(k == 0 ? d : columns[0], k == 1 ? d : columns[1], k == 2 ? d : columns[2]) / whole;
    }
    return isfinite(out[0]) && isfinite(out[1]) && isfinite(out[2]);
}

/* The XYZ of red, green and blue (columns) from the chromaticities x, y of red, green, blue and white. The primaries'
   columns are (x, y, 1 - x - y), which may have y = 0; their lengths follow from the white. */
static bool to_xyz(const double xy[8], double columns[3][3])
{
    double white[3], lengths[3];
    for (int k = 0; k < 4; k++) {
        double *to = k < 3 ? columns[k] : white;
        to[0] = xy[2 * k];
        to[1] = xy[2 * k + 1];
        to[2] = 1 - to[0] - to[1];
    }
    for (int k = 0; k < 3; k++) {
        white[k] /= xy[7];
    }
    if (!solve(columns, white, lengths)) {
        return false;
    }
    for (int k = 0; k < 9; k++) {
        columns[k / 3][k % 3] *= lengths[k / 3];
    }
    return true;
}

static double float_at(const unsigned char *b)
{
    const uint32_t word = word_at(b);
    float x;
    memcpy(&x, &word, sizeof x);
    return (double)x;
}

/* Converts the colours of an image with other primaries or white to those of Rec. 709; a grey image has none. */
static koksma_status convert(const unsigned char *chromaticities, koksma_image *image)
{
    static const double rec709[8] = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
    double xy[8], from[3][3], to[3][3], matrix[3][3];
    bool same = true, usable = true;
    for (int k = 0; k < 8; k++) {
        xy[k] = float_at(chromaticities + 4 * k);
        same &= fabs(xy[k] - rec709[k]) < 1e-4;
    }
    if (same || image->channels != 3) {
        return KOKSMA_OK;
    }
    usable = to_xyz(xy, from) && to_xyz(rec709, to);
    for (int k = 0; usable && k < 3; k++) {
        usable = solve(to, from[k], matrix[k]);
    }
    KOKSMA__FAIL_IF(!usable, KOKSMA_MALFORMED, "as an EXR: its chromaticities are those of no colour space");
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height; i++) {
        float *pixel = image->pixels + 3 * i;
        const double r = (double)pixel[0], g = (double)pixel[1], b = (double)pixel[2];
        for (int k = 0; k < 3; k++) {
            pixel[k] = (float)(matrix[0][k] * r + matrix[1][k] * g + matrix[2][k] * b);
        }
    }
    return KOKSMA_OK;
}

/* ---- Reading and writing -------------------------------------------------------------------------------- */

/* Names a compression that is newer than OpenEXR 3.3, of which the library here does not know the number. */
static koksma_status fail_compression(int compression)
{
    static const char *const names[] = {"HTJ2K256", "HTJ2K32"}; /* 10 and 11, of OpenEXR 3.4 */
    char name[40] = "of an unknown kind";
    if (compression < 12) {
        snprintf(name, sizeof name, "%s", names[compression - 10]);
    }
    return koksma__fail(
        KOKSMA_MALFORMED,
        "as an EXR: its compression, number %d, is %s, which the OpenEXR library of this build does not "
        "read; write it with ZIP",
        compression, name);
}

static koksma_status read(const unsigned char *bytes, size_t size, koksma__image_part part, koksma_image *out)
{
    header h = {.compression = 0};
    KOKSMA__TRY(check_header(bytes, size, &h));
    const koksma_status status = koksma__codec_read(&module, bytes, size, out);
    if (status == KOKSMA_MALFORMED && h.compression >= 10) {
        return fail_compression(h.compression);
    }
    return status || part == KOKSMA__IMAGE_NUMBERS || !h.chromaticities ? status : convert(h.chromaticities, out);
}

static koksma_status write(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out)
{
    size_t channels = 0;
    for (size_t i = 0; i < n; i++) {
        channels += (size_t)layers[i].image->channels;
    }
    KOKSMA__FAIL_IF(channels > MOST_CHANNELS, KOKSMA_ARGUMENT, "layers of %zu channels: an EXR has at most %d here",
                    channels, MOST_CHANNELS);
    return koksma__codec_write(&module, layers, n, metadata, out);
}

const koksma__image_format koksma__format_exr = {
    .name = "exr", .recognises = recognises, .read = read, .write = write, .has_layers = true, .module = &module};
