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
 * What couples two pairs is white. koksma_keys_4d covers four dimensions by one key, with tables of its own and the first
 * four dimensions of one Owen-scrambled Sobol' sequence:
 *
 *     const koksma_keys pixel = koksma_keys_of_4d(seed, x, y, quadruple, spp);
 *     double xs[4];
 *     koksma_keys_4d(&pixel, i, xs);
 *
 * With 1, 3 or 4 samples a pixel the image is a tile that repeats, of 32 x 32 pixels or, with one sample, 64 x 64. Its
 * points, one in each of 8^4 boxes, are moved by random digits of the cell within their boxes in place of Owen
 * scrambling, which would scatter neighbours; a symmetry of the square and a mirroring of the boxes are those of the
 * image, so that cells fit together. Each sample of a pixel is uniform, but three or four are no longer Owen's: they are
 * in different quarters of every coordinate, the first two in different halves, and the mean square error of a single
 * function may be a quarter more or less than with Owen scrambling; the mean over functions is a little less.
 *
 * Errors are blue whatever the four couple; one coordinate alone is less so than with pairs, and of the pairs of
 * coordinates within a quadruple only the first has (0,m,2)-nets, except in tiles. docs/findings/screen-noise.md
 * has both beside each other. Orders of samples are as with pairs; so are seeds, distributions and cells of 2 and of
 * more than 4 samples.
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

enum { KOKSMA_KEYS_SIZE = 32, KOKSMA_KEYS_SINGLE_SIZE = 64, KOKSMA_KEYS_TABLES = 7 };

