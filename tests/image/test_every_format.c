/* SPDX-License-Identifier: Apache-2.0 */
/* Walks the table of image formats: what each claims to keep comes back, of every shape and channel count; every
   channel of every layer is in the file; a file is known to one format; and a file cut short or with a byte changed
   ends in an error or an image. Files lie before a page that can't be read, so that one byte too far is a crash. */
#define _GNU_SOURCE 1 /* memmem, MAP_ANONYMOUS */
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "image/formats.h"
#include "image/image.h"
#include "sets.h"

static const int shapes[][2] = {{1, 1}, {3, 2}, {1, 9}, {17, 1}, {16, 5}, {7, 33}};
enum { SHAPES = sizeof shapes / sizeof *shapes };

/* Floats of all sizes and signs, all different but two zeros. */
static koksma_image picture(int width, int height, int channels, uint64_t seed)
{
    koksma_image image;
    assert_ok(koksma_image_init(&image, width, height, channels));
    for (size_t i = 0; i < (size_t)width * (size_t)height * (size_t)channels; i++) {
        const double u = sets_unit(seed, i), scale = i % 5 == 0 ? 1e6 : i % 7 == 0 ? 1e-6 : i % 11 == 0 ? -1 : 1;
        image.pixels[i] = (float)(u * scale);
    }
    image.pixels[0] = -0.0f;
    return image;
}

static koksma__bytes file_of(const koksma__image_format *format, const koksma_layer *layers, size_t n)
{
    koksma__bytes bytes = {0};
    assert_that(!format->write(layers, n, "made by a test", &bytes), "%s: %s", format->name, koksma_error_text());
    return bytes;
}

/* The pixel that a format brings back: to the bit, or within its error. */
static void assert_kept(const koksma__image_format *format, float before, float after, size_t i)
{
    const double wanted = fmin(fmax((double)before, 0), 1);
    if (format->error > 0 ? !(fabs((double)after - wanted) <= format->error) : memcmp(&before, &after, 4) != 0) {
        fail_msg("%s: number %zu was %.9g and comes back as %.9g", format->name, i, (double)before, (double)after);
    }
}

TEST_CASE(images_come_back)
{
    const koksma__image_format *format;
    size_t tested = 0;
    for (size_t f = 0; (format = koksma__image_format_at(f)); f++) {
        for (int s = 0; s < 2 * SHAPES && !format->left_out; s++) {
            const int channels = s % 2 ? 3 : 1;
            koksma_image image = picture(shapes[s / 2][0], shapes[s / 2][1], channels, 70 + (uint64_t)s), back = {0};
            koksma__bytes bytes = file_of(format, &(koksma_layer){"", &image}, 1);
            for (size_t g = 0; koksma__image_format_at(g); g++) {
                assert_that(koksma__image_recognises(koksma__image_format_at(g), bytes.data, bytes.size) == (f == g),
                            "a file of %s asked of %s", format->name, koksma__image_format_at(g)->name);
            }
            assert_ok(koksma__image_read_bytes(bytes.data, bytes.size, KOKSMA__FILE_IMAGE, &back));
            assert_that(back.width == image.width && back.height == image.height && back.channels == channels,
                        "%s: %d x %d x %d came back as %d x %d x %d", format->name, image.width, image.height,
                        channels, back.width, back.height, back.channels);
            for (size_t i = 0; i < (size_t)image.width * (size_t)image.height * (size_t)channels; i++) {
                assert_kept(format, image.pixels[i], back.pixels[i], i);
            }
            koksma_image_fini(&image);
            koksma_image_fini(&back);
            free(bytes.data);
            tested++;
        }
    }
    assert_true(tested > 0);
}

/* A changed number of any channel changes the file, and names of channels are in it; a format without layers writes
   the first alone. */
