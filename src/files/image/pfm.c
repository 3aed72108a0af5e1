/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads and writes PFM files: "Pf" or "PF", width, height, a scale whose sign gives the byte order (negative:
 * little-endian), one blank, then the pixels as floats, with the bottom row first. The scale's magnitude has no
 * agreed meaning (Mitsuba and OpenImageIO multiply by it, OpenCV and netpbm divide): it is ignored, with a remark. Some
 * writers end the header with blanks and CR LF. The first byte of the floats may
 * look like a blank, so their start is computed from the end of the file.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "image/formats.h"

static float get_float(const unsigned char *b, bool little)
{
    const uint32_t word = little ? (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0]
                                 : (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
    float x;
    memcpy(&x, &word, sizeof x);
    return x;
}

/* Whether the bytes end a header: one blank of any kind, or blanks and a line end. */
static bool is_end(const unsigned char *bytes, size_t size)
{
    if (size == 1 && bytes[0] && strchr(" \t\r\n\v\f", bytes[0])) {
        return true;
    }
    size_t i = 0;
    while (i < size && (bytes[i] == ' ' || bytes[i] == '\t')) {
        i++;
    }
    i += i < size && bytes[i] == '\r';
    return i + 1 == size && bytes[i] == '\n';
}

/* Reads a word of at most nine digits, such as the width. */
static bool take_side(const char *word, long long *out)
{
    const size_t length = strlen(word);
    *out = 0;
    if (length > 9 || strspn(word, "0123456789") != length) {
        return false;
    }
    for (size_t i = 0; i < length; i++) {
        *out = *out * 10 + (word[i] - '0');
    }
    return true;
}

static koksma_status read(const unsigned char *bytes, size_t size, koksma__image_part part, koksma_image *out)
{
    (void)part;
    /* a word that fills its place may be the start of a longer one */
    char header[96] = "", width_text[24] = "", height_text[24] = "", scale_text[24] = "", *end;
    long long width, height;
    int used = 0;
    memcpy(header, bytes + 2, size - 2 < sizeof header - 1 ? size - 2 : sizeof header - 1);
    KOKSMA__FAIL_IF(sscanf(header, "%23s %23s %23s%n", width_text, height_text, scale_text, &used) != 3 ||
                        !take_side(width_text, &width) || !take_side(height_text, &height),
                    KOKSMA_MALFORMED,
                    "line 1: a PFM header is PF or Pf, width, height and scale, with blanks between");
    const double scale = koksma__strtod(scale_text, &end);
    KOKSMA__FAIL_IF(*end || !isfinite(scale) || scale == 0, KOKSMA_MALFORMED,
                    "line 3: the scale '%s' is not a number other than 0", scale_text);
    if (fabs(scale) != 1) {
        koksma__image_remark("the scale %s of the PFM file is ignored: some programs multiply by it, others divide",
                             scale_text);
    }
    const int channels = bytes[1] == 'F' ? 3 : 1;
    const size_t head = 2 + (size_t)used, left = size > head + 1 ? size - head - 1 : 0;
    KOKSMA__TRY(koksma__image_claim(width, height, channels, left, 0.25 / channels, out));
    const size_t row = (size_t)width * (size_t)channels, start = size - 4 * row * (size_t)height;
    KOKSMA__FAIL_IF(!is_end(bytes + head, start - head), KOKSMA_MALFORMED,
                    "line 3: %zu bytes follow the scale, more than one blank and %lld x %lld pixels take",
                    size - head, width, height);
    for (size_t y = 0; y < (size_t)height; y++) {
        const unsigned char *from = bytes + start + 4 * row * ((size_t)height - 1 - y);
        for (size_t i = 0; i < row; i++) {
            out->pixels[y * row + i] = get_float(from + 4 * i, scale < 0);
        }
    }
    return KOKSMA_OK;
}

static koksma_status write(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out)
{
    const koksma_image *image = layers->image; /* a file holds one layer */
    (void)n;
    (void)metadata; /* the format cannot store metadata */
    char header[64];
    const int used = snprintf(header, sizeof header, "%s\n%d %d\n-1.0\n", image->channels == 3 ? "PF" : "Pf",
                              image->width, image->height);
    const size_t row = (size_t)image->width * (size_t)image->channels;
    bool ok = koksma__bytes_put(out, 0, header, (size_t)used);
    for (size_t y = (size_t)image->height; ok && y-- > 0;) {
        for (size_t i = 0; ok && i < row; i++) {
            uint32_t word;
            memcpy(&word, &image->pixels[y * row + i], sizeof word);
            const unsigned char b[4] = {(unsigned char)word, (unsigned char)(word >> 8), (unsigned char)(word >> 16),
                                        (unsigned char)(word >> 24)};
            ok = koksma__bytes_put(out, out->size, b, sizeof b);
        }
    }
    return ok ? KOKSMA_OK : koksma__fail_memory(4 * row * (size_t)image->height);
}

const koksma__image_format koksma__format_pfm = {.name = "pfm", .magic = {"PF", "Pf"}, .read = read, .write = write};
