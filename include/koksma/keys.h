/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Blue-noise sampling with ranking and scrambling keys (Heitz & others 2019). All pixels share one Owen-scrambled
 * (0,2)-sequence; the keys of a pixel reorder and scramble it such that the errors of neighbouring pixels cancel.
 * This header needs no library and allocates nothing; koksma/keys.def has tables for tiles of 64 x 64 pixels. The
 * notes on compilers in koksma/sampler.h also hold for this header.
 *
 *     const koksma_keys pixel = koksma_keys_of(seed, x, y, pair, spp);
 *     for (uint32_t i = 0; i < spp; i++) {
 *         double xy[2];
 *         koksma_keys_2d(&pixel, i, xy);
 *
 *     sample i = sequence(i XOR ranking key) XOR scrambling keys
 *
 * There are three tables, for 2^m = 1, 4 and 16 samples per pixel. The two scrambling keys of a pixel flip binary
 * digits of x and y by XOR, equally in all its samples: the 8 digits after the first m, which position the samples
 * within their strata. Later digits are Owen-scrambled independently in each pixel. A pairing key pairs the strata
 * in y with those in x by an Owen scrambling of the first m digits of y. The ranking key decides which part of the
 * sequence comes first, so that the errors are blue noise also for smaller powers of two. More than 16 samples per
 * pixel use the table for 16, and the digits of the pairing after the fourth are then random; for numbers of
 * samples that are powers of two m grows with the number. Aligned blocks of 2^k samples of a pixel are (0,k,2)-nets
 * in base 2, for all k. docs/findings/ranking-keys.md has the measured errors. Steps have no larger ones than in
 * independently scrambled pixels, smooth integrands are up to 20 % worse or better, single ones up to twice as bad;
 * from 64 samples per pixel on their low frequencies can be larger, too.
 *
 * Number the pairs of dimensions 0, 1, 2 ... as you like, below 64: each number shifts the table by a different
 * offset. Errors that come from one pair of dimensions are blue noise, errors from several pairs together are white
 * noise. In each pixel and each pair except pair 0, the samples 2^k .. 2^(k+1) - 1, for each k, are in a different
 * random order. Pairs are therefore independent, with one exception: the first half of one pair's samples meets the
 * first half of another pair's.
 *
 * The tables are fixed and the seed shifts them, so over the seeds a pixel takes the errors of the 4,096 pixels of
 * a tile. The mean of a pixel over all seeds is therefore the mean over a tile, which is not exactly the integral.
 */
#ifndef KOKSMA_KEYS_H
#define KOKSMA_KEYS_H

#include <koksma/sampler.h>

enum { KOKSMA_KEYS_SIZE = 64, KOKSMA_KEYS_DIGITS = 8, KOKSMA_KEYS_PAIRS = 64 };

/* The keys of one pixel and pair of dimensions. Compute them once for all samples. */
typedef struct koksma_keys {
    uint32_t sequence[2]; /* seeds of the sequence that all pixels share */
    uint32_t below[2];    /* seeds that scramble the digits after those that the scrambling keys flip */
    uint32_t flips[2];    /* scrambling keys with bits reversed: bit 0 flips the first digit */
    uint32_t mask;        /* bit mask of the digits that `below` does not scramble */
    uint32_t coarse;      /* bit mask of the first digits, at most 4, which the pairing key scrambles */
    uint32_t strata;      /* bit mask of the first m digits */
    uint32_t pairing;     /* seed of the scrambling of the digits in `coarse`, which pairs strata */
    uint32_t finer;       /* seed of the scrambling of the digits in `strata` that are not in `coarse` */
    uint32_t rank;        /* ranking key */
    uint32_t order;       /* seed of the order of samples 2^k .. 2^(k+1) - 1, used if ordered is 1 */
    uint32_t ordered;
} koksma_keys;

/* Sets the members of `keys` that a word of a table determines. The word has 8 bits that flip digits of x, 8 that
   flip digits of y, 8 of the pairing key, and the ranking key. m is log2 of the number of samples of the table. */
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

/* Computes the point of the shared sequence at an index, scrambled by the keys of a pixel, as 32-bit fractions. */
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

/* Returns index i of a random order that permutes the indices 2^m .. 2^(m+1) - 1 among themselves, for each m. Owen
   hashing shuffles the range, so aligned blocks remain aligned blocks. */
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

/* Returns word i of a table: word 0 is the key of the sequence that all pixels share, word 1 + p has the keys of
   pixel p of the tile. */
KOKSMA_INLINE uint32_t koksma__keys_word(int table, uint32_t i)
{
    static const uint32_t words[3][1 + 64 * 64] = {
#include <koksma/keys.def>
    };
    return words[table][i];
}

/* Returns the table for spp samples per pixel: the one for the smallest number >= spp, or the last table. Sets *m
   to the m of that table, or to log2 spp if spp > 16 is a power of two, at most 16. */
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
     spp   final number of samples per pixel; use the same spp if you draw them in several passes, and 16 if the
           final number is unknown. */
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

/* Computes sample i of a pixel and pair of dimensions, in [0,1)^2. The points equal those of the pattern
   `ranking-keys`. */
KOKSMA_INLINE void koksma_keys_2d(const koksma_keys *keys, uint32_t i, double xy[2])
{
    const uint32_t place = keys->ordered ? koksma__shuffled_by_octaves(i, keys->order) : i;
    uint32_t words[2];
    koksma__keyed(keys, place ^ keys->rank, words);
    xy[0] = koksma_fraction(words[0]);
    xy[1] = koksma_fraction(words[1]);
}

/* Computes sample i as floats: the doubles of koksma_keys_2d rounded down to multiples of 2^-24. */
KOKSMA_INLINE void koksma_keys_2f(const koksma_keys *keys, uint32_t i, float xy[2])
{
    double exact[2];
    koksma_keys_2d(keys, i, exact);
    xy[0] = koksma_to_float(exact[0]);
    xy[1] = koksma_to_float(exact[1]);
}

#endif
