/* SPDX-License-Identifier: Apache-2.0 */
/* Images of kinds that the program reads and never writes: EXR in tiles, PNG of 16 bits. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/image.h>

#include "test.h"

/* ---- A file, byte by byte; numbers are little-endian ----------------------------------------------------- */

typedef struct file {
    unsigned char bytes[4096];
    size_t size;
} file;

static void put(file *f, const void *bytes, size_t size)
{
    assert_true(f->size + size <= sizeof f->bytes);
    memcpy(f->bytes + f->size, bytes, size);
    f->size += size;
}

static void put_number(file *f, uint64_t x, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        put(f, &(unsigned char){(unsigned char)(x >> 8 * i)}, 1);
    }
}

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

static koksma_status read_bytes(const char *name, const file *f, size_t size, koksma_image *image)
{
    FILE *stream = fopen(name, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(f->bytes, 1, size, stream), size);
    assert_int_equal(fclose(stream), 0);
    const koksma_status status = koksma_image_read(name, image);
    unlink(name);
    return status;
}

static void tiles_are_read(void **state)
{
    (void)state;
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

/* Grey pixels 0, 0x8000 and 0xffff. Without a gamma 16 bits are linear; with one of 1/2.2 they are not. */
static void deep_png_is_read(void **state)
{
    (void)state;
    static const unsigned char head[] = {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a, 0,    0,    0,
                                         13,   'I', 'H', 'D', 'R',  0,    0,    0,    3,    0,    0,
                                         0,    1,   16,  0,   0,    0,    0,    0x6e, 0x1b, 0x97, 0x2b};
    static const unsigned char gamma[] = {0, 0, 0, 4, 'g', 'A', 'M', 'A', 0, 0, 0xb1, 0x8f, 0x0b, 0xfc, 0x61, 0x05};
    static const unsigned char pixels[] = {0,    0,    0,    15,   'I',  'D', 'A', 'T', 0x78, 0xda, 0x63, 0x60, 0x60,
                                           0x68, 0x60, 0xf8, 0xff, 0x1f, 0,   5,   4,   2,    0x7f, 0x5a, 0xfb, 0xf7,
                                           0xa7, 0,    0,    0,    0,    'I', 'E', 'N', 'D',  0xae, 0x42, 0x60, 0x82};
    for (int encoded = 0; encoded < 2; encoded++) {
        file f = {.size = 0};
        koksma_image image;
        put(&f, head, sizeof head);
        put(&f, gamma, encoded ? sizeof gamma : 0);
        put(&f, pixels, sizeof pixels);
        assert_ok(read_bytes("deep.png", &f, f.size, &image));
        assert_int_equal(image.width, 3);
        assert_int_equal(image.channels, 1);
        assert_near((double)image.pixels[0], 0, 0);
        assert_near((double)image.pixels[1], encoded ? pow(32768 / 65535.0, 2.2) : 32768 / 65535.0,
                    encoded ? 5e-3 : 1e-6);
        assert_near((double)image.pixels[2], 1, 0);
        koksma_image_fini(&image);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(tiles_are_read), cmocka_unit_test(deep_png_is_read)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