/* The key and the scrambling of one pixel and pair or quadruple of dimensions. Compute them once for all samples. */
typedef struct koksma_keys {
    uint32_t seeds[4]; /* seeds of the scrambling of the coordinates, equal in all pixels of a cell; pairs use two */
    uint32_t key;      /* index of sample 0 in the sequence: the pixel's key XOR a random word of the cell */
    uint32_t order;    /* seed of the order of samples 2^k .. 2^(k+1) - 1, used if ordered is 1 */
    uint32_t ordered;
    uint32_t tile; /* of quadruples in a tile: 1 or 4 samples a pixel; the key is of the tile, seeds are digits */
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

/* Return the key of a pixel of a cell, 32 v + u, for 2^m samples per pixel; m < KOKSMA_KEYS_TABLES. */
KOKSMA_INLINE uint32_t koksma__key(uint32_t m, uint32_t pixel)
{
    static const uint16_t keys[KOKSMA_KEYS_TABLES][32 * 32] = {
#include <koksma/keys.def>
    };
    return keys[m][pixel];
}

KOKSMA_INLINE uint32_t koksma__key_4d(uint32_t m, uint32_t pixel) /* m = 1 or > 2 */
{
    static const uint16_t keys[KOKSMA_KEYS_TABLES - 2][32 * 32] = {
#include <koksma/keys_4d.def>
    };
    return keys[m > 1 ? m - 2 : 0][pixel];
}

/* Returns the index in the sequence of a sample of the tile with 1 or 4 samples a pixel. */
KOKSMA_INLINE uint32_t koksma__key_of_tile(uint32_t tile, uint32_t sample)
{
    static const uint16_t keys[2 * 4096] = {
#include <koksma/keys_4d_four.def>
#include <koksma/keys_4d_single.def>
    };
    return keys[(tile > 1 ? 0 : 4096) + (sample & 4095)];
}

/* Returns the key of a pixel and its scrambling for `group`, the number of a pair (dims = 2) or quadruple (dims = 4). */
KOKSMA_INLINE koksma_keys koksma__keys_of(uint64_t seed, uint32_t x, uint32_t y, uint32_t group, uint32_t spp,
                                          uint32_t dims)
{
    const uint64_t image = koksma__derived(seed, dims == 2 ? 0xbe5466cfu : 0x34e90c6cu, group);
    const uint64_t offset = koksma_mix(image);
    const uint32_t tile = dims == 2 || spp == 2 || spp > 4 ? 0 : spp == 1 ? 1 : 4;
    const uint32_t size = tile == 1 ? KOKSMA_KEYS_SINGLE_SIZE : KOKSMA_KEYS_SIZE;
    const uint32_t last = size - 1, largest = KOKSMA_KEYS_TABLES - 1;
    const uint32_t column = x + ((uint32_t)offset & last), row = y + ((uint32_t)(offset >> 32) & last);
    const uint64_t cell = koksma_domain_of_pixel(image, column / size, row / size).key;
    const uint64_t pixel = koksma__derived(koksma_domain_of_pixel(image, column, row).key, 0x38d01377u, 0);
    const uint32_t symmetry = koksma_seed_of(tile ? image : cell, 2);
    const uint32_t u = (column & last) ^ (symmetry & 1 ? last : 0), v = (row & last) ^ (symmetry & 2 ? last : 0);
    const uint32_t place = symmetry & 4 ? u * size + v : v * size + u;
    uint32_t m = 0, lower, key, k;
    koksma_keys keys;
    KOKSMA_ASSERT(spp >= 1 && spp <= 1u << 22);
    while (m < 22 && 1u << m < spp) {
        m++;
    }
    lower = m > largest ? m - largest : 0;
    key = tile        ? place * tile + (symmetry >> 7 & (tile - 1)) /* any sample of the pixel may be the first */
          : dims == 2 ? koksma__key(m - lower, place)
                      : koksma__key_4d(m - lower, place);
    keys.seeds[0] = koksma_seed_of(cell, 0);
    keys.seeds[1] = koksma_seed_of(cell, 1);
    keys.seeds[2] = dims == 2 ? 0 : koksma_seed_of(cell, 4);
    keys.seeds[3] = dims == 2 ? 0 : koksma_seed_of(cell, 5);
    keys.key = (key << lower | (koksma_seed_of(pixel, 0) & ((1u << lower) - 1))) ^
               koksma_seed_of(cell, 3); /* indices whose bits are mostly 0 would have few different scramblings */
    keys.order = koksma_seed_of_order(pixel);
    keys.ordered = group > 0;
    keys.tile = tile;
    if (tile) {
        keys.key = key;
        for (k = 0; k < 4; k++) { /* 29 digits of the cell; three of the image, which mirror the boxes or not */
            keys.seeds[k] = keys.seeds[k] >> 3 | (0u - (symmetry >> (3 + k) & 1)) << 29;
        }
    }
    return keys;
}

/* Returns the key of pixel (x, y) of the image with this seed, and its scrambling, for one pair of dimensions.
     pair  number of the pair of dimensions
     spp   final number of samples per pixel, 1 .. 2^22; use the same spp if you draw them in several passes. If the
           final number is unknown, give the largest possible one: the errors of the first n >= spp / 64 samples are
           then also blue noise, but less so. Samples whose index is at least spp, rounded up to a power of two, repeat
           those of other pixels. */
KOKSMA_INLINE koksma_keys koksma_keys_of(uint64_t seed, uint32_t x, uint32_t y, uint32_t pair, uint32_t spp)
{
    return koksma__keys_of(seed, x, y, pair, spp, 2);
}

/* The same for one quadruple of dimensions, with keys of their own: for koksma_keys_4d. */
KOKSMA_INLINE koksma_keys koksma_keys_of_4d(uint64_t seed, uint32_t x, uint32_t y, uint32_t quadruple, uint32_t spp)
{
    return koksma__keys_of(seed, x, y, quadruple, spp, 4);
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

/* Returns the index in the sequence of sample i of a pixel; of a tile, its number in the tile. */
KOKSMA_INLINE uint32_t koksma__keys_index(const koksma_keys *keys, uint32_t i)
{
    return keys->key ^ (keys->ordered ? koksma__shuffled_by_octaves(i, keys->order) : i);
}

/* Returns sample i of a pixel and pair of dimensions as 32-bit fractions, which are the first two of the four
   words. */
KOKSMA_INLINE koksma__four koksma__keys_four(const koksma_keys *keys, uint32_t i)
{
    const uint32_t index = koksma__keys_index(keys, i);
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

/* Computes a point of the first four dimensions of the sequence of Joe & Kuo (2008), bits in reverse order. Row b of the
   table is the product of 2^b with the matrices of dimensions 3 and 4. */
KOKSMA_INLINE void koksma__sobol_quadruple(uint32_t index, uint32_t words[4])
{
    static const uint32_t matrices[32][2] = {
        {0x00000001u, 0x00000001u}, {0x00000003u, 0x00000003u}, {0x00000006u, 0x00000004u},
        {0x00000009u, 0x0000000au}, {0x00000017u, 0x0000001fu}, {0x0000003au, 0x0000002eu},
        {0x00000071u, 0x00000045u}, {0x000000a3u, 0x000000c9u}, {0x00000116u, 0x0000011bu},
        {0x00000339u, 0x000002a4u}, {0x00000677u, 0x0000079au}, {0x000009aau, 0x00000b67u},
        {0x00001601u, 0x0000101eu}, {0x00003903u, 0x0000302du}, {0x00007706u, 0x00004041u},
        {0x0000aa09u, 0x0000a0c3u}, {0x00010117u, 0x0001f104u}, {0x0003033au, 0x0002e28au},
        {0x00060671u, 0x000457dfu}, {0x000909a3u, 0x000c9baeu}, {0x00171616u, 0x0011a105u},
        {0x003a3939u, 0x002a7289u}, {0x00717777u, 0x0079e7dbu}, {0x00a3aaaau, 0x00b6dba4u},
        {0x01170001u, 0x0100011au}, {0x033a0003u, 0x030002a7u}, {0x06710006u, 0x0400079eu},
        {0x09a30009u, 0x0a000b6du}, {0x16160017u, 0x1f001001u}, {0x3939003au, 0x2e003003u},
        {0x77770071u, 0x45004004u}, {0xaaaa00a3u, 0xc900a00au}};
    uint32_t b;
    words[0] = index;
    words[1] = koksma_pascal(index);
    words[2] = words[3] = 0;
    for (b = 0; b < 32; b++) {
        const uint32_t mask = 0u - (index >> b & 1u);
        words[2] ^= matrices[b][0] & mask;
        words[3] ^= matrices[b][1] & mask;
    }
}

/* Returns sample i of a pixel and quadruple of dimensions as 32-bit fractions. */
KOKSMA_INLINE koksma__four koksma__keys_quadruple(const koksma_keys *keys, uint32_t i)
{
    const uint32_t index = koksma__keys_index(keys, i);
    uint32_t words[4], k;
    koksma__sobol_quadruple(keys->tile ? koksma__key_of_tile(keys->tile, index) : index, words);
    if (keys->tile) {
        for (k = 0; k < 4; k++) {
            words[k] = koksma_mirror(words[k]) ^ keys->seeds[k];
        }
        return koksma__four_of_words(words);
    }
    return koksma__scramble_four(koksma__four_of_words(words), koksma__four_of_words(keys->seeds));
}

/* Computes sample i of a pixel and quadruple of dimensions, in [0,1)^4, with keys of koksma_keys_of_4d. The points equal
   those of the pattern `ranking-keys:dims=4`. */
KOKSMA_INLINE void koksma_keys_4d(const koksma_keys *keys, uint32_t i, double xs[4])
{
    koksma__to_doubles(koksma__keys_quadruple(keys, i), 4, xs);
}

/* Computes sample i as floats: the doubles of koksma_keys_4d rounded down to multiples of 2^-24. */
KOKSMA_INLINE void koksma_keys_4f(const koksma_keys *keys, uint32_t i, float xs[4])
{
    koksma__to_floats(koksma__keys_quadruple(keys, i), 4, xs);
}

#endif
