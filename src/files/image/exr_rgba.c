/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads the EXR files that OpenEXRCore 3.1.5 decodes wrongly (B44, B44A) or not at all (DWAA, DWAB), by the C
 * interface of OpenEXR's C++ library. That interface opens files only by name, so the bytes are copied to a file in
 * memory (memfd). It returns half floats. It keeps its last error in a variable that all threads share: the text of
 * an error may be that of another thread, but the status is right.
 */
#define _GNU_SOURCE /* memfd_create */
#include "image/exr_rgba.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <OpenEXR/ImfCRgbaFile.h>

#include "image/exr.h"
#include "modules/module_side.h"

/* Fails with the library's message, without the name of the file in memory, which it has in quotes. */
static koksma_status fail(const char *path)
{
    char name[72];
    const char *text = ImfErrorMessage();
    const int length = snprintf(name, sizeof name, " \"%s\"", path);
    const char *at = strstr(text, name);
    return koksma__fail(KOKSMA_MALFORMED, "as an EXR: %.*s%s", at ? (int)(at - text) : (int)strlen(text), text,
                        at ? at + length : "");
}

static koksma_status read_pixels(ImfInputFile *file, const char *path, size_t size, int channels, bool wide,
                                 koksma_image *out)
{
    int low_x, low_y, high_x, high_y;
    ImfHeaderDataWindow(ImfInputHeader(file), &low_x, &low_y, &high_x, &high_y);
    KOKSMA__TRY(KOKSMA__EXR_HOST->image_claim((long long)high_x - low_x + 1, (long long)high_y - low_y + 1, channels,
                                              size, 4096, out));
    const size_t width = (size_t)out->width;
    ImfRgba *row = malloc(width * sizeof *row);
    KOKSMA__REQUIRE_MEMORY(row, width * sizeof *row);
    bool whole = true, fits = true;
    for (int y = low_y; whole && y <= high_y; y++) {
        /* the library expects the address that pixel (0, 0) would have */
        ImfRgba *base = (ImfRgba *)((uintptr_t)row - (uintptr_t)((ptrdiff_t)low_x * (ptrdiff_t)sizeof *row));
        whole = ImfInputSetFrameBuffer(file, base, 1, 0) && ImfInputReadPixels(file, y, y);
        for (size_t x = 0; whole && x < width; x++) {
            const float colour[3] = {ImfHalfToFloat(row[x].r), ImfHalfToFloat(row[x].g), ImfHalfToFloat(row[x].b)};
            const size_t at = width * (size_t)(y - low_y) + x;
            for (size_t k = 0; k < (size_t)channels; k++) {
                out->pixels[at * (size_t)channels + k] = colour[k];
                fits &= !wide || isfinite(colour[k]);
            }
        }
    }
    free(row);
    if (!whole) {
        return fail(path);
    }
    return fits ? KOKSMA_OK
                : koksma__fail(KOKSMA_MALFORMED, "as an EXR: numbers above 65504 in a B44 or DWA file are not read");
}

/* Whether a list of channels has exactly `size` bytes. Each entry is a name with its zero byte and 16 more bytes; an
   empty name ends the list. */
static bool is_channel_list(const unsigned char *value, size_t size)
{
    size_t at = 0;
    while (at < size && value[at]) {
        const unsigned char *end = memchr(value + at, 0, size - at);
        at = end ? (size_t)(end - value) + 17 : size;
    }
    return at + 1 == size;
}

/* Whether a value's stated size is that of its type, for the types in the table below. For these the C++ library
   ignores the stated size: if it differed from the type's, the library would find the next attribute at another
   position than readers that use the stated size. For all other types the C++ library uses the stated size. */
static bool value_fits(const char *type, const unsigned char *value, size_t size)
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
    return strcmp(type, "chlist") != 0 || is_channel_list(value, size);
}

/* Whether the attributes of the headers lie within the file: the C++ library allocates as much memory as they claim.
   An attribute is name, type, size and value; an empty name ends a header, and an empty header ends the headers of a
   file of several parts (https://openexr.com/en/latest/OpenEXRFileLayout.html). */
static bool header_fits(const unsigned char *bytes, size_t size)
{
    size_t at = 8;
    const bool parts = size > 8 && (bytes[5] & 0x10);
    while (at < size && bytes[at]) {
        const char *type = NULL;
        for (int text = 0; text < 2; text++) { /* skips the name, then the type */
            type = (const char *)bytes + at;
            const unsigned char *end = memchr(bytes + at, 0, size - at);
            if (!end) {
                return false;
            }
            at = (size_t)(end - bytes) + 1;
            if (at + 4 > size) {
                return false;
            }
        }
        const size_t value =
            bytes[at] | (size_t)bytes[at + 1] << 8 | (size_t)bytes[at + 2] << 16 | (size_t)bytes[at + 3] << 24;
        at += 4;
        if (value > size - at || !value_fits(type, bytes + at, value)) {
            return false;
        }
        at += value;
        at += parts && at + 1 < size && !bytes[at]; /* go to the next header, or to the empty header that ends the
                                                       list */
    }
    return at < size;
}

koksma_status koksma__exr_rgba_read(const unsigned char *bytes, size_t size, int channels, bool wide,
                                    koksma_image *out)
{
    char path[64];
    KOKSMA__FAIL_IF(!header_fits(bytes, size), KOKSMA_MALFORMED,
                    "as an EXR: an attribute of its header states a wrong size");
    const int descriptor = memfd_create("koksma", MFD_CLOEXEC);
    ssize_t n = descriptor < 0 ? -1 : 0;
    for (size_t done = 0; n >= 0 && done < size; done += (size_t)(n > 0 ? n : 0)) {
        n = write(descriptor, bytes + done, size - done);
    }
    koksma_status status = KOKSMA_OK;
    if (n < 0) {
        status = koksma__fail(KOKSMA_SYSTEM, "as an EXR: can't make a file in memory: %s", strerror(errno));
    } else {
        snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
        ImfInputFile *file = ImfOpenInputFile(path);
        status = file ? read_pixels(file, path, size, channels, wide, out) : fail(path);
        if (file) {
            ImfCloseInputFile(file);
        }
    }
    if (descriptor >= 0) {
        close(descriptor);
    }
    return status;
}
