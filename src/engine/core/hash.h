/* SPDX-License-Identifier: Apache-2.0 */
/* Hashes of bytes. */
#ifndef KOKSMA_CORE_HASH_H
#define KOKSMA_CORE_HASH_H

#include <stddef.h>
#include <stdint.h>

#include "core/visibility.h"

/* 64-bit hash of a byte string: FNV-1a, then the finalizer of SplitMix64, so that each input bit affects all output
   bits. The seeds of a study's jobs are computed from this hash, so it must never change. To hash a string in pieces,
   begin with KOKSMA__HASH_START, call koksma__hash_more for each piece, then koksma__hash_end. */
#define KOKSMA__HASH_START 0xcbf29ce484222325u

static inline uint64_t koksma__hash_more(uint64_t h, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        h = (h ^ ((const unsigned char *)bytes)[i]) * 0x100000001b3u;
    }
    return h;
}

static inline uint64_t koksma__hash_end(uint64_t h)
{
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
}

static inline uint64_t koksma__hash(const void *bytes, size_t size)
{
    return koksma__hash_end(koksma__hash_more(KOKSMA__HASH_START, bytes, size));
}

/* The hashes of four strings, each that of koksma__hash: a byte waits for the multiplication of the one before it, so that
   four strings take as long as the longest. */
static inline void koksma__hash_four(const void *const strings[4], const size_t sizes[4], uint64_t out[4])
{
    size_t done = 0;
    uint64_t h[4] = {KOKSMA__HASH_START, KOKSMA__HASH_START, KOKSMA__HASH_START, KOKSMA__HASH_START};
    while (done < sizes[0] || done < sizes[1] || done < sizes[2] || done < sizes[3]) {
        const unsigned char *at[4];
        size_t end = SIZE_MAX, step[4];
        for (int k = 0; k < 4; k++) { /* the end of the shortest string that has bytes left */
            end = sizes[k] > done && sizes[k] < end ? sizes[k] : end;
        }
        for (int k = 0; k < 4; k++) { /* of strings that have ended, one byte is read again and again, for nothing */
            step[k] = sizes[k] > done;
            at[k] = step[k] ? (const unsigned char *)strings[k] + done : (const unsigned char *)"";
        }
        uint64_t a = h[0], b = h[1], c = h[2], d = h[3];
        for (size_t i = 0; i < end - done; i++) {
            a = (a ^ at[0][i * step[0]]) * 0x100000001b3u;
            b = (b ^ at[1][i * step[1]]) * 0x100000001b3u;
            c = (c ^ at[2][i * step[2]]) * 0x100000001b3u;
            d = (d ^ at[3][i * step[3]]) * 0x100000001b3u;
        }
        h[0] = step[0] ? a : h[0];
        h[1] = step[1] ? b : h[1];
        h[2] = step[2] ? c : h[2];
        h[3] = step[3] ? d : h[3];
        done = end;
    }
    for (int k = 0; k < 4; k++) {
        out[k] = koksma__hash_end(h[k]);
    }
}

/* ---- SHA-256 (FIPS 180-4): the fingerprints of reference images, of a study's rows and of its plan ---- */

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
