/* SPDX-License-Identifier: Apache-2.0 */
/* SHA-256 (FIPS 180-4): the fingerprints of reference images, of a study's rows and of its plan. */
#ifndef KOKSMA_CORE_SHA256_H
#define KOKSMA_CORE_SHA256_H

#include <stddef.h>
#include <stdint.h>

#include "core/visibility.h"

enum { KOKSMA__SHA256_TEXT = 65 };

typedef struct koksma__sha256 {
    uint32_t state[8];
    uint64_t size; /* number of bytes added so far */
    unsigned char block[64];
} koksma__sha256;

KOKSMA__LAB void koksma__sha256_init(koksma__sha256 *hash);
KOKSMA__LAB void koksma__sha256_add(koksma__sha256 *hash, const void *bytes, size_t size);

/* Writes the hash of all bytes that were added as 64 hexadecimal digits. */
KOKSMA__LAB void koksma__sha256_finish(koksma__sha256 *hash, char text[KOKSMA__SHA256_TEXT]);

#endif
