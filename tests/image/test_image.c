/* SPDX-License-Identifier: Apache-2.0 */
/* Image files: round trips of hard pixels and names, hand-counted errors, and what is no image. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/image.h>

#include "core/random.h"
#include "image/formats.h"
#include "test.h"

static koksma_image noise(int width, int height, int channels)
{
    koksma_image image;
    assert_ok(koksma_image_init(&image, width, height, channels));
    for (size_t i = 0; i < (size_t)(width * height * channels); i++) {
        const koksma__words r = koksma__random(1, KOKSMA__PURPOSE_TEST, i, 0);
        image.pixels[i] = (float)((double)r.w[0] * 0x1p-32) * (r.w[1] % 7 ? 1.0f : -1e30f);
    }
    return image;
}

static koksma__bytes written(const char *format, const koksma_image *image)
{
    koksma__bytes bytes = {0};
    const koksma__image_format *f = NULL;
    for (size_t i = 0; !f; i++) {
        f = strcmp(koksma__image_format_at(i)->name, format) ? NULL : koksma__image_format_at(i);
    }
    const koksma_layer only = {"", image};
    assert_ok(f->write(&only, 1, "what it is", &bytes));
    assert_true(koksma__image_recognises(f, bytes.data, bytes.size));
    return bytes;
}

/* Pixels of every entropy, so that compressed chunks come in all lengths, that of the pixels themselves among them.
 */
TEST_CASE(exr_keeps_noise_of_every_kind)
{
    for (uint32_t bits = 0; bits <= 32; bits++) {
        static const int sizes[][3] = {{1, 18, 3}, {156, 35, 1}, {187, 52, 3}, {125, 35, 3}, {32, 18, 1}};
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
            koksma_image image, back = {0};
            assert_ok(koksma_image_init(&image, sizes[s][0], sizes[s][1], sizes[s][2]));
            const size_t count = (size_t)(image.width * image.height * image.channels);
            for (size_t i = 0; i < count; i++) {
                const uint32_t noise = koksma__random(bits, 1, i, 0).w[0];
                const uint32_t word = 0x3f000000u ^ (bits ? noise >> (32 - bits) : 0);
                memcpy(&image.pixels[i], &word, sizeof word);
            }
            koksma__bytes bytes = written("exr", &image);
            assert_ok(koksma__format_exr.read(bytes.data, bytes.size, KOKSMA__IMAGE_COLOURS, &back));
            assert_memory_equal(back.pixels, image.pixels, count * sizeof(float));
            koksma_image_fini(&back);
            koksma_image_fini(&image);
            free(bytes.data);
        }
    }
}

/* All 256 grey levels: linear values that come from a PNG give the same PNG. */
TEST_CASE(png_levels_come_back)
{
    koksma_image image, back;
    assert_ok(koksma_image_init(&image, 16, 16, 1));
    for (int i = 0; i < 256; i++) {
        const double s = i / 255.0;
        image.pixels[i] = (float)(s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4));
    }
    unsigned char *bytes;
    size_t size;
    assert_ok(koksma_image_png_bytes(&image, &bytes, &size));
    assert_ok(koksma__format_png.read(bytes, size, KOKSMA__IMAGE_COLOURS, &back));
    assert_memory_equal(back.pixels, image.pixels, 256 * sizeof(float));
    koksma_image_fini(&back);
    free(bytes);
    image.pixels[0] = -3;
    image.pixels[1] = 7;
    image.pixels[2] = NAN;
    assert_ok(koksma_image_png_bytes(&image, &bytes, &size));
    assert_ok(koksma__format_png.read(bytes, size, KOKSMA__IMAGE_COLOURS, &back));
    assert_true(back.pixels[0] == 0 && back.pixels[1] == 1 && back.pixels[2] == 0);
    koksma_image_fini(&back);
    free(bytes);
    koksma_image_fini(&image);
}

