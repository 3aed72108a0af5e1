/* SPDX-License-Identifier: Apache-2.0 */
/* JPEG files that are made by hand: what is damaged or missing is an error, and what cameras write is not. */
#include <math.h>
#include <string.h>

#include <koksma/image.h>

#include "made_file.h"
#include "test.h"

static void put_segment(file *f, unsigned marker, const void *data, size_t size)
{
    put(f, &(unsigned char[]){0xff, (unsigned char)marker, 0, (unsigned char)(size + 2)}, 4);
    put(f, data, size);
}

/* A grey JPEG of 32 x 8 pixels up to its first scan (ITU-T T.81, annex B). Huffman tables for DC and AC have the single
   code 0, of one bit: DC: no difference; AC: the block ends. `extra` comes behind the first segment. */
static void put_jpeg(file *f, unsigned frame, const char *extra, size_t extra_size)
{
    unsigned char steps[65] = {0}, table[18] = {0, 1};
    memset(steps + 1, 1, 64);
    put(f, "\xff\xd8", 2);
    put_segment(f, 0xdb, steps, sizeof steps);
    put(f, extra, extra_size);
    put_segment(f, frame, "\x08\0\x08\0\x20\x01\x01\x11\0", 9);
    put_segment(f, 0xc4, table, sizeof table);
    table[0] = 0x10;
    put_segment(f, 0xc4, table, sizeof table);
}

/* A scan of the coefficients first to last; bits: as in T.81, Ah and Al. */
static void put_scan(file *f, int first, int last, int bits, const char *data, size_t size)
{
    put_segment(f, 0xda,
                (const unsigned char[]){1, 1, 0, (unsigned char)first, (unsigned char)last, (unsigned char)bits}, 6);
    put(f, data, size);
}

/* Fails with the words, or with NULL gives 32 x 8 pixels of the middle grey. */
static void check_jpeg(file *f, const char *words)
{
    koksma_image image;
    put(f, "\xff\xd9", 2);
    const koksma_status status = read_bytes("made.jpg", f, f->size, &image);
    if (words) {
        assert_int_equal(status, KOKSMA_MALFORMED);
        assert_non_null(strstr(koksma_error_text(), words));
        return;
    }
    assert_ok(status);
    assert_int_equal(image.width, 32);
    assert_int_equal(image.height, 8);
    for (int i = 0; i < 32 * 8; i++) {
        assert_near((double)image.pixels[i], pow((128 / 255.0 + 0.055) / 1.055, 2.4), 1e-6);
    }
    koksma_image_fini(&image);
}

/* The four blocks take eight bits, all 0. What comes instead, before and after them: */
TEST_CASE(damaged_jpeg_is_refused)
{
    static const char zeros[200] = {0};
    static const struct {
        const char *extra;
        size_t extra_size;
        const char *data;
        size_t size;
        const char *words;
    } cases[] = {
        {"", 0, "\0", 1, NULL},
        {"", 0, "", 0, "premature end"},
        {"", 0, "\xff\xd0\0", 3, "premature end"},                       /* a marker that no interval asks for */
        {"", 0, "\xff\x01\0", 3, "premature end"},                       /* another */
        {"", 0, "\xaa\xaa\xaa\xaa", 4, "bad Huffman code"},              /* no code begins with 1 */
        {"", 0, "\0abcdefghijklmnopqrstuvwxyz", 27, "extraneous bytes"}, /* data for which there is no block */
        {"", 0, zeros, sizeof zeros, "extraneous bytes"},
        {"", 0, zeros, 12, NULL}, /* cameras fill up so */
        /* in the head: bytes between segments, a version 9 of JFIF, a transform 7 of Adobe */
        {"abc", 3, "\0", 1, NULL},
        {"\xff\xe0\0\x10JFIF\0\x09\0\0\0\1\0\1\0\0", 18, "\0", 1, NULL},
        {"\xff\xee\0\x0e"
         "Adobe\0\x64\0\0\0\0\7",
         16, "\0", 1, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        file f = {.size = 0};
        put_jpeg(&f, 0xc0, cases[i].extra, cases[i].extra_size);
        put_scan(&f, 0, 63, 0, cases[i].data, cases[i].size);
        check_jpeg(&f, cases[i].words);
    }
    file arithmetic = {.size = 0};
    put_jpeg(&arithmetic, 0xc9, "", 0);
    put_scan(&arithmetic, 0, 63, 0, "\0", 1);
    check_jpeg(&arithmetic, "arithmetic");
}

/* A progressive file is whole once all bits of all coefficients came, and never has a hundred scans. */
TEST_CASE(progressive_jpeg_has_all_its_scans)
{
    static const struct {
        int first, last, bits;
    } scans[] = {{0, 0, 0x01}, {1, 5, 0}, {6, 63, 0x01}, {6, 63, 0x10}, {0, 0, 0x10}};
    enum { N = sizeof scans / sizeof *scans };
    for (size_t n = 1; n <= N; n++) {
        file f = {.size = 0};
        put_jpeg(&f, 0xc2, "", 0);
        for (size_t i = 0; i < n; i++) {
            put_scan(&f, scans[i].first, scans[i].last, scans[i].bits, "\0", 1);
        }
        check_jpeg(&f, n < N ? "scans are missing" : NULL);
    }
    for (int most = 100; most <= 101; most++) {
        file f = {.size = 0};
        put_jpeg(&f, 0xc2, "", 0);
        put_scan(&f, 0, 0, 0, "\0", 1);
        for (int i = 1; i < 63; i++) {
            put_scan(&f, i, i, i <= most - 64 ? 0x01 : 0, "\0", 1);
        }
        put_scan(&f, 63, 63, 0, "\0", 1);
        for (int i = 1; i <= most - 64; i++) {
            put_scan(&f, i, i, 0x10, "\0", 1);
        }
        check_jpeg(&f, most > 100 ? "more than 100 scans" : NULL);
    }
}

/* In colour each component has a scan of its own here, the last of which may be missing. */
TEST_CASE(each_component_of_a_jpeg_has_a_scan)
{
    for (unsigned char n = 1; n <= 3; n++) {
        file f = {.size = 0}, colour = {.size = 0};
        put_jpeg(&f, 0xc0, "", 0);
        const size_t frame = 2 + 4 + 65;
        put(&colour, f.bytes, frame);
        put_segment(&colour, 0xc0, "\x08\0\x08\0\x20\x03\x01\x11\0\x02\x11\0\x03\x11\0", 15);
        put(&colour, f.bytes + frame + 13, f.size - frame - 13);
        for (unsigned char i = 1; i <= n; i++) {
            put_segment(&colour, 0xda, (const unsigned char[]){1, i, 0, 0, 63, 0}, 6);
            put(&colour, "\0", 1);
        }
        check_jpeg(&colour, n < 3 ? "scans are missing" : NULL);
    }
}
