/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_HASH_H
#define KOKSMA_CORE_HASH_H

#include <stddef.h>
#include <stdint.h>

/* 64 bits of a byte string: FNV-1a, then the finalizer of SplitMix64 so that every bit counts.
   Seeds of study jobs are made of it, so it never changes. */
static inline uint64_t koksma__hash(const void *bytes, size_t size)
{
    uint64_t h = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++) {
        h = (h ^ ((const unsigned char *)bytes)[i]) * 0x100000001b3u;
    }
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
}

#endif
