/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Ranking and scrambling keys (Heitz & others 2019): each pixel of an image draws from its own copy of one Owen-scrambled
 * (0,2)-sequence, which two keys of the pixel choose such that the errors of neighbouring pixels cancel. No library, no
 * allocation; tables of 64 x 64 pixels are in koksma/keys.def. After koksma/sampler.h, whose notes on compilers hold.
 *
 *     const koksma_keys pixel = koksma_keys_of(seed, x, y, pair, spp);
 *     for (uint32_t i = 0; i < spp; i++) {
 *         double xy[2];
 *         koksma_keys_2d(&pixel, i, xy);
 *
 *     sample i = sequence(i XOR ranking key) XOR scrambling keys
 *
 * There is a table for each of 1, 4 and 16 = 2^m samples a pixel. Its scrambling keys flip 8 digits of x and of y, the same
 * ones in all samples: those behind the first m, which place the samples within their strata; digits further down are
 * Owen-scrambled anew in each pixel. A third key pairs the strata in y with those in x, by an Owen scrambling of the first
 * m digits. The ranking key decides which part of the sequence comes first, so that the errors of smaller powers of two are
 * blue, too. More than 16 samples take the last table, where digits of the pairing behind the fourth are random; powers of
 * two then have an m of their own. Aligned blocks of 2^k samples of a pixel are (0,k,2)-nets in base 2, for all k.
 * docs/findings/blue-noise.md has the
 * measured errors: beyond 100 samples they can be larger than those of independent pixels.
 *
 * A pair of dimensions is a number of your choice, 0, 1, 2 ... below 64: it moves the table by its own distance. Errors
 * that come from one pair of dimensions are blue, those from several pairs together are white. Samples 2^m .. 2^(m+1) - 1
 * of all pairs but the first are in an order of their own for each pixel and pair, so that pairs are independent but for
 * that: the first half of one pair's samples meets the first half of another's.
 *
 * The tables are fixed and the seed moves them, so that a pixel takes the errors of 4,096 pixels in turn: the mean over
 * seeds is the mean over a tile, not exactly the integral.
 */
#ifndef KOKSMA_KEYS_H
#define KOKSMA_KEYS_H

#include <koksma/sampler.h>

enum { KOKSMA_KEYS_SIZE = 64, KOKSMA_KEYS_DIGITS = 8, KOKSMA_KEYS_PAIRS = 64 };

/* What one pixel and pair of dimensions need: compute it once for all samples. */
typedef struct koksma_keys {
    uint32_t sequence[2]; /* seeds of the sequence that all pixels share */
    uint32_t below[2];    /* seeds of the digits below the keys */
    uint32_t flips[2];    /* scrambling keys; bits are reversed: bit 0 flips the first digit */
    uint32_t mask;        /* the digits above those below */
    uint32_t coarse;      /* the first digits, which the pairing key scrambles, 4 at most */
    uint32_t strata;      /* the first m digits */
    uint32_t pairing;     /* seeds of the scramblings that pair strata */
    uint32_t finer;
    uint32_t rank;  /* ranking key */
    uint32_t order; /* of the samples 2^m .. 2^(m+1) - 1, if ordered */
    uint32_t ordered;
} koksma_keys;

/* Sets what a word of a table says: 8 bits of flips of x, 8 of y, 8 of the pairing, and the rank; m as above. */
KOKSMA_INLINE void koksma__keys_of_word(uint32_t word, uint32_t m, koksma_keys *keys)
{
    const uint32_t digits = (1u << KOKSMA_KEYS_DIGITS) - 1;
    keys->flips[0] = (word & digits) << m;
    keys->flips[1] = (word >> KOKSMA_KEYS_DIGITS & digits) << m;
    keys->mask = (1u << (KOKSMA_KEYS_DIGITS + m)) - 1;
    keys->strata = (1u << m) - 1;
    keys->coarse = keys->strata & 15;
    keys->finer = 0;
    keys->pairing = koksma_seed_of(0x70616972u, word >> 2 * KOKSMA_KEYS_DIGITS & digits);
    keys->rank = word >> 3 * KOKSMA_KEYS_DIGITS;
}

/* Computes the sample of the shared sequence at an index, with the keys of a pixel, as 32-bit fractions. */
KOKSMA_INLINE void koksma__keyed(const koksma_keys *keys, uint32_t index, uint32_t words[2])
{
    const uint32_t y = koksma_pascal(index);
    uint32_t v[2];
    int k;
    v[0] = koksma_owen_hash(index, keys->sequence[0]);
    v[1] =
        koksma_owen_hash((koksma_owen_hash(y, keys->pairing) & keys->coarse) |
                             (koksma_owen_hash(y, keys->finer) & keys->strata & ~keys->coarse) | (y & ~keys->strata),
                         keys->sequence[1]);
    for (k = 0; k < 2; k++) {
        words[k] = koksma_mirror(((v[k] ^ keys->flips[k]) & keys->mask) |
                                 (koksma_owen_hash(v[k], keys->below[k]) & ~keys->mask));
    }
}

/* Returns the index at place i of an order that keeps each of the sets 0 .. 2^m - 1: the samples 2^m .. 2^(m+1) - 1 are
   shuffled, by Owen hashing, so that aligned blocks remain aligned blocks. */
KOKSMA_INLINE uint32_t koksma__shuffled_by_octaves(uint32_t i, uint32_t order)
{
    uint32_t m = 0;
    while (i >> m > 1) {
        m++;
    }
    if (m == 0) {
        return i;
    }
    return 1u << m | koksma_shuffled(i << (32 - m), order + m * 0x9e3779b9u) >> (32 - m);
}

/* Returns word i of a table: 0 is the key of the sequence that all its pixels share, 1 + p that of pixel p of the tile. */
KOKSMA_INLINE uint32_t koksma__keys_word(int table, uint32_t i)
{
    static const uint32_t words[3][1 + 64 * 64] = {
#include <koksma/keys.def>
    };
    return words[table][i];
}

/* Returns the table for a number of samples a pixel, that of the smallest number which is not below it or the last, and m. */
KOKSMA_INLINE int koksma__keys_table(uint32_t spp, uint32_t *m)
{
    const int table = spp <= 1 ? 0 : spp <= 4 ? 1 : 2;
    *m = 2 * (uint32_t)table;
    while (spp > 16 && !(spp & (spp - 1)) && *m < 16 && spp >> *m > 1) {
        ++*m;
    }
    return table;
}

/* Returns the keys of pixel (x, y) of the image with this seed, for one pair of dimensions.
     pair  below KOKSMA_KEYS_PAIRS
     spp   samples a pixel in the end; they may be drawn in parts, but all with the same spp. If it isn't known, say 16. */
KOKSMA_INLINE koksma_keys koksma_keys_of(uint64_t seed, uint32_t x, uint32_t y, uint32_t pair, uint32_t spp)
{
    uint32_t m;
    const int table = koksma__keys_table(spp, &m);
    const uint64_t pixel = koksma__derived(koksma_domain_of_pixel(seed, x, y).key, 0x38d01377u, pair);
    const uint64_t moved = koksma_mix(koksma__derived(seed, 0xbe5466cfu, 0));
    const uint32_t size = KOKSMA_KEYS_SIZE;
    const uint32_t u = (x + (uint32_t)moved + 19 * pair) % size, v = (y + (uint32_t)(moved >> 32) + 43 * pair) % size;
    const uint32_t word = koksma__keys_word(table, 1 + v * size + u);
    const koksma_domain base = {koksma__keys_word(table, 0)};
    koksma_keys keys;
    int k;
    KOKSMA_ASSERT(pair < KOKSMA_KEYS_PAIRS);
    for (k = 0; k < 2; k++) {
        keys.sequence[k] = koksma_seed_of(base.key, (uint32_t)k);
        keys.below[k] = koksma_seed_of(pixel, (uint32_t)k);
    }
    koksma__keys_of_word(word, m, &keys);
    keys.finer = koksma_seed_of(pixel, 2);
    keys.order = koksma_seed_of_order(pixel);
    keys.ordered = pair > 0;
    return keys;
}

/* Computes sample i of a pixel and pair, in [0,1)^2. The points are those of the pattern `ranking-keys`. */
KOKSMA_INLINE void koksma_keys_2d(const koksma_keys *keys, uint32_t i, double xy[2])
{
    const uint32_t place = keys->ordered ? koksma__shuffled_by_octaves(i, keys->order) : i;
    uint32_t words[2];
    koksma__keyed(keys, place ^ keys->rank, words);
    xy[0] = koksma_fraction(words[0]);
    xy[1] = koksma_fraction(words[1]);
}

/* The same as floats: the doubles rounded down to multiples of 2^-24. */
KOKSMA_INLINE void koksma_keys_2f(const koksma_keys *keys, uint32_t i, float xy[2])
{
    double exact[2];
    koksma_keys_2d(keys, i, exact);
    xy[0] = koksma_to_float(exact[0]);
    xy[1] = koksma_to_float(exact[1]);
}

#endif
