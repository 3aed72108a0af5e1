/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads and writes PNG files of 1 to 16 bits by libpng. Levels are read as sRGB, whose curve (image.h) is applied here in
 * double precision. A gAMA chunk with the value g replaces this curve by linear = s^(1/g), unless the file also has a
 * chunk sRGB or iCCP, which take precedence (PNG, 3rd edition, section 13.13). A g within 5 % of 1/2.2 is read as sRGB,
 * because writers of sRGB files often store such a g. Only colours as the file states them follow gAMA. Transparency does
 * not change the colours, so that albedos and comparisons use each pixel's colour; it is read alone. Files are written as
 * sRGB with 8 bits; koksma__png_levels writes levels of 8 or 16 bits as they are.
 */
#ifdef KOKSMA_PNG
#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"
#include "image/formats.h"

enum { MOST_CHUNK = 1 << 23 }; /* bytes, which libpng allocates before it reads a chunk other than that of pixels */

/* The input or output of libpng, and its error message. */
typedef struct stream {
    koksma__bytes *out;
    const unsigned char *in;
    size_t left; /* bytes there */
    bool no_memory;
    char message[128];
} stream;

static void on_error(png_structp png, png_const_charp message)
{
    stream *s = png_get_error_ptr(png);
    strncpy(s->message, message, sizeof s->message - 1);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

/* ---- Reading ------------------------------------------------------------------------------------------ */

static png_voidp allocate(png_structp png, png_alloc_size_t size)
{
    stream *s = png_get_mem_ptr(png);
    void *memory = malloc(size);
    s->no_memory |= !memory;
    return memory;
}

static void release(png_structp png, png_voidp memory)
{
    (void)png;
    free(memory);
}

static void get(png_structp png, png_bytep data, size_t size)
{
    stream *s = png_get_io_ptr(png);
    if (size > s->left) {
        png_error(png, "cut short");
    }
    memcpy(data, s->in, size);
    s->in += size;
    s->left -= size;
}

typedef struct head {
    png_uint_32 width, height;
    koksma__image_part what;
    int channels, level_bytes, passes;
    double power; /* exponent of the transfer function; 0: sRGB */
} head;

/* The exponent of the transfer function that the file states; 0: sRGB. */
static double power_of(png_const_structp png, png_const_infop info)
{
    png_fixed_point gamma = 0;
    const bool overridden = png_get_valid(png, info, PNG_INFO_sRGB | PNG_INFO_iCCP) != 0;
    if (overridden || !png_get_gAMA_fixed(png, info, &gamma) || gamma <= 0 || fabs(2.2e-5 * gamma - 1) < 0.05) {
        return 0;
    }
    return 1e5 / gamma;
}

/* Reads the header, and asks libpng for grey or red, green and blue of 8 or 16 bits. This function may be left by
   longjmp, and so owns nothing that needs releasing. */
static bool get_head(png_structp png, png_infop info, head *h)
{
    /* text chunks are skipped, as they may be huge once unpacked */
    static const png_byte wanted[] = "gAMA\0iCCP\0sRGB\0tRNS";
    if (setjmp(png_jmpbuf(png))) {
        return false;
    }
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, wanted, h->what == KOKSMA__IMAGE_ALPHA ? 4 : 3);
    png_read_info(png, info);
    h->width = png_get_image_width(png, info);
    h->height = png_get_image_height(png, info);
    h->power = h->what == KOKSMA__IMAGE_COLOURS ? power_of(png, info) : 0;
    png_set_palette_to_rgb(png);
    png_set_expand_gray_1_2_4_to_8(png);
    if (h->what == KOKSMA__IMAGE_ALPHA) {
        png_set_tRNS_to_alpha(png);
    } else {
        png_set_strip_alpha(png);
    }
    h->passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    h->channels = png_get_channels(png, info);
    h->level_bytes = png_get_bit_depth(png, info) / 8;
    return true;
}

static bool get_rows(png_structp png, const head *h, unsigned char *levels)
{
    const size_t row = (size_t)h->width * (size_t)(h->channels * h->level_bytes);
    if (setjmp(png_jmpbuf(png))) {
        return false;
    }
    for (int pass = 0; pass < h->passes; pass++) {
        for (size_t y = 0; y < h->height; y++) {
            png_read_row(png, levels + y * row, NULL);
        }
    }
    return true;
}

static koksma_status to_linear(const unsigned char *levels, const head *h, size_t count, float *out)
{
    const size_t n = (size_t)1 << 8 * h->level_bytes;
    float *table = malloc(n * sizeof *table);
    KOKSMA__REQUIRE_MEMORY(table, n * sizeof *table);
    for (size_t i = 0; i < n; i++) {
        const double s = (double)i / (double)(n - 1);
        table[i] = (float)(h->power > 0 ? koksma__pow(s, h->power) : koksma__from_srgb(s));
    }
    for (size_t i = 0; i < count; i++) {
        out[i] = table[h->level_bytes == 1 ? levels[i] : levels[2 * i] << 8 | levels[2 * i + 1]];
    }
    free(table);
    return KOKSMA_OK;
}

/* Copies the last channel, which is the transparency, without a transfer function. */
static void to_alpha(const unsigned char *levels, const head *h, size_t pixels, float *out)
{
    const size_t bytes = (size_t)h->level_bytes, step = (size_t)h->channels * bytes;
    for (size_t i = 0; i < pixels; i++) {
        const unsigned char *level = levels + (i + 1) * step - bytes;
        out[i] = bytes == 1 ? (float)level[0] / 255 : (float)(level[0] << 8 | level[1]) / 65535;
    }
}

static koksma_status fail(const stream *s)
{
    return koksma__fail(s->no_memory ? KOKSMA_MEMORY : KOKSMA_MALFORMED, "as a PNG: %s",
                        *s->message ? s->message : "out of memory");
}