/* Errors 0, 0.5, 0.25 and -0.25 (in luminance). */
TEST_CASE(errors_by_hand)
{
    koksma_image a, b, difference;
    koksma_image_error e;
    assert_ok(koksma_image_init(&a, 2, 2, 1));
    assert_ok(koksma_image_init(&b, 2, 2, 3));
    const float values[] = {0, 1, 0.75f, 0.25f};
    memcpy(a.pixels, values, sizeof values);
    for (int i = 3; i < 12; i++) {
        b.pixels[i] = 0.5f; /* grey has its own luminance */
    }
    assert_ok(koksma_image_compare(&a, &b, &e));
    assert_near(e.mean, 0.25, 1e-15);
    assert_near(e.sd, sqrt(0.125 / 4), 1e-15);
    assert_near(e.max, 0.5, 1e-15);
    assert_near(e.rmse, sqrt(0.375 / 4), 1e-15);
    assert_ok(koksma_image_difference(&a, &b, &difference));
    assert_true(difference.channels == 1 && difference.pixels[1] == 0.5f && difference.pixels[3] == 0.25f);
    koksma_image_fini(&difference);
    koksma_image_fini(&b);
    assert_ok(koksma_image_init(&b, 2, 3, 1));
    assert_int_equal(koksma_image_compare(&a, &b, &e), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_image_difference(&a, &b, &difference), KOKSMA_ARGUMENT);
    koksma_image_fini(&a);
    koksma_image_fini(&b);
}

/* A slope of light from 1 to 2, and white noise. */
static koksma_image slope(double noise, double times, bool backwards, uint64_t seed)
{
    koksma_image image;
    assert_ok(koksma_image_init(&image, 32, 32, 1));
    for (size_t i = 0; i < 1024; i++) {
        const koksma__words r = koksma__random(seed, KOKSMA__PURPOSE_TEST, i, 0);
        const double at = (double)(backwards ? 31 - i % 32 : i % 32) / 31;
        image.pixels[i] = (float)(times * (1 + at + noise * ((double)r.w[0] * 0x1p-32 - 0.5)));
    }
    return image;
}

TEST_CASE(doubts_by_construction)
{
    static const struct {
        double noise, times;
        bool backwards;
        const char *said; /* NULL: nothing */
    } cases[] = {
        {0.2, 1, false, NULL},
        {2, 1, false, NULL},
        {0.2, 1.1, false, NULL},
        {0.2, 255, false, "its mean is 25"},
        {0.2, 1 / 255.0, false, "0.0039"},
        {2, 2, false, "times"},
        {0.2, 0.5, false, "0.5"},
        {0.2, 1, true, "another scene"},
        {0, 1, false, "same image"},
        {0, 0, false, "1024 of its pixels are black"},
    };
    koksma_image reference = slope(0, 1, false, 0);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_image image = slope(cases[i].noise, cases[i].times, cases[i].backwards, 1);
        const char *said = koksma_image_doubt(&image, &reference, true);
        if (cases[i].said ? !strstr(said, cases[i].said) : *said) {
            fail_msg("case %zu: '%s'", i, said);
        }
        koksma_image_fini(&image);
    }
    koksma_image noisy = slope(1, 1, false, 1), better = slope(0.2, 1, false, 2), colours, other;
    assert_non_null(strstr(koksma_image_doubt(&better, &noisy, true), "less noise"));
    assert_non_null(strstr(koksma_image_doubt(&better, &noisy, false), "noise of its own"));
    memset(noisy.pixels + 512, 0, 256 * sizeof *noisy.pixels);
    assert_non_null(strstr(koksma_image_doubt(&noisy, &reference, true), "256 of its pixels are black"));
    assert_non_null(strstr(koksma_image_doubt(&reference, &noisy, true), "256 pixels of the reference are black"));
    for (size_t i = 512; i < 768; i++) { /* noise, as of few samples that meet no light */
        noisy.pixels[i] = i % 3 ? 0 : 4;
    }
    assert_string_equal(koksma_image_doubt(&noisy, &reference, true), "");
    assert_ok(koksma_image_init(&colours, 32, 32, 3));
    for (size_t i = 0; i < 3072; i++) {
        colours.pixels[i] = noisy.pixels[i / 3];
    }
    assert_string_equal(koksma_image_doubt(&colours, &better, true), "");
    colours.pixels[5] *= 1.5f;
    assert_non_null(strstr(koksma_image_doubt(&colours, &better, true), "has colours"));
    koksma_image reversed = colours;
    float bgr[3072];
    for (size_t i = 0; i < 3072; i++) {
        colours.pixels[i] *= i % 3 ? 1 : 1.4f;
    }
    for (size_t i = 0; i < 3072; i++) {
        bgr[i] = colours.pixels[i / 3 * 3 + 2 - i % 3];
    }
    reversed.pixels = bgr;
    assert_non_null(strstr(koksma_image_doubt(&reversed, &colours, true), "in reverse"));
    assert_ok(koksma_image_init(&other, 32, 31, 1));
    assert_string_equal(koksma_image_doubt(&other, &better, true), "");
    koksma_image_fini(&other);
    koksma_image_fini(&colours);
    koksma_image_fini(&better);
    koksma_image_fini(&noisy);
    koksma_image_fini(&reference);
}

