/* SPDX-License-Identifier: Apache-2.0 */
/* Images of kinds that the program reads and never writes: EXR in tiles, PNG of 16 bits. */
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>

#include "image/formats.h"
#include "made_file.h"
#include "test.h"

/* ---- EXR: numbers are little-endian -------------------------------------------------------------------------- */

static void put_float(file *f, float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    put_number(f, bits, 4);
}

static void put_attribute(file *f, const char *name, const char *type, uint32_t size)
{
    put(f, name, strlen(name) + 1);
    put(f, type, strlen(type) + 1);
    put_number(f, size, 4);
}

static void put_box(file *f, const char *name, uint32_t width, uint32_t height)
{
    put_attribute(f, name, "box2i", 16);
    put_number(f, 0, 8);
    put_number(f, width - 1, 4);
    put_number(f, height - 1, 4);
}

/* 5 x 3 pixels in tiles of 2 x 2: those at the right and at the bottom are smaller. */
enum { WIDTH = 5, HEIGHT = 3, TILE = 2, ACROSS = 3, DOWN = 2 };

static float value(int x, int y, int k)
{
    return (float)(100 * k + 10 * y + x);
}

/* The attributes that follow an EXR file's channels. */
static void put_tail(file *f)
{
    put_attribute(f, "compression", "compression", 1);
    put_number(f, 0, 1);
    put_box(f, "dataWindow", WIDTH, HEIGHT);
    put_box(f, "displayWindow", WIDTH, HEIGHT);
    put_attribute(f, "lineOrder", "lineOrder", 1);
    put_number(f, 0, 1);
    put_attribute(f, "pixelAspectRatio", "float", 4);
    put_float(f, 1);
    put_attribute(f, "screenWindowCenter", "v2f", 8);
    put_number(f, 0, 8);
    put_attribute(f, "screenWindowWidth", "float", 4);
    put_float(f, 1);
}

/* https://openexr.com/en/latest/OpenEXRFileLayout.html: tiled, one level, not compressed, B, G and R as floats. */
static void put_tiled_header(file *f)
{
    put(f, "\x76\x2f\x31\x01\x02\x02\x00\x00", 8);
    put_attribute(f, "channels", "chlist", 3 * 18 + 1);
    for (int k = 0; k < 3; k++) {
        put(f, &"B\0G\0R"[2 * k], 2);
        put_number(f, 2, 4); /* float */
        put_number(f, 0, 4);
        put_number(f, 1, 4); /* sampling */
        put_number(f, 1, 4);
    }
    put_number(f, 0, 1);
    put_tail(f);
    put_attribute(f, "tiles", "tiledesc", 9);
    put_number(f, TILE, 4);
    put_number(f, TILE, 4);
    put_number(f, 0, 1);
    put_number(f, 0, 1);
}

static file tiled_exr(void)
{
    file f = {.size = 0};
    put_tiled_header(&f);
    uint64_t at = f.size + 8 * ACROSS * DOWN;
    for (int tile = 0; tile < ACROSS * DOWN; tile++) {
        const int x = tile % ACROSS * TILE, y = tile / ACROSS * TILE;
        const int width = x + TILE <= WIDTH ? TILE : WIDTH - x, height = y + TILE <= HEIGHT ? TILE : HEIGHT - y;
        put_number(&f, at, 8);
        at += 20 + 12 * (uint64_t)(width * height);
    }
    for (int tile = 0; tile < ACROSS * DOWN; tile++) {
        const int x = tile % ACROSS * TILE, y = tile / ACROSS * TILE;
        const int width = x + TILE <= WIDTH ? TILE : WIDTH - x, height = y + TILE <= HEIGHT ? TILE : HEIGHT - y;
        put_number(&f, (uint64_t)(tile % ACROSS), 4);
        put_number(&f, (uint64_t)(tile / ACROSS), 4);
        put_number(&f, 0, 8); /* level */
        put_number(&f, 12 * (uint64_t)(width * height), 4);
        for (int i = 0; i < height * 3 * width; i++) { /* a row: its B, its G, its R */
            put_float(&f, value(x + i % width, y + i / width / 3, 2 - i / width % 3));
        }
    }
    return f;
}

