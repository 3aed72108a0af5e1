/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads and writes files of masks (koksma/maskfile.h). Images are read by their numbers, without a transfer function;
 * whether levels have 8 or 16 bits is seen from them: 8 bits are multiples of 257 of 65,535.
 */
#include <koksma/maskfile.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/files.h"
#include "core/point_files.h"
#include "core/status.h"
#include "image/formats.h"
#include "masks/masks.h"

/* ---- Reading --------------------------------------------------------------------------------------------- */

void koksma_mask_fini(koksma_mask *mask)
{
    if (mask) {
        free(mask->values);
        *mask = (koksma_mask){0};
    }
}

/* The numbers of a file, and of how many bits its levels are; 0: floats. */
typedef struct numbers {
    size_t width, height, channels;
    int bits;
    float *values;
} numbers;

static bool is_constant(const numbers *n, size_t channel, float value)
{
    for (size_t i = 0; i < n->width * n->height; i++) {
        if (n->values[i * n->channels + channel] != value) {
            return false;
        }
    }
    return true;
}

static bool is_grey(const numbers *n)
{
    for (size_t i = 0; i < n->width * n->height; i++) {
        const float *v = n->values + i * n->channels;
        if (v[0] != v[1] || v[0] != v[2]) {
            return false;
        }
    }
    return true;
}

/* Joins colours and transparency, and drops the channels that tell nothing. */
static koksma_status join(const koksma_image *colours, const koksma_image *alpha, numbers *n)
{
    const size_t pixels = (size_t)colours->width * (size_t)colours->height, old = (size_t)colours->channels;
    *n = (numbers){(size_t)colours->width, (size_t)colours->height, old + (alpha->pixels ? 1 : 0), 0, NULL};
    n->values = malloc(pixels * n->channels * sizeof *n->values);
    KOKSMA__REQUIRE_MEMORY(n->values, pixels * n->channels * sizeof *n->values);
    for (size_t i = 0; i < pixels; i++) {
        memcpy(n->values + i * n->channels, colours->pixels + i * old, old * sizeof *n->values);
        if (alpha->pixels) {
            n->values[i * n->channels + old] = alpha->pixels[i];
        }
    }
    size_t kept = alpha->pixels && is_constant(n, old, 1) ? old : n->channels;
    kept = kept == 3 && is_constant(n, 2, 0) ? 2 : kept;
    kept = old == 3 && kept <= 3 && is_grey(n) ? 1 : kept;
    for (size_t i = 0; i < pixels; i++) {
        memmove(n->values + i * kept, n->values + i * n->channels, kept * sizeof *n->values);
    }
    n->channels = kept;
    return KOKSMA_OK;
}

/* Sets the numbers to the middles of their levels. */
static void centre_levels(numbers *n)
{
    const size_t count = n->width * n->height * n->channels;
    n->bits = 8;
    for (size_t i = 0; i < count; i++) {
        const double level = nearbyint((double)n->values[i] * 65535);
        n->bits = fmod(level, 257) != 0 ? 16 : n->bits;
    }
    const double most = n->bits == 8 ? 255 : 65535;
    for (size_t i = 0; i < count; i++) {
        n->values[i] = (float)((nearbyint((double)n->values[i] * most) + 0.5) / (most + 1));
    }
}

static koksma_status read_image(const char *path, numbers *n)
{
    unsigned char *bytes;
    size_t size;
    koksma_image colours = {0}, alpha = {0};
    KOKSMA__TRY(
        koksma__read_file(path, KOKSMA__FILE_IMAGE, KOKSMA__BY_USER, koksma__image_check_start, &bytes, &size));
    koksma_status status = koksma__image_read_part(bytes, size, KOKSMA__IMAGE_NUMBERS, &colours);
    status = status ? status : koksma__image_read_part(bytes, size, KOKSMA__IMAGE_ALPHA, &alpha);
    status = status ? status : join(&colours, &alpha, n);
    for (size_t i = 0; !status && koksma__image_format_at(i); i++) {
        const koksma__image_format *format = koksma__image_format_at(i);
        if (koksma__image_recognises(format, bytes, size) && format->error > 0) {
            centre_levels(n);
        }
    }
    free(bytes);
    koksma_image_fini(&colours);
    koksma_image_fini(&alpha);
    return status ? koksma__fail_in(status, path) : KOKSMA_OK;
}

static koksma_status read_npy(const char *path, numbers *n)
{
    size_t shape[3];
    KOKSMA__TRY(koksma__npy_read_mask(path, KOKSMA__BY_USER, KOKSMA_MASK_MAX, shape, &n->values));
    n->height = shape[0];
    n->width = shape[1];
    n->channels = shape[2];
    return KOKSMA_OK;
}

