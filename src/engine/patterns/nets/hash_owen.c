/* SPDX-License-Identifier: Apache-2.0 */
/* Hashed Owen scrambling of digital sequences (Laine & Karras 2011, Burley 2020) for blocks of points, with the
   seeds and the order of koksma/sampler.h. Position i of the order has the index to which a nested uniform shuffle
   by the same hash maps i; the upper 16 bits of this index are combined, by an exclusive or, with those of the index to
   which 0 is mapped. So positions below 2^16 have indices below 2^16, and koksma/sampler.h computes their points from
   four rows of its tables instead of eight. */
#include "patterns/nets/nets.h"

#include <koksma/sampler.h>

#include "kernels/kernels.h"

void koksma__hash_owen_order(uint64_t seed, uint64_t part, uint64_t first, size_t count, uint32_t *index)
{
    const uint32_t order = part ? koksma_order(seed, (uint32_t)part) : koksma_seed_of_order(seed);
    const uint32_t shift = koksma_mirror(koksma_owen_hash(0, order)) & 0xffff0000u;
    for (size_t i = 0; i < count; i++) {
        index[i] = (uint32_t)(first + i);
    }
    koksma__kernels()->owen_hash(count, index, true, true, order, index);
    for (size_t i = 0; i < count; i++) {
        index[i] ^= shift;
    }
}

/* Scrambles digits 33 to 53, which are `late` for all points, and adds them to xs[i]; v[i] has the 32 scrambled digits
   before them. */
static void add_late(uint64_t seed, int k, uint32_t late, size_t count, const uint32_t *v, double *xs)
{
    const uint32_t digits = koksma_mirror(late) >> (32 - KOKSMA__LATE_DIGITS); /* digit 33 is bit 0 */
    const uint64_t key = (uint64_t)koksma_seed_of(seed, (uint32_t)k) << 32;
    for (size_t i = 0; i < count; i++) {
        const uint32_t s = (uint32_t)(koksma_mix(koksma_mix(key | v[i])) >> 32);
        const uint32_t scrambled = koksma_owen_hash(digits, s) ^ koksma_owen_hash(0, s);
        xs[i] += (koksma_mirror(scrambled) >> (32 - KOKSMA__LATE_DIGITS)) * 0x1p-53;
    }
}

void koksma__hash_owen_scramble(uint64_t seed, int k, uint64_t sum, size_t count, uint32_t *v, double *xs)
{
    const uint32_t common = koksma_mirror(koksma__early_digits(sum)), late = (uint32_t)(sum & KOKSMA__LATE_MASK);
    for (size_t i = 0; common && i < count; i++) {
        v[i] ^= common;
    }
    koksma__kernels()->owen_hash(count, v, false, true, koksma_seed_of(seed, (uint32_t)k), v);
    koksma__kernels()->fractions(count, v, xs);
    if (late) {
        add_late(seed, k, late, count, v, xs);
    }
}

void koksma__mirror_directions(const uint32_t *directions, uint32_t *mirrored)
{
    for (int b = 0; b < 32; b++) {
        mirrored[b] = koksma_mirror(directions[b]);
    }
}