TEST_CASE(every_layer_is_in_the_file)
{
    enum { LAYERS = 3, WIDTH = 5, HEIGHT = 3 };
    static const char *const names[] = {"R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "Z"};
    const koksma__image_format *format;
    for (size_t f = 0; (format = koksma__image_format_at(f)); f++) {
        if (format->left_out) {
            continue;
        }
        koksma_image images[LAYERS] = {picture(WIDTH, HEIGHT, 3, 1), picture(WIDTH, HEIGHT, 3, 2),
                                       picture(WIDTH, HEIGHT, 1, 3)};
        const koksma_layer layers[] = {{"", &images[0]}, {"albedo", &images[1]}, {"Z", &images[2]}};
        koksma__bytes bytes = file_of(format, layers, LAYERS), only = file_of(format, layers, 1);
        assert_int_equal(format->has_layers,
                         only.size != bytes.size || memcmp(only.data, bytes.data, only.size) != 0);
        for (size_t k = 0; format->has_layers && k < sizeof names / sizeof *names; k++) {
            if (!memmem(bytes.data, bytes.size, names[k], strlen(names[k]) + 1)) {
                fail_msg("%s: no channel %s", format->name, names[k]);
            }
        }
        for (int l = 0; l < (format->has_layers ? LAYERS : 1); l++) {
            for (int i = 0; i < WIDTH * HEIGHT * images[l].channels; i++) {
                const float before = images[l].pixels[i];
                images[l].pixels[i] = before > 0.5f ? 0 : 1;
                koksma__bytes other = file_of(format, layers, LAYERS);
                assert_that(other.size != bytes.size || memcmp(other.data, bytes.data, other.size),
                            "%s: number %d of layer %d is not in the file", format->name, i, l);
                images[l].pixels[i] = before;
                free(other.data);
            }
        }
        free(bytes.data);
        free(only.data);
        for (int l = 0; l < LAYERS; l++) {
            koksma_image_fini(&images[l]);
        }
    }
}

/* Bytes that end where a page begins that can't be read. */
typedef struct fenced {
    unsigned char *memory, *end;
    size_t size;
} fenced;

static fenced fence(size_t size)
{
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), whole = (size + page - 1) / page * page;
    fenced f = {.size = whole + page};
    f.memory = mmap(NULL, f.size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(f.memory != MAP_FAILED);
    f.end = f.memory + whole;
    assert_int_equal(mprotect(f.end, page, PROT_NONE), 0);
    return f;
}

/* An error that names the problem in a line, or (true) an image of a shape that images have. */
static bool assert_error_or_image(const koksma__image_format *format, const unsigned char *bytes, size_t size)
{
    koksma_image image = {0};
    const koksma_status status = koksma__image_read_bytes(bytes, size, KOKSMA__FILE_IMAGE, &image);
    if (status) {
        assert_true(status == KOKSMA_MALFORMED || status == KOKSMA_UNSUPPORTED);
        assert_true(*koksma_error_text() && !strchr(koksma_error_text(), '\n'));
        assert_null(image.pixels);
    } else if (!image.pixels || koksma__image_check_shape(image.width, image.height, image.channels)) {
        fail_msg("%s: an image of %d x %d x %d", format->name, image.width, image.height, image.channels);
    }
    koksma_image_fini(&image);
    return !status;
}

TEST_CASE(broken_files_are_errors_or_images)
{
    /* 0x0a and 0x0b make DWAB and DWAA of the ZIP in an EXR's header */
    static const unsigned char flips[] = {0x01, 0x10, 0x80, 0xff, 0x0a, 0x0b};
    const koksma__image_format *format;
    for (size_t f = 0; (format = koksma__image_format_at(f)); f++) {
        for (int channels = 1; channels <= 3 && !format->left_out; channels += 2) {
            koksma_image image = picture(4, 3, channels, 9);
            koksma__bytes bytes = file_of(format, &(koksma_layer){"", &image}, 1);
            fenced memory = fence(bytes.size);
            for (size_t size = 0; size < bytes.size; size++) {
                memcpy(memory.end - size, bytes.data, size);
                const bool is_image = assert_error_or_image(format, memory.end - size, size);
                assert_false(is_image && size + 16 < bytes.size); /* a PNG without its end mark is whole for libpng */
            }
            for (size_t i = 0; i < sizeof flips * bytes.size; i++) {
                unsigned char *copy = memory.end - bytes.size;
                memcpy(copy, bytes.data, bytes.size);
                copy[i / sizeof flips] ^= flips[i % sizeof flips];
                assert_error_or_image(format, copy, bytes.size);
            }
            munmap(memory.memory, memory.size);
            free(bytes.data);
            koksma_image_fini(&image);
        }
    }
}

/* Names in errors come from the table. */
TEST_CASE(errors_name_every_format)
{
    const char *name, *left_out;
    assert_int_equal(koksma_image_check_path("picture.nosuch"), KOKSMA_ARGUMENT);
    for (size_t i = 0; (name = koksma_image_format(i, &left_out)); i++) {
        char text[32];
        snprintf(text, sizeof text, ".%s", name);
        assert_non_null(strstr(koksma_error_text(), text));
    }
}