TEST_CASE(tiles_are_read)
{
    const file f = tiled_exr();
    koksma_image image;
    assert_ok(read_bytes("tiled.exr", &f, f.size, &image));
    assert_int_equal(image.width, WIDTH);
    assert_int_equal(image.height, HEIGHT);
    assert_int_equal(image.channels, 3);
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) {
        assert_float_equal(image.pixels[i], value(i / 3 % WIDTH, i / 3 / WIDTH, i % 3), 0);
    }
    koksma_image_fini(&image);
    for (size_t size = 0; size < f.size; size++) {
        assert_int_equal(read_bytes("tiled.exr", &f, size, &image), KOKSMA_MALFORMED);
    }
}

/* The value that pixel i has in channel c, times 1024: a half keeps it. */
static uint32_t channel_value(int c, int i)
{
    return 1024 + 64 * (uint32_t)c + (uint32_t)i;
}

/* As tiled_exr() in lines, with channels named by one letter each and with types of 0 (unsigned), 1 (half) or 2
   (float). */
static file lines_exr(const char *names, const char *types)
{
    file f = {.size = 0};
    const size_t n = strlen(names);
    put(&f, "\x76\x2f\x31\x01\x02\x00\x00\x00", 8);
    put_attribute(&f, "channels", "chlist", (uint32_t)n * 18 + 1);
    size_t pixel = 0;
    for (size_t c = 0; c < n; c++) {
        put_number(&f, (uint64_t)names[c], 2);
        put_number(&f, (uint64_t)(types[c] - '0'), 4);
        put_number(&f, 0, 4);
        put_number(&f, 1, 4); /* sampling */
        put_number(&f, 1, 4);
        pixel += types[c] == '1' ? 2 : 4;
    }
    put_number(&f, 0, 1);
    put_tail(&f);
    put_number(&f, 0, 1);
    for (size_t y = 0; y < HEIGHT; y++) {
        put_number(&f, f.size + 8 * (HEIGHT - y) + y * (8 + pixel * WIDTH), 8);
    }
    for (int y = 0; y < HEIGHT; y++) {
        put_number(&f, (uint64_t)y, 4);
        put_number(&f, pixel * WIDTH, 4);
        for (int i = 0; i < (int)n * WIDTH; i++) { /* all of a channel, then the next */
            const int c = i / WIDTH;
            const uint32_t v = channel_value(c, i % WIDTH + WIDTH * y);
            if (types[c] == '2') {
                put_float(&f, (float)v / 1024);
            } else {
                put_number(&f, types[c] == '1' ? 0x3c00 + (v - 1024) : v, types[c] == '1' ? 2 : 4);
            }
        }
    }
    return f;
}

/* A channel is read by its own among any number of others, of any types: those at any place before and behind it. */
TEST_CASE(one_channel_of_several_is_read)
{
    static const struct {
        const char *names, *types;
    } files[] = {{"Y", "1"},       {"XY", "11"},      {"YZ", "11"},     {"XYZ", "111"},   {"WXY", "111"},
                 {"YZa", "111"},   {"XYZ", "211"},    {"XYZ", "012"},   {"XYZ", "222"},   {"XYZ", "121"},
                 {"XYZ", "020"},   {"WXYZ", "1111"},  {"YZab", "1111"}, {"VWXY", "1111"}, {"WXYZ", "2110"},
                 {"WXYZ", "2222"}, {"WXYZa", "11111"}};
    koksma_image image;
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        const file f = lines_exr(files[k].names, files[k].types);
        assert_ok(read_bytes("lines.exr", &f, f.size, &image));
        assert_int_equal(image.channels, 1);
        const int c = (int)(strchr(files[k].names, 'Y') - files[k].names);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            assert_float_equal(image.pixels[i], (float)channel_value(c, i) / 1024, 0);
        }
        koksma_image_fini(&image);
    }
}

/* images/: files of OpenEXR's C++ library, of 9 x 7 pixels whose window starts at (-5, 7), with the values of
   window_value(). B44 and DWA keep halves to a few hundredths of them. */
static double window_value(int k, int i)
{
    return (k + 1) * 0.125 + i % 9 * 0.0078125 + i / 9 * 0.25;
}

static koksma_status read_window(const char *name, koksma_image *image)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/image/images/%s", KOKSMA_TESTS, name);
    return koksma_image_read(path, image);
}

