/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Blue-noise sampling with ranking keys (after Heitz & others 2019 and Ahmed & Wonka 2020). The pixels of a cell of
 * 32 x 32 pixels share one Owen-scrambled (0,2)-sequence. The key of a pixel selects its block of the sequence, such
 * that the errors of neighbouring pixels cancel. This header needs no library and allocates nothing; koksma/keys.def
 * has the keys. The notes on compilers in koksma/sampler.h also hold for this header.
 *
 *     const koksma_keys pixel = koksma_keys_of(seed, x, y, pair, spp);
 *     for (uint32_t i = 0; i < spp; i++) {
 *         double xy[2];
 *         koksma_keys_2d(&pixel, i, xy);
 *     }
 *
 *     sample i = scrambled sequence(key XOR i)
 *
 * There are seven tables of keys, for 2^m = 1, 2, 4 ... 64 samples per pixel. A key has two parts. Ten bits are the
 * number of the block, which differs for each of the 1,024 pixels of the cell. The other m bits rank the samples
 * within the block: they decide which part of the block comes first, so that the errors are blue noise also for fewer
 * than 2^m samples. Above 64 samples per pixel m is log2 spp rounded up, and a key is one of the last table followed
 * by m - 6 random bits of the pixel. Each cell draws from the seed its own scrambling and one of the 8 symmetries of
 * the square, so cells do not repeat points.
 *
 * The samples of one pixel have the same probability distribution as those of an independently Owen-scrambled pixel,
 * for each number of samples: the mean of any integrand is unbiased, and its mean square error over the seeds is that
 * of independent pixels. Only the errors of the pixels of one cell depend on each other. Therefore the mean square
 * error of one image varies more from seed to seed than with independent pixels; the difference is smaller in larger
 * images. Low frequencies of the errors have .35 to .58 of the power of white noise in the mean over 28 held-out
 * integrands, less than with koksma_z_rank at 1 to 100 samples per pixel; docs/findings/screen-noise.md has the
 * measured errors.
 *
 * Aligned blocks of 2^k samples of a pixel are (0,k,2)-nets in base 2, for all k. The 2^m samples of the 1,024 pixels
 * of a cell are together a (0,m+10,2)-net.
 *
 * Number the pairs of dimensions 0, 1, 2 ... as you like: each number has its own cells and scramblings. Errors that
 * come from one pair of dimensions are blue noise, errors from several pairs together are white noise. In each pixel
 * and each pair except pair 0, the samples 2^k .. 2^(k+1) - 1, for each k, are in a different random order. Pairs
 * are therefore independent, with one exception: the samples in the first half of one pair are always combined with
 * those in the first half of another pair.
 */
#ifndef KOKSMA_KEYS_H
#define KOKSMA_KEYS_H

#include <koksma/sampler.h>

enum { KOKSMA_KEYS_SIZE = 32, KOKSMA_KEYS_TABLES = 7 };

/* The key and the scrambling of one pixel and pair of dimensions. Compute them once for all samples. */
typedef struct koksma_keys {
    uint32_t seeds[2]; /* seeds of the scrambling of x and of y, equal in all pixels of a cell */
    uint32_t key;      /* index of sample 0 in the sequence: the pixel's key XOR a random word of the cell */
    uint32_t order;    /* seed of the order of samples 2^k .. 2^(k+1) - 1, used if ordered is 1 */
    uint32_t ordered;
} koksma_keys;

/* Returns index i of a random order that permutes the indices 2^m .. 2^(m+1) - 1 among themselves, for each m. Owen
   hashing shuffles the range, so aligned blocks remain aligned blocks. */
KOKSMA_INLINE uint32_t koksma__shuffled_by_octaves(uint32_t i, uint32_t order)
{
    uint32_t m = 0;
    if (i < 2) {
        return i;
    }
#if defined(__GNUC__) && !defined(__CUDACC__)
    m = 31u - (uint32_t)__builtin_clz(i);
#else
    while (i >> m > 1) {
        m++;
    }
#endif
    return 1u << m | koksma_shuffled(i << (32 - m), order + m * 0x9e3779b9u) >> (32 - m);
}