static koksma_status read_image(png_structp png, png_infop info, const stream *s, koksma__image_part what,
                                koksma_image *out)
{
    const bool alpha = what == KOKSMA__IMAGE_ALPHA;
    head h = {.what = what};
    const size_t size = s->left;
    if (!get_head(png, info, &h)) {
        return fail(s);
    }
    if (alpha && h.channels % 2) {
        return KOKSMA_OK;
    }
    /* deflate compresses by a factor of at most 1032, and a pixel has at least 1 bit */
    KOKSMA__TRY(koksma__image_claim(h.width, h.height, alpha ? 1 : h.channels, size, 8 * 1032, out));
    const size_t count = (size_t)h.width * h.height * (size_t)h.channels;
    unsigned char *levels = calloc(count, (size_t)h.level_bytes);
    KOKSMA__REQUIRE_MEMORY(levels, count * (size_t)h.level_bytes);
    koksma_status status = get_rows(png, &h, levels) ? KOKSMA_OK : fail(s);
    if (!status && alpha) {
        to_alpha(levels, &h, count / (size_t)h.channels, out->pixels);
    } else if (!status) {
        status = to_linear(levels, &h, count, out->pixels);
    }
    free(levels);
    return status;
}

static koksma_status read(const unsigned char *bytes, size_t size, koksma__image_part what, koksma_image *out)
{
    stream s = {.in = bytes, .left = size};
    koksma_status status = KOKSMA_OK;
    png_structp png =
        png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &s, on_error, on_warning, &s, allocate, release);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (info) {
        png_set_read_fn(png, &s, get);
        png_set_chunk_malloc_max(png, MOST_CHUNK);
        status = read_image(png, info, &s, what, out);
    } else {
        s.no_memory = true;
        status = fail(&s);
    }
    png_destroy_read_struct(&png, &info, NULL);
    return status;
}

/* ---- Writing ------------------------------------------------------------------------------------------ */

static void put(png_structp png, png_bytep data, size_t size)
{
    stream *s = png_get_io_ptr(png);
    if (!koksma__bytes_put(s->out, s->out->size, data, size)) {
        png_error(png, "out of memory");
    }
}

static void flush(png_structp png)
{
    (void)png;
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

/* All calls that may longjmp; this function owns nothing that needs releasing. l: levels as they are, without a transfer
   function, or NULL for those of the image. */
static bool put_rows(png_structp png, png_infop info, const koksma_image *image, const char *metadata,
                     const koksma__levels *l, unsigned char *row)
{
    static const int types[] = {0, PNG_COLOR_TYPE_GRAY, 0, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
    const int width = l ? l->width : image->width, height = l ? l->height : image->height, bits = l ? l->bits : 8;
    const int channels = l ? l->channels : image->channels;
    const size_t count = (size_t)width * (size_t)channels, bytes = (size_t)bits / 8;
    koksma__srgb_table table;
    koksma__srgb_table_make(&table);
    if (setjmp(png_jmpbuf(png))) {
        return false;
    }
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, bits, types[channels], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    if (!l) {
        png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
        put_metadata(png, info, metadata);
    }
    png_write_info(png, info);
    for (size_t y = 0; y < (size_t)height; y++) {
        for (size_t i = 0; !l && i < count; i++) {
            row[i] = koksma__srgb_table_byte(&table, image->pixels[y * count + i]);
        }
        for (size_t i = 0; l && i < count; i++) {
            const unsigned level = l->levels[y * count + i];
            row[i * bytes] = (unsigned char)(level >> (bits - 8));
            row[i * bytes + bytes - 1] = (unsigned char)level;
        }
        png_write_row(png, row);
    }
    png_write_end(png, NULL);
    return true;
}

static koksma_status write_with(const koksma_image *image, const char *metadata, const koksma__levels *levels,
                                koksma__bytes *out)
{
    stream s = {.out = out};
    const size_t count = levels ? (size_t)levels->width * (size_t)(levels->channels * levels->bits / 8)
                                : (size_t)image->width * (size_t)image->channels;
    unsigned char *row = malloc(count);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &s, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    koksma_status status = KOKSMA_OK;
    if (!row || !info) {
        status = koksma__fail_memory(count);
    } else {
        png_set_write_fn(png, &s, put, flush);
        if (!put_rows(png, info, image, metadata, levels, row)) {
            status = koksma__fail(KOKSMA_MEMORY, "as a PNG: %s", s.message);
        }
    }
    png_destroy_write_struct(&png, &info);
    free(row);
    return status;
}

static koksma_status write(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out)
{
    (void)n; /* a file holds one layer */
    return write_with(layers->image, metadata, NULL, out);
}

koksma_status koksma__png_levels(const koksma__levels *levels, koksma__bytes *out)
{
    return write_with(NULL, NULL, levels, out);
}

const koksma__image_format koksma__format_png = {
    .name = "png",
    .magic = {"\x89PNG\r\n\x1a\n"},
    .read = read,
    .has_alpha = true,
    .write = write,
    .error = 0.5 / 255 * 2.4 / 1.055, /* an error of half a level of 255 at the value 1, where the sRGB curve is
                                         steepest */
};
#else

#include "core/status.h"
#include "image/formats.h"

const koksma__image_format koksma__format_png = {.name = "png", .magic = {"\x89PNG\r\n\x1a\n"}, .left_out = "libpng"};

koksma_status koksma__png_levels(const koksma__levels *levels, koksma__bytes *out)
{
    (void)levels;
    (void)out;
    return koksma__fail(KOKSMA_UNSUPPORTED, "this build cannot write .png files: it was made without libpng");
}

#endif