TEST_CASE(lossy_exr_is_read)
{
    static const struct {
        const char *name;
        int channels;
    } files[] = {
        {"b44-half-tiles.exr", 3}, {"b44a-float-lines.exr", 3}, {"b44-y-lines.exr", 1}, {"dwaa-y-lines.exr", 1}};
    koksma_image image;
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        assert_ok(read_window(files[f].name, &image));
        assert_int_equal(image.width, 9);
        assert_int_equal(image.height, 7);
        assert_int_equal(image.channels, files[f].channels);
        for (int i = 0; i < 9 * 7 * image.channels; i++) {
            const double wanted = window_value(i % image.channels, i / image.channels);
            assert_near((double)image.pixels[i], wanted, 0.03);
        }
        koksma_image_fini(&image);
    }
    /* its only channel is Z, which OpenEXR's reader of colours doesn't know */
    assert_int_equal(read_window("dwaa-z-lines.exr", &image), KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "R, G, B"));
    /* its list of channels ends before its size does, with a text of 1.6 GB behind, which OpenEXR would make room for
     */
    assert_int_equal(read_window("../../../fuzz/corpus/image_exr/channel-list-ends-early.exr", &image),
                     KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "a wrong size"));
}

/* images/: PIZ files of OpenEXR's C++ library with the channels X, Y and Z of halves, of which Y is read. */
TEST_CASE(y_of_xyz_is_read)
{
    static const char *const names[] = {"piz-xyz-lines.exr", "piz-xyz-tiles.exr"};
    koksma_image image;
    for (size_t f = 0; f < sizeof names / sizeof *names; f++) {
        assert_ok(read_window(names[f], &image));
        assert_int_equal(image.width, 33);
        assert_int_equal(image.height, 37);
        assert_int_equal(image.channels, 1);
        for (int i = 0; i < 33 * 37; i++) {
            assert_float_equal(image.pixels[i], 1 + (float)(16 + i % 33 % 4 + 2 * (i / 33 % 5)) / 1024, 0);
        }
        koksma_image_fini(&image);
    }
}

/* ---- PNG -------------------------------------------------------------------------------------------------- */

static uint32_t crc(const unsigned char *bytes, size_t size)
{
    uint32_t c = 0xffffffff;
    for (size_t i = 0; i < size; i++) {
        c ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) {
            c = c & 1 ? 0xedb88320 ^ c >> 1 : c >> 1;
        }
    }
    return ~c;
}

static void put_big(file *f, uint32_t x)
{
    put(f,
        &(unsigned char[]){(unsigned char)(x >> 24), (unsigned char)(x >> 16), (unsigned char)(x >> 8),
                           (unsigned char)x},
        4);
}

static void put_chunk(file *f, const char *name, const void *data, size_t size)
{
    put_big(f, (uint32_t)size);
    const size_t start = f->size;
    put(f, name, 4);
    put(f, data, size);
    put_big(f, crc(f->bytes + start, f->size - start));
}

/* One row of pixels, in a stored block of deflate: PNG, 3rd edition; RFC 1950 and 1951. */
static void put_png(file *f, unsigned width, int depth, int colours, const char *extra, const void *extra_data,
                    size_t extra_size, const unsigned char *row, size_t row_size)
{
    const unsigned char head[13] = {0, 0, 0, (unsigned char)width, 0,
                                    0, 0, 1, (unsigned char)depth, (unsigned char)colours};
    file data = {.size = 0};
    uint32_t a = 1, b = 1; /* of the filter's byte, 0 */
    const uint16_t size = (uint16_t)(row_size + 1);
    put(&data, "\x78\x01\x01", 3);
    put_number(&data, size, 2);
    put_number(&data, (uint16_t)~size, 2);
    put_number(&data, 0, 1);
    put(&data, row, row_size);
    for (size_t i = 0; i < row_size; i++) {
        a = (a + row[i]) % 65521;
        b = (b + a) % 65521;
    }
    put_big(&data, b << 16 | a);
    put(f, "\x89PNG\r\n\x1a\n", 8);
    put_chunk(f, "IHDR", head, sizeof head);
    if (extra) {
        put_chunk(f, extra, extra_data, extra_size);
    }
    put_chunk(f, "IDAT", data.bytes, data.size);
    put_chunk(f, "IEND", "", 0);
}