/* Returns the key of a pixel of a cell, 32 v + u, for 2^m samples per pixel; m < KOKSMA_KEYS_TABLES. */
KOKSMA_INLINE uint32_t koksma__key(uint32_t m, uint32_t pixel)
{
    static const uint16_t keys[KOKSMA_KEYS_TABLES][32 * 32] = {
#include <koksma/keys.def>
    };
    return keys[m][pixel];
}

/* Returns the key of pixel (x, y) of the image with this seed, and its scrambling, for one pair of dimensions.
     pair  number of the pair of dimensions
     spp   final number of samples per pixel, 1 .. 2^22; use the same spp if you draw them in several passes. If the
           final number is unknown, give the largest possible one: the errors of the first n >= spp / 64 samples are
           then also blue noise, but less so. Samples whose index is at least spp, rounded up to a power of two, repeat
           those of other pixels. */
KOKSMA_INLINE koksma_keys koksma_keys_of(uint64_t seed, uint32_t x, uint32_t y, uint32_t pair, uint32_t spp)
{
    const uint64_t image = koksma__derived(seed, 0xbe5466cfu, pair), offset = koksma_mix(image);
    const uint32_t last = KOKSMA_KEYS_SIZE - 1, largest = KOKSMA_KEYS_TABLES - 1;
    const uint32_t column = x + ((uint32_t)offset & last), row = y + ((uint32_t)(offset >> 32) & last);
    const uint64_t cell = koksma_domain_of_pixel(image, column / KOKSMA_KEYS_SIZE, row / KOKSMA_KEYS_SIZE).key;
    const uint64_t pixel = koksma__derived(koksma_domain_of_pixel(image, column, row).key, 0x38d01377u, 0);
    const uint32_t symmetry = koksma_seed_of(cell, 2);
    const uint32_t u = (column & last) ^ (symmetry & 1 ? last : 0), v = (row & last) ^ (symmetry & 2 ? last : 0);
    const uint32_t place = symmetry & 4 ? u * KOKSMA_KEYS_SIZE + v : v * KOKSMA_KEYS_SIZE + u;
    uint32_t m = 0, lower;
    koksma_keys keys;
    KOKSMA_ASSERT(spp >= 1 && spp <= 1u << 22);
    while (m < 22 && 1u << m < spp) {
        m++;
    }
    lower = m > largest ? m - largest : 0;
    keys.seeds[0] = koksma_seed_of(cell, 0);
    keys.seeds[1] = koksma_seed_of(cell, 1);
    keys.key = (koksma__key(m - lower, place) << lower | (koksma_seed_of(pixel, 0) & ((1u << lower) - 1))) ^
               koksma_seed_of(cell, 3); /* indices whose bits are mostly 0 would have few different scramblings */
    keys.order = koksma_seed_of_order(pixel);
    keys.ordered = pair > 0;
    return keys;
}

/* Returns four words: a, b, 0 and 0. */
KOKSMA_INLINE koksma__four koksma__two_words(uint32_t a, uint32_t b)
{
#if defined(KOKSMA_VECTOR)
    const koksma__four x = {a, b, 0, 0};
#else
    const koksma__four x = {{a, b, 0, 0}};
#endif
    return x;
}

/* Returns sample i of a pixel and pair of dimensions as 32-bit fractions, which are the first two of the four
   words. */
KOKSMA_INLINE koksma__four koksma__keys_four(const koksma_keys *keys, uint32_t i)
{
    const uint32_t index = keys->key ^ (keys->ordered ? koksma__shuffled_by_octaves(i, keys->order) : i);
    return koksma__scramble_four(koksma__two_words(index, koksma_pascal(index)),
                                 koksma__two_words(keys->seeds[0], keys->seeds[1]));
}

/* Computes sample i of a pixel and pair of dimensions, in [0,1)^2. The points equal those of the pattern
   `ranking-keys`. */
KOKSMA_INLINE void koksma_keys_2d(const koksma_keys *keys, uint32_t i, double xy[2])
{
    koksma__to_doubles(koksma__keys_four(keys, i), 2, xy);
}

/* Computes sample i as floats: the doubles of koksma_keys_2d rounded down to multiples of 2^-24. */
KOKSMA_INLINE void koksma_keys_2f(const koksma_keys *keys, uint32_t i, float xy[2])
{
    koksma__to_floats(koksma__keys_four(keys, i), 2, xy);
}

#endif