/* Fails for a number outside the space; without a known space the text has all of this number of channels. */
static koksma_status fail_outside(const char *path, const numbers *n, size_t i, const koksma_mask_space *space,
                                  bool known)
{
    char others[512] = "";
    for (size_t k = 0, at = 0; koksma_mask_space_at(k) && !known && at < sizeof others; k++) {
        const koksma_mask_space *other = koksma_mask_space_at(k);
        if (other != space && other->dim == space->dim) {
            at += (size_t)koksma__snprintf(others + at, sizeof others - at, "%s%s %g to %g", at ? ", of " : "; of ",
                                           other->name, other->low, other->high);
        }
    }
    return koksma__fail(KOKSMA_MALFORMED, "%s: pixel (%zu, %zu) has the number %.9g; those of %s are %g to %g%s",
                        path, i / n->channels % n->width, i / n->channels / n->width, (double)n->values[i],
                        space->name, space->low, space->high, others);
}

/* Fails unless the numbers are a mask of the space; maps levels to its range. */
static koksma_status to_mask(const char *path, numbers *n, const koksma_mask_space *space, koksma_mask *out)
{
    static const char *const by_channels[] = {"scalar", "vector2", "vector3", "vector4"};
    const bool known = space != NULL;
    space = space ? space : koksma_mask_space_find(by_channels[n->channels - 1]);
    KOKSMA__FAIL_IF(n->channels != (size_t)space->dim, KOKSMA_MALFORMED,
                    "%s: %zu numbers a pixel, and the space %s has %d", path, n->channels, space->name, space->dim);
    KOKSMA__FAIL_IF(n->width < KOKSMA_MASK_MIN || n->height < KOKSMA_MASK_MIN || n->width > KOKSMA_MASK_MAX ||
                        n->height > KOKSMA_MASK_MAX,
                    KOKSMA_MALFORMED, "%s: %zu x %zu pixels; masks have %d to %d a side", path, n->width, n->height,
                    KOKSMA_MASK_MIN, KOKSMA_MASK_MAX);
    for (size_t i = 0; i < n->width * n->height * n->channels; i++) {
        if (n->bits) {
            n->values[i] = (float)(space->low + (double)n->values[i] * (space->high - space->low));
        }
        const double x = (double)n->values[i];
        KOKSMA__TRY(x >= space->low && x <= space->high ? KOKSMA_OK : fail_outside(path, n, i, space, known));
    }
    *out = (koksma_mask){(int)n->width, (int)n->height, space, n->values};
    return KOKSMA_OK;
}

koksma_status koksma_mask_read(const char *path, const koksma_mask_space *space, koksma_mask *out)
{
    KOKSMA__REQUIRE(path, out);
    numbers n = {0};
    *out = (koksma_mask){0};
    const koksma_mask_space *checked = space;
    KOKSMA__TRY(koksma__mask_check(KOKSMA_MASK_MIN, KOKSMA_MASK_MIN, &checked, NULL));
    KOKSMA__TRY(space ? KOKSMA_OK : koksma_mask_recipe_space(path, &space));
    koksma_status status = koksma__path_ends_in(path, ".npy") ? read_npy(path, &n) : read_image(path, &n);
    status = status ? status : to_mask(path, &n, space, out);
    if (status) {
        free(n.values);
    }
    return status;
}

/* ---- Writing --------------------------------------------------------------------------------------------- */

typedef struct format {
    const char *ending;
    int bits[4]; /* accepted, 0 at the end; the first is the default */
    int most;    /* numbers a pixel */
    koksma_status (*put)(const char *path, const koksma_mask *mask, int bits);
} format;

static size_t count_of(const koksma_mask *m)
{
    return (size_t)m->width * (size_t)m->height * (size_t)m->space->dim;
}

static unsigned level_of(const koksma_mask *m, size_t i, int bits)
{
    const double share = ((double)m->values[i] - m->space->low) / (m->space->high - m->space->low);
    const double most = ldexp(1, bits) - 1;
    return (unsigned)fmin(fmax(floor(ldexp(share, bits)), 0), most);
}

static koksma_status put_png(const char *path, const koksma_mask *m, int bits)
{
    const size_t dim = (size_t)m->space->dim, channels = dim == 2 ? 3 : dim, pixels = count_of(m) / dim;
    uint16_t *levels = calloc(pixels * channels, sizeof *levels);
    koksma__bytes bytes = {0};
    KOKSMA__REQUIRE_MEMORY(levels, pixels * channels * sizeof *levels);
    for (size_t i = 0; i < pixels * dim; i++) {
        levels[i / dim * channels + i % dim] = (uint16_t)level_of(m, i, bits);
    }
    const koksma__levels image = {m->width, m->height, (int)channels, bits, levels};
    koksma_status status = koksma__png_levels(&image, &bytes);
    status = status ? status : koksma__atomic_put(NULL, path, bytes.data, bytes.size);
    free(bytes.data);
    free(levels);
    return status;
}

static koksma_status put_exr(const char *path, const koksma_mask *m, int bits)
{
    koksma_image image;
    const size_t dim = (size_t)m->space->dim, channels = dim == 2 ? 3 : dim;
    (void)bits;
    KOKSMA__TRY(koksma_image_init(&image, m->width, m->height, (int)channels));
    for (size_t i = 0; i < count_of(m); i++) {
        image.pixels[i / dim * channels + i % dim] = m->values[i];
    }
    const koksma_status status = koksma_image_write(path, &image, NULL);
    koksma_image_fini(&image);
    return status;
}