TEST_CASE(sizes_are_checked)
{
    static const char *const headers[] = {
        "PF\n100000 100000\n-1\n", "Pf\n65536 4096\n-1\nabc",
        "Pf\n0 5\n-1\n",           "Pf\n-3 5\n1\n",
        "PF\n3 x\n-1\n",           "PF\n3 3\n0\n",
        "PF\n3 3\nnan\n",          "PF\n99999999999999999999 1\n-1\n",
    };
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        koksma_image image = {0};
        const unsigned char *bytes = (const unsigned char *)headers[i];
        assert_int_equal(koksma__format_pfm.read(bytes, strlen(headers[i]), KOKSMA__IMAGE_COLOURS, &image),
                         KOKSMA_MALFORMED);
        koksma_image_fini(&image);
    }
    koksma_image image;
    assert_int_equal(koksma_image_init(&image, 0, 3, 1), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_image_init(&image, 3, 3, 2), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_image_init(&image, 65536, 65536, 1), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_image_read("no/such.exr", &image), KOKSMA_MISSING);
    assert_int_equal(koksma_image_read(KOKSMA_TESTS, &image), KOKSMA_MISSING);
    koksma_image_fini(NULL);
}

/* Names as long as image.h allows are in the file; files without such names are as older readers take them. */
TEST_CASE(layers_have_long_names)
{
    static const char longest[] = "abcdefghijklmnopqrstuvwxyz.ABCDEFGHIJKLMNOPQRSTUVWXYZ.012345678";
    koksma_image image = noise(5, 3, 3), grey = noise(5, 3, 1), back;
    alarm(60); /* an error's handler that waits for a lock waits for ever */
    for (size_t length = 29; length <= 63; length++) {
        const koksma_layer layers[] = {
            {"", &image}, {longest + 63 - length, &grey}, {"colours", &image}, {"x", &grey}};
        koksma__bytes bytes = {0};
        assert_ok(koksma__format_exr.write(layers, 4, "", &bytes));
        assert_int_equal(bytes.data[5] & 4, length > 31 ? 4 : 0); /* the flag of long names */
        free(bytes.data);
        assert_ok(koksma_image_write_layers("names.exr", layers, 4, NULL));
        assert_ok(koksma_image_read("names.exr", &back));
        assert_memory_equal(back.pixels, image.pixels, 45 * sizeof(float));
        koksma_image_fini(&back);
        unlink("names.exr");
    }
    const koksma_layer coloured[] = {{"", &grey}, {longest, &image}};
    assert_ok(koksma_image_write_layers("names.exr", coloured, 2, NULL));
    unlink("names.exr");
    char longer[65];
    snprintf(longer, sizeof longer, "a%s", longest);
    const koksma_layer too_long[] = {{"", &grey}, {longer, &grey}};
    assert_int_equal(koksma_image_write_layers("names.exr", too_long, 2, NULL), KOKSMA_ARGUMENT);
    assert_int_equal(access("names.exr", F_OK), -1);
    alarm(0);
    koksma_image_fini(&image);
    koksma_image_fini(&grey);
}

