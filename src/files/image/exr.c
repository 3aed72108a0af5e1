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
#include <stdlib.h>
#include <string.h>

#include "core/vector.h"
#include "image/formats.h"

static const koksma__module module = {
    "exr", "OpenEXR", {koksma__fail, koksma__fail_memory, &koksma__codec_functions}};

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

/* Whether a value's stated size is that of its type, for the types below, each before its size. For these the C++
   library ignores the stated size: if it differed, it would find the next attribute elsewhere than other readers do. */
static bool value_fits(const char *type, size_t size)
{
    static const char sizes[] = " box2i 16 box2f 16 chromaticities 32 compression 1 deepImageState 1 double 8 envmap "
                                "1 float 4 int 4 keycode 28 "
                                "lineOrder 1 m33f 36 m33d 72 m44f 64 m44d 128 rational 8 tiledesc 9 timecode 8 v2i 8 "
                                "v2f 8 v2d 16 v3i 12 v3f 12 "
                                "v3d 24 ";
    char stated[40];
    snprintf(stated, sizeof stated, " %.31s ", type);
    const char *known = strstr(sizes, stated);
    return !known || strtoul(known + strlen(stated), NULL, 10) == size;
}

/* What the header of the first part says: the place of its chromaticities, or NULL, and its compression. */
typedef struct header {
    const unsigned char *chromaticities;
    int compression;
} header;

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
            if (first && value == 32 && !strcmp((const char *)bytes + at, "chromaticities")) {
                out->chromaticities = from;
            } else if (first && value == 1 && !strcmp((const char *)bytes + at, "compression")) {
                out->compression = *from;
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

/* The matrix from linear RGB to XYZ by the chromaticities x, y of red, green, blue and white, and its inverse. The
   primaries' columns are (x, y, 1 - x - y), which may have y = 0; their lengths follow from the white. */
static bool to_xyz(const double xy[8], double matrix[9], double inverse[9])
{
    double columns[9], back[9];
    const double white[3] = {xy[6] / xy[7], 1, (1 - xy[6] - xy[7]) / xy[7]};
    for (int k = 0; k < 3; k++) {
        columns[k] = xy[2 * k];
        columns[3 + k] = xy[2 * k + 1];
        columns[6 + k] = 1 - xy[2 * k] - xy[2 * k + 1];
    }
    const bool usable = koksma__invert(columns, back);
    for (int k = 0; k < 9; k++) {
        matrix[k] = columns[k] * koksma__dot(back + 3 * (k % 3), white);
    }
    return usable && koksma__invert(matrix, inverse);
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
    double xy[8], from[9], to[9], unused[9];
    bool same = true;
    for (int k = 0; k < 8; k++) {
        xy[k] = float_at(chromaticities + 4 * k);
        same &= fabs(xy[k] - rec709[k]) < 1e-4;
    }
    if (same || image->channels != 3) {
        return KOKSMA_OK;
    }
    KOKSMA__FAIL_IF(!to_xyz(xy, from, unused) || !to_xyz(rec709, unused, to), KOKSMA_MALFORMED,
                    "as an EXR: its chromaticities are those of no colour space");
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height; i++) {
        float *pixel = image->pixels + 3 * i;
        const double rgb[3] = {(double)pixel[0], (double)pixel[1], (double)pixel[2]};
        const double xyz[3] = {koksma__dot(from, rgb), koksma__dot(from + 3, rgb), koksma__dot(from + 6, rgb)};
        for (int k = 0; k < 3; k++) {
            pixel[k] = (float)koksma__dot(to + 3 * k, xyz);
        }
    }
    return KOKSMA_OK;
}

/* ---- Reading and writing -------------------------------------------------------------------------------- */

static koksma_status read(const unsigned char *bytes, size_t size, koksma__image_part part, koksma_image *out)
{
    header h = {.compression = 0};
    KOKSMA__TRY(check_header(bytes, size, &h));
    const koksma_status status = koksma__codec_read(&module, bytes, size, out);
    KOKSMA__FAIL_IF(status == KOKSMA_MALFORMED && h.compression >= 10, KOKSMA_MALFORMED,
                    "as an EXR: its compression, number %d (10 is HTJ2K256, 11 HTJ2K32), is newer than the OpenEXR "
                    "library of this build; write it with ZIP",
                    h.compression);
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

const koksma__image_format koksma__format_exr = {.name = "exr",
                                                 .magic = {"\x76\x2f\x31\x01"},
                                                 .read = read,
                                                 .write = write,
                                                 .has_layers = true,
                                                 .module = &module};
