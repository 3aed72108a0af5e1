/* SPDX-License-Identifier: Apache-2.0 */
/* An image file that a test makes byte by byte, and reads. */
#ifndef KOKSMA_TESTS_MADE_FILE_H
#define KOKSMA_TESTS_MADE_FILE_H

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <koksma/image.h>

#include "test.h"

typedef struct file {
    unsigned char bytes[4096];
    size_t size;
} file;

static inline void put(file *f, const void *bytes, size_t size)
{
    assert_true(f->size + size <= sizeof f->bytes);
    memcpy(f->bytes + f->size, bytes, size);
    f->size += size;
}

/* Little-endian. */
static inline void put_number(file *f, uint64_t x, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        put(f, &(unsigned char){(unsigned char)(x >> 8 * i)}, 1);
    }
}

static inline koksma_status read_bytes(const char *name, const file *f, size_t size, koksma_image *image)
{
    test_write_bytes(name, f->bytes, size);
    const koksma_status status = koksma_image_read(name, image);
    unlink(name);
    return status;
}

#endif
