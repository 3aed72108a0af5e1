/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Mutations of PNG files for libFuzzer. A chunk whose checksum is wrong ends the reading, so that a change of bytes alone
 * would hardly ever reach the code after libpng's check: here every chunk gets its checksum after the change. In one input
 * of four the change is made to the pixels before they are compressed.
 */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

#include "mutate.h"

enum { SIGNATURE = 8, FRAME = 12, MAX_PIXELS = 1 << 16 };

static uint32_t get_32(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static void put_32(uint8_t *bytes, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        bytes[i] = (uint8_t)(value >> (24 - 8 * i));
    }
}

/* The length of the data of the chunk at `at`; false: it does not end within the file. */
static bool chunk_at(const uint8_t *bytes, size_t size, size_t at, size_t *length)
{
    if (size - at < FRAME) {
        return false;
    }
    *length = get_32(bytes + at);
    return *length <= size - at - FRAME;
}

static void put_checksum(uint8_t *chunk, size_t length)
{
    put_32(chunk + 8 + length, (uint32_t)crc32(crc32(0, NULL, 0), chunk + 4, (uInt)length + 4));
}

static void put_checksums(uint8_t *bytes, size_t size)
{
    size_t length;
    for (size_t at = SIGNATURE; at < size && chunk_at(bytes, size, at, &length); at += length + FRAME) {
        put_checksum(bytes + at, length);
    }
}

/* Mutates the uncompressed data of the first chunk of pixels. Returns the new size of the file; 0: there is no such chunk,
   or it would not fit. */
static size_t mutate_pixels(uint8_t *bytes, size_t size, size_t max_size)
{
    static uint8_t pixels[MAX_PIXELS], packed[MAX_PIXELS + 1024];
    size_t length;
    for (size_t at = SIGNATURE; at < size && chunk_at(bytes, size, at, &length); at += length + FRAME) {
        uLongf n = sizeof pixels, n_packed = sizeof packed;
        if (memcmp(bytes + at + 4, "IDAT", 4) != 0) {
            continue;
        }
        if (uncompress(pixels, &n, bytes + at + 8, length) != Z_OK) {
            return 0;
        }
        n = LLVMFuzzerMutate(pixels, n, sizeof pixels);
        if (compress2(packed, &n_packed, pixels, n, 9) != Z_OK || size - length + n_packed > max_size) {
            return 0;
        }
        memmove(bytes + at + 8 + n_packed, bytes + at + 8 + length, size - at - 8 - length);
        memcpy(bytes + at + 8, packed, n_packed);
        put_32(bytes + at, (uint32_t)n_packed);
        put_checksum(bytes + at, n_packed);
        return size - length + n_packed;
    }
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size, size_t max_size, unsigned seed)
{
    size_t length = seed % 4 == 0 ? mutate_pixels(bytes, size, max_size) : 0;
    if (length == 0) {
        length = LLVMFuzzerMutate(bytes, size, max_size);
        put_checksums(bytes, length);
    }
    return length;
}