/* The first number of a picture of such a row. */
static double level_of(int depth, int colours, const char *extra, const void *extra_data, size_t extra_size,
                       const unsigned char *row, size_t row_size)
{
    file f = {.size = 0};
    koksma_image image;
    put_png(&f, 1, depth, colours, extra, extra_data, extra_size, row, row_size);
    assert_ok(read_bytes("level.png", &f, f.size, &image));
    assert_int_equal(image.channels, colours & 2 ? 3 : 1);
    const double level = (double)image.pixels[0];
    koksma_image_fini(&image);
    return level;
}

/* 8 and 16 bits have one curve: sRGB's, unless a gAMA chunk says another. */
TEST_CASE(png_levels_have_their_curve)
{
    static const unsigned char eight[] = {188}, sixteen[] = {188, 188}, colour[] = {188, 188, 1, 2, 3, 4};
    const double s = 188 / 255.0, srgb = pow((s + 0.055) / 1.055, 2.4);
#define GAMA(b1, b2, b3) "gAMA", (const unsigned char[]){0, b1, b2, b3}, 4
#define BARE NULL, NULL, 0
    assert_near(level_of(8, 0, BARE, eight, 1), srgb, 1e-7);
    assert_near(level_of(16, 0, BARE, sixteen, 2), srgb, 1e-7);
    assert_near(level_of(16, 2, BARE, colour, 6), srgb, 1e-7);
    assert_near(level_of(16, 0, "sRGB", "", 1, sixteen, 2), srgb, 1e-7);
    for (int wide = 0; wide < 2; wide++) {
        const unsigned char *row = wide ? sixteen : eight;
        const size_t size = wide ? 2 : 1;
        const int depth = wide ? 16 : 8;
        assert_near(level_of(depth, 0, GAMA(0, 0xb1, 0x8f), row, size), srgb, 1e-7);        /* 1/2.2 */
        assert_near(level_of(depth, 0, GAMA(1, 0x86, 0xa0), row, size), s, 1e-7);           /* 1 */
        assert_near(level_of(depth, 0, GAMA(0, 0xd9, 0x03), row, size), pow(s, 1.8), 1e-5); /* 1/1.8 */
    }
    /* the darkest levels are on the curve's straight part */
    assert_near(level_of(16, 0, BARE, (const unsigned char[]){1, 0}, 2), 256 / 65535.0 / 12.92, 1e-9);
}

/* Textures of glTF are sRGB or numbers, whatever transfer function their files state (glTF 2.0: "any colorspace information
   ... from PNG or JPEG images must be ignored"). */
TEST_CASE(png_gamma_is_ignored_on_demand)
{
    const double s = 188 / 255.0, srgb = pow((s + 0.055) / 1.055, 2.4);
    const struct {
        koksma__image_part part;
        double wanted;
    } cases[] = {{KOKSMA__IMAGE_COLOURS, pow(s, 1.8)}, {KOKSMA__IMAGE_SRGB, srgb}, {KOKSMA__IMAGE_NUMBERS, s}};
    file f = {.size = 0};
    put_png(&f, 1, 8, 0, GAMA(0, 0xd9, 0x03), (const unsigned char[]){188}, 1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_image image;
        assert_ok(koksma__image_read_part(f.bytes, f.size, cases[i].part, &image));
        assert_near((double)image.pixels[0], cases[i].wanted, 1e-5);
        koksma_image_fini(&image);
    }
}

/* A pixel's colour is read, whatever its opacity: of pixels with alpha, and where a colour is named as see-through.
 */
TEST_CASE(png_transparency_is_dropped)
{
    const double srgb = pow((188 / 255.0 + 0.055) / 1.055, 2.4);
    assert_near(level_of(8, 4, BARE, (const unsigned char[]){188, 128}, 2), srgb, 1e-7);
    assert_near(level_of(8, 6, BARE, (const unsigned char[]){188, 188, 188, 0}, 4), srgb, 1e-7);
    assert_near(level_of(16, 4, BARE, (const unsigned char[]){188, 188, 128, 0}, 4), srgb, 1e-7);
    assert_near(level_of(8, 0, "tRNS", (const unsigned char[]){0, 188}, 2, (const unsigned char[]){188}, 1), srgb,
                1e-7);
    assert_near(level_of(8, 3, "PLTE", (const unsigned char[]){188, 188, 188}, 3, (const unsigned char[]){0}, 1),
                srgb, 1e-7);
    assert_near(level_of(1, 0, BARE, (const unsigned char[]){0x80}, 1), 1, 0);
}