/* Writes the numbers as little-endian bytes: levels, or the bits of floats. */
static void put_numbers(FILE *stream, const koksma_mask *m, int bits)
{
    for (size_t i = 0; i < count_of(m) && !ferror(stream); i++) {
        uint32_t word;
        memcpy(&word, &m->values[i], sizeof word);
        word = bits == 32 ? word : level_of(m, i, bits);
        for (int shift = 0; shift < bits; shift += 8) {
            putc((int)(word >> shift & 255), stream);
        }
    }
}

static void put_header(FILE *stream, const koksma_mask *m)
{
    char shape[64];
    snprintf(shape, sizeof shape, m->space->dim == 1 ? "(%d, %d)" : "(%d, %d, %d)", m->height, m->width,
             m->space->dim);
    koksma__npy_put_header(stream, "'<f4'", shape);
}

static void put_table(FILE *stream, const koksma_mask *m, int bits)
{
    static const char *const types[] = {"unsigned char", "unsigned short", "", "float"};
    fprintf(stream,
            "/* A mask of the space %s by koksma %s: number k of pixel (x, y) is mask[(y * MASK_WIDTH + x) * "
            "MASK_NUMBERS + k]. "
            "*/\nenum { MASK_WIDTH = %d, MASK_HEIGHT = %d, MASK_NUMBERS = %d };\nstatic const %s mask[%zu] = {",
            m->space->name, koksma_version(), m->width, m->height, m->space->dim, types[bits / 8 - 1], count_of(m));
    for (size_t i = 0; i < count_of(m); i++) {
        char number[40];
        if (bits == 32) {
            koksma__snprintf(number, sizeof number, "%#.9gf", (double)m->values[i]);
        } else {
            snprintf(number, sizeof number, "%u", level_of(m, i, bits));
        }
        fprintf(stream, "%s%s", i % 8 ? ", " : i ? ",\n    " : "\n    ", number);
    }
    fprintf(stream, "\n};\n");
}

static koksma_status put_stream(const char *path, const koksma_mask *m, int bits)
{
    koksma__atomic_file file;
    KOKSMA__TRY(koksma__atomic_open(NULL, path, &file));
    if (koksma__path_ends_in(path, ".h")) {
        put_table(file.stream, m, bits);
    } else {
        if (koksma__path_ends_in(path, ".npy")) {
            put_header(file.stream, m);
        }
        put_numbers(file.stream, m, bits);
    }
    return koksma__atomic_close(&file, true);
}

static const format formats[] = {
    {".png", {16, 8}, 4, put_png},        {".exr", {32}, 3, put_exr},         {".npy", {32}, 4, put_stream},
    {".raw", {8, 16, 32}, 4, put_stream}, {".h", {32, 8, 16}, 4, put_stream},
};

/* Finds the format of a path, and replaces *bits = 0 by its default. */
static koksma_status find_format(const char *path, const koksma_mask_space *space, int *bits, const format **out)
{
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        const format *f = &formats[i];
        if (!koksma__path_ends_in(path, f->ending)) {
            continue;
        }
        KOKSMA__FAIL_IF(space->dim > f->most, KOKSMA_ARGUMENT,
                        "%s: %s files have up to %d numbers a pixel, not the %d of %s; .npy or .png would do", path,
                        f->ending, f->most, space->dim, space->name);
        *bits = *bits ? *bits : f->bits[0];
        for (int k = 0; k < 4 && f->bits[k]; k++) {
            if (f->bits[k] == *bits) {
                *out = f;
                return KOKSMA_OK;
            }
        }
        return koksma__fail(KOKSMA_ARGUMENT, "%s: %s files have no numbers of %d bits", path, f->ending, *bits);
    }
    return koksma__fail(KOKSMA_ARGUMENT, "%s: a mask is written to a file that ends in .png, .exr, .npy, .raw or .h",
                        path);
}

koksma_status koksma_mask_check_path(const char *path, const koksma_mask_space *space, int bits)
{
    KOKSMA__REQUIRE(path, space);
    const format *f;
    KOKSMA__TRY(koksma__mask_check(KOKSMA_MASK_MIN, KOKSMA_MASK_MIN, &space, NULL));
    KOKSMA__TRY(find_format(path, space, &bits, &f));
    return koksma__path_ends_in(path, ".png") || koksma__path_ends_in(path, ".exr") ? koksma_image_check_path(path)
                                                                                    : KOKSMA_OK;
}

koksma_status koksma_mask_write(const char *path, const koksma_mask *mask, int bits)
{
    KOKSMA__REQUIRE(path, mask);
    KOKSMA__REQUIRE(mask->space, mask->values);
    const format *f;
    const koksma_mask_space *space = mask->space;
    KOKSMA__TRY(koksma__mask_check(mask->width, mask->height, &space, mask->values));
    KOKSMA__TRY(find_format(path, mask->space, &bits, &f));
    return f->put(path, mask, bits);
}