TEST_CASE(names_are_given_once)
{
    koksma_image image = noise(5, 3, 3), grey = noise(5, 3, 1);
    const koksma_layer twice[][2] = {{{"", &grey}, {"", &grey}},
                                     {{"", &image}, {"", &image}},
                                     {{"", &image}, {"G", &grey}},
                                     {{"", &grey}, {"Y", &grey}},
                                     {{"a", &image}, {"a.B", &grey}}};
    alarm(60);
    for (size_t i = 0; i < sizeof twice / sizeof *twice; i++) {
        assert_int_equal(koksma_image_write_layers("twice.exr", twice[i], 2, NULL), KOKSMA_ARGUMENT);
        assert_non_null(strstr(koksma_error_text(), "twice.exr: two layers have a channel '"));
        assert_int_equal(access("twice.exr", F_OK), -1);
        koksma__bytes bytes = {0}; /* what OpenEXRCore says of it comes back, too */
        assert_int_equal(koksma__format_exr.write(twice[i], 2, "", &bytes), KOKSMA_IO);
        assert_non_null(strstr(koksma_error_text(), "as an EXR: "));
        free(bytes.data);
    }
    alarm(0);
    koksma_image_fini(&image);
    koksma_image_fini(&grey);
}

/* What is no image is refused, and a file of that name stays as it is. */
TEST_CASE(only_images_are_written)
{
    static const char *const names[] = {"kept.exr", "kept.png", "kept.pfm"};
    koksma_image image = noise(4, 2, 3), back;
    const koksma_image none[] = {{0},
                                 {4, 2, 3, NULL},
                                 {4, 2, 2, image.pixels},
                                 {4, 2, 4, image.pixels},
                                 {4, 0, 3, image.pixels},
                                 {-4, 2, 3, image.pixels},
                                 {4, KOKSMA_MAX_IMAGE_SIDE + 1, 1, image.pixels}};
    const koksma_layer nameless[] = {{"", &image}, {NULL, &image}}, empty[] = {{"", &image}, {"a", NULL}};
    unsigned char *bytes;
    size_t size;
    alarm(60);
    for (size_t f = 0; f < sizeof names / sizeof *names; f++) {
        assert_ok(koksma_image_write(names[f], &image, NULL));
        for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
            const koksma_layer second[] = {{"", &image}, {"a", &none[i]}};
            assert_int_equal(koksma_image_write(names[f], &none[i], NULL), KOKSMA_ARGUMENT);
            assert_int_equal(strncmp(koksma_error_text(), names[f], 8), 0);
            assert_int_equal(koksma_image_write_layers(names[f], second, 2, NULL), KOKSMA_ARGUMENT);
        }
        assert_int_equal(koksma_image_write_layers(names[f], NULL, 0, NULL), KOKSMA_ARGUMENT);
        assert_int_equal(koksma_image_write_layers(names[f], nameless, 2, NULL), KOKSMA_ARGUMENT);
        assert_int_equal(koksma_image_write_layers(names[f], empty, 2, NULL), KOKSMA_ARGUMENT);
        assert_ok(koksma_image_read(names[f], &back));
        koksma_image_fini(&back);
        unlink(names[f]);
        assert_int_equal(koksma_image_write(names[f], &none[0], NULL), KOKSMA_ARGUMENT);
        assert_int_equal(access(names[f], F_OK), -1);
    }
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        bytes = (unsigned char *)&size; /* none come */
        assert_int_equal(koksma_image_png_bytes(&none[i], &bytes, &size), KOKSMA_ARGUMENT);
        assert_true(!bytes && size == 0);
    }
    alarm(0);
    koksma_image_fini(&image);
}