/* ---- PFM -------------------------------------------------------------------------------------------------- */

/* The head, then 0.5 and 2.25 (whose last byte first is a blank's), then the rest. */
static koksma_status read_pfm(const char *head, const char *tail)
{
    file f = {.size = 0};
    koksma_image image;
    put(&f, head, strlen(head));
    put_float(&f, 0.5f);
    put_float(&f, 2.25f);
    put(&f, tail, strlen(tail));
    const koksma_status status = read_bytes("head.pfm", &f, f.size, &image);
    if (!status) {
        assert_near((double)image.pixels[0], 0.5, 0);
        assert_near((double)image.pixels[1], 2.25, 0);
        koksma_image_fini(&image);
    }
    return status;
}

TEST_CASE(pfm_heads_end_as_writers_end_them)
{
    static const char *const good[] = {"Pf\n2 1\n-1.0\n", "Pf\r\n2 1\r\n-1.0\r\n",
                                       "Pf\n2 1 -1.0 \n", "Pf\n2 1 -1.0 \t\r\n",
                                       "Pf 2 1 -1 ",      "Pf\n2 1\n-1.0\r"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        assert_ok(read_pfm(good[i], ""));
        assert_int_equal(read_pfm(good[i], "junk"), KOKSMA_MALFORMED);
    }
    /* a number ends where its digits do */
    static const char *const joined[] = {
        "Pf\n0000000021\n-1\n", "Pf\n2 1-1\n",     "Pf\n2-1\n1\n",   "Pf\n2 1 -1-1\n",
        "Pf\n2.0 1\n-1\n",      "Pf\n0x2 1\n-1\n", "Pf\n+2 1\n-1\n", "Pf\n00000000000000000000000 2 1\n-1\n"};
    for (size_t i = 0; i < sizeof joined / sizeof *joined; i++) {
        assert_int_equal(read_pfm(joined[i], ""), KOKSMA_MALFORMED);
    }
    assert_int_equal(read_pfm("Pf\n2 1\n-1.0\n\n", ""), KOKSMA_MALFORMED);
    assert_int_equal(read_pfm("Pf\n2 1\n-1.0  ", ""), KOKSMA_MALFORMED);
    assert_int_equal(read_pfm("Pf\n2 1\n-1.0\n", "\n"), KOKSMA_MALFORMED);
    /* the first byte of a float may be a blank's, too */
    file f = {.size = 0};
    koksma_image image;
    put(&f, "Pf 1 1 -1 \n\n\0@", 14);
    assert_ok(read_bytes("blank.pfm", &f, f.size, &image));
    koksma_image_fini(&image);
}

/* Its 846 bytes claim an image of 13 x 11 pixels in tiles of 8,388,616 x 4, which the C++ library makes room for. */
TEST_CASE(tiles_beyond_the_image_are_refused)
{
    koksma_image image;
    assert_int_equal(koksma_image_read(KOKSMA_TESTS "/../fuzz/corpus/image_exr/tiles_beyond.exr", &image),
                     KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "tiles are larger than the image"));
}

/* The table's bytes are those of the curve, on both sides of each step between two bytes and elsewhere. */
TEST_CASE(table_of_levels_is_the_curve)
{
    koksma__srgb_table table;
    koksma__srgb_table_make(&table);
    for (int b = 0; b <= 256; b++) {
        const float at = b < 256 ? table.least[b] : 1;
        const float near[] = {nextafterf(at, -1), at, nextafterf(at, 2), at + 1e-4f, -at, 3 * at};
        for (size_t i = 0; i < sizeof near / sizeof *near; i++) {
            assert_int_equal(koksma__srgb_table_byte(&table, near[i]), koksma__srgb_byte(near[i]));
        }
    }
    for (int i = 0; i < 100000; i++) {
        const float x = (float)i * 1.1e-5f;
        assert_int_equal(koksma__srgb_table_byte(&table, x), koksma__srgb_byte(x));
    }
    assert_int_equal(koksma__srgb_table_byte(&table, (float)NAN), 0);
    assert_int_equal(koksma__srgb_table_byte(&table, HUGE_VALF), 255);
}
