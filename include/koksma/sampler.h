/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sampling patterns for renderers, in one header: no library, no allocation, no set-up. C99, C11, C++98 and later,
 * CUDA. Long because a renderer takes this one file and nothing else.
 *
 * A sample is a pure function of a domain and an index: there is no cursor and no count of dimensions. A domain is a
 * 64-bit key. Make one for each pixel, derive one from it for each use of samples (lens, light, direction at bounce 3
 * ...), and ask for sample i of that domain. Draw from a domain with one function only.
 *
 *     const koksma_domain pixel = koksma_domain_of_pixel(seed, x, y);
 *     for (uint32_t i = 0; i < spp; i++) {
 *         double film[2], lens[2];
 *         koksma_sobol_2d(koksma_domain_of_use(pixel, FILM), i, film);
 *         koksma_sobol_2d(koksma_domain_of_use(pixel, LENS), i, lens);
 *         ...
 *
 * Inside a domain samples are evenly spread. An aligned block is the samples a 2^m .. (a + 1) 2^m - 1 for whole
 * numbers a and m, such as the first 2^m. Numbers of samples that are powers of two are the best for all functions
 * but cmj.
 *
 *     koksma_sobol_2d    every aligned block is a (0,m,2)-net in base 2
 *     koksma_sobol_4d    the same in its first two dimensions, which are those of koksma_sobol_2d
 *     koksma_pmj02_2d    every aligned block is a (0,m,2)-net in base 2
 *     koksma_cmj_2d      all columns * rows samples: one in each cell and in each stratum; no promise for fewer
 *     koksma_r_2d        every aligned block is 2^m consecutive points of the R-sequence, shifted on the torus
 *
 * Between domains samples are independent: between two uses (nested ones too), pixels or seeds, and between two
 * functions. Sample i of one domain meets a random sample of the other, so that the mean over N samples of a function
 * of both converges as N^-1/2, as with random numbers. For u of one domain and v of the other, the RMS error of the
 * mean of (u - 1/2)(v - 1/2) is 1 / (12 sqrt(N)) if all are random. Here it is this many times as much, measured at
 * N = 16, 64 ... 4096:
 *
 *     koksma_sobol_2d    1.26; sqrt(49/31) = 1.257 by theory for padding by nested shuffles (Burley 2020)
 *     koksma_sobol_4d    1.26
 *     koksma_pmj02_2d    1.26
 *     koksma_cmj_2d      1.00; 1.03 at N = 16
 *     koksma_r_2d        1.07
 *
 * The order of a domain's samples depends on 32 random bits: with probability 2^-32 two domains have the same order
 * and are then dependent.
 *
 * The points equal those of libkoksma's patterns bit for bit; the seed is the key of the domain:
 *
 *     koksma_sobol_2d    sobol:scramble=hash-owen,shuffle=1
 *     koksma_sobol_4d    sobol:scramble=hash-owen,shuffle=1
 *     koksma_pmj02_2d    pmj02:shuffle=1
 *     koksma_cmj_2d      correlated-multi-jittered:columns=C
 *     koksma_r_2d        r-sequence:shuffle=1,shift=1
 *     koksma_z_rank      z-sampler (the order of the pixels)
 *
 * Coordinates are in [0,1). Cast them with koksma_to_float: (float)0.99999999 is 1.
 *
 * Sources: Philox: Salmon et al. 2011. Owen hashing: Laine & Karras 2011, Burley 2020; constants of Vegdahl 2021.
 * PMJ02 by stochastic generation: Helmer, Christensen & Kensler 2021. Correlated multi-jitter: Kensler 2013.
 * R-sequence: Roberts 2018. Padding by shuffled copies: Burley 2020. Z-order: Ahmed & Wonka 2020.
 */
#ifndef KOKSMA_SAMPLER_H
#define KOKSMA_SAMPLER_H

#include <stdint.h>

#if defined(__CUDACC__)
#define KOKSMA_INLINE static __host__ __device__ inline
#else
#define KOKSMA_INLINE static inline
#endif

/* A stream of samples. Make one with the functions below; equal keys give equal samples. */
typedef struct koksma_domain {
    uint64_t key;
} koksma_domain;

/* ---- Random words: Philox4x32-10 ----------------------------------------------------------------------- */

/* The purpose of a random word: part of the key of its hash, with the same numbers as in libkoksma. */
enum {
    KOKSMA_FOR_DOMAIN = 1,
    KOKSMA_FOR_POINT = 2,
    KOKSMA_FOR_SHUFFLE = 3,
    KOKSMA_FOR_SHIFT = 5,
    KOKSMA_FOR_SCRAMBLE = 6
};

/* Computes four random words: a hash of (key, purpose, index, lane), uniform and independent for different
   arguments. */
KOKSMA_INLINE void koksma_words(uint64_t key, uint32_t purpose, uint64_t index, uint32_t lane, uint32_t words[4])
{
    uint32_t a = (uint32_t)index, b = (uint32_t)(index >> 32), c = lane, d = purpose;
    uint32_t k0 = (uint32_t)key, k1 = (uint32_t)(key >> 32);
    int round;
    for (round = 0; round < 10; round++) {
        const uint64_t p = (uint64_t)a * 0xD2511F53u, q = (uint64_t)c * 0xCD9E8D57u;
        a = (uint32_t)(q >> 32) ^ b ^ k0;
        b = (uint32_t)q;
        c = (uint32_t)(p >> 32) ^ d ^ k1;
        d = (uint32_t)p;
        k0 += 0x9E3779B9u;
        k1 += 0xBB67AE85u;
    }
    words[0] = a;
    words[1] = b;
    words[2] = c;
    words[3] = d;
}

/* ---- Domains ------------------------------------------------------------------------------------------- */

/* Returns the domain for one purpose of another domain's samples, such as the lens. Purposes are numbers of your
   choice; domains may be nested to any depth. */
KOKSMA_INLINE koksma_domain koksma_domain_of_use(koksma_domain domain, uint32_t use)
{
    uint32_t w[4];
    koksma_domain sub;
    koksma_words(domain.key, KOKSMA_FOR_DOMAIN, use, 0x75736500u, w);
    sub.key = (uint64_t)w[1] << 32 | w[0];
    return sub;
}

/* Returns the domain of pixel (x, y) of the image with this seed. */
KOKSMA_INLINE koksma_domain koksma_domain_of_pixel(uint64_t seed, uint32_t x, uint32_t y)
{
    uint32_t w[4];
    koksma_domain pixel;
    koksma_words(seed, KOKSMA_FOR_DOMAIN, (uint64_t)y << 32 | x, 0x70697865u, w);
    pixel.key = (uint64_t)w[1] << 32 | w[0];
    return pixel;
}

/* ---- Numbers ------------------------------------------------------------------------------------------- */

/* Rounds x in [0,1) down to a multiple of 2^-24, so that the float is never 1. */
KOKSMA_INLINE float koksma_to_float(double x)
{
    return (float)(uint32_t)(x * 16777216.0) * (1.0f / 16777216.0f);
}

/* Returns the upper 53 bits of two random words as a double in [0,1). */
KOKSMA_INLINE double koksma_to_unit(uint32_t high, uint32_t low)
{
    return (double)((uint64_t)high << 21 | low >> 11) * (1.0 / 9007199254740992.0);
}

/* Reverses the order of the bits. */
KOKSMA_INLINE uint32_t koksma_mirror(uint32_t x)
{
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    return x << 16 | x >> 16;
}

/* Does the same, written such that gcc recognises no byte swap: for that it would peel the first iteration of a loop
   over i, and then not vectorise the others. */
KOKSMA_INLINE uint32_t koksma_mirror_index(uint32_t i)
{
    i = (i & 0x00ff00ffu) << 8 | (i >> 8 & 0x00ff00ffu);
    i = (i & 0x55555555u) << 1 | (i >> 1 & 0x55555555u);
    i = (i & 0x33333333u) << 2 | (i >> 2 & 0x33333333u);
    i = (i & 0x0f0f0f0fu) << 4 | (i >> 4 & 0x0f0f0f0fu);
    return i << 16 | i >> 16;
}

/* Returns Owen's nested uniform scrambling of x, whose bits are reversed: a hash of the bits below decides whether
   to flip each bit. */
KOKSMA_INLINE uint32_t koksma_owen_hash(uint32_t x, uint32_t seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/* ---- The order of the samples of a domain -------------------------------------------------------------- */

/* Returns the random word that chooses the order of samples 2^32 part .. 2^32 (part + 1) - 1. */
KOKSMA_INLINE uint32_t koksma_order(uint64_t key, uint32_t part)
{
    uint32_t w[4];
    koksma_words(key, KOKSMA_FOR_SHUFFLE, part, 0x6f726465u, w);
    return w[0];
}

/* Returns the index at position i of the order that a random word chooses: the nested uniform shuffle of all 32-bit
   indices by Owen hashing. Aligned blocks of 2^m indices become aligned blocks of 2^m indices. */
KOKSMA_INLINE uint32_t koksma_shuffled(uint32_t i, uint32_t order)
{
    return koksma_mirror(koksma_owen_hash(koksma_mirror_index(i), order));
}

/* Does the same, followed by an XOR that maps 0 to 0, so that indices below 2^m stay below 2^m. In an Owen-scrambled
   digital sequence the XOR changes no probability: it is a digital shift of the points. */
KOKSMA_INLINE uint32_t koksma_shuffled_from_0(uint32_t i, uint32_t order)
{
    return koksma_mirror(koksma_owen_hash(koksma_mirror_index(i), order) ^ koksma_owen_hash(0, order));
}

/* ---- Sobol', Owen-scrambled by hashing, in shuffled order ---------------------------------------------- */

/* Multiplies i by the upper triangular Pascal matrix modulo 2: dimension 2 of Sobol' with bits reversed. */
KOKSMA_INLINE uint32_t koksma_pascal(uint32_t i)
{
    i ^= (i & 0xaaaaaaaau) >> 1;
    i ^= (i & 0xccccccccu) >> 2;
    i ^= (i & 0xf0f0f0f0u) >> 4;
    i ^= (i & 0xff00ff00u) >> 8;
    return i ^ (i & 0xffff0000u) >> 16;
}

/* Returns Sobol' dimension 3 (dimension = 0) or 4 (1) of Joe & Kuo at i, with bits reversed. */
KOKSMA_INLINE uint32_t koksma_sobol_mirrored(uint32_t i, int dimension)
{
    static const uint32_t columns[2][32] = {
        {0x00000001u, 0x00000003u, 0x00000006u, 0x00000009u, 0x00000017u, 0x0000003au, 0x00000071u, 0x000000a3u,
         0x00000116u, 0x00000339u, 0x00000677u, 0x000009aau, 0x00001601u, 0x00003903u, 0x00007706u, 0x0000aa09u,
         0x00010117u, 0x0003033au, 0x00060671u, 0x000909a3u, 0x00171616u, 0x003a3939u, 0x00717777u, 0x00a3aaaau,
         0x01170001u, 0x033a0003u, 0x06710006u, 0x09a30009u, 0x16160017u, 0x3939003au, 0x77770071u, 0xaaaa00a3u},
        {0x00000001u, 0x00000003u, 0x00000004u, 0x0000000au, 0x0000001fu, 0x0000002eu, 0x00000045u, 0x000000c9u,
         0x0000011bu, 0x000002a4u, 0x0000079au, 0x00000b67u, 0x0000101eu, 0x0000302du, 0x00004041u, 0x0000a0c3u,
         0x0001f104u, 0x0002e28au, 0x000457dfu, 0x000c9baeu, 0x0011a105u, 0x002a7289u, 0x0079e7dbu, 0x00b6dba4u,
         0x0100011au, 0x030002a7u, 0x0400079eu, 0x0a000b6du, 0x1f001001u, 0x2e003003u, 0x45004004u, 0xc900a00au}};
    uint32_t x = 0;
    int b;
    for (b = 0; b < 32; b++) {
        x ^= columns[dimension][b] & (0u - (i >> b & 1u));
    }
    return x;
}

/* Returns x 2^-32, exact. It goes through a signed number because compilers vectorise that conversion. */
KOKSMA_INLINE double koksma_fraction(uint32_t x)
{
    return ((double)(int32_t)(x ^ 0x80000000u) + 2147483648.0) * (1.0 / 4294967296.0);
}

/* Scrambles a number with bits reversed and returns it as a fraction in [0,1). */
KOKSMA_INLINE double koksma_scrambled(uint32_t mirrored, uint32_t seed)
{
    return koksma_fraction(koksma_mirror(koksma_owen_hash(mirrored, seed)));
}

/* The seeds of a domain's Sobol' sequence: compute them once for a loop over many samples of one domain. */
typedef struct koksma_sobol {
    uint32_t seeds[4], order;
} koksma_sobol;

/* Computes the seeds of a domain. */
KOKSMA_INLINE koksma_sobol koksma_sobol_of(koksma_domain domain)
{
    koksma_sobol sequence;
    uint32_t w[4];
    koksma_words(domain.key, KOKSMA_FOR_SCRAMBLE, 1, 0, w);
    sequence.seeds[3] = w[0];
    koksma_words(domain.key, KOKSMA_FOR_SCRAMBLE, 0, 0, w);
    sequence.seeds[0] = w[0];
    sequence.seeds[1] = w[1];
    sequence.seeds[2] = w[2];
    sequence.order = w[3];
    return sequence;
}

/* Computes sample i of a (0,2)-sequence in base 2: every aligned block of 2^m samples is a (0,m,2)-net. */
KOKSMA_INLINE void koksma_sobol_at_2d(const koksma_sobol *sequence, uint32_t i, double xy[2])
{
    const uint32_t j = koksma_shuffled(i, sequence->order);
    xy[0] = koksma_scrambled(j, sequence->seeds[0]);
    xy[1] = koksma_scrambled(koksma_pascal(j), sequence->seeds[1]);
}

/* Computes sample i in four dimensions; the first two are those of koksma_sobol_at_2d. */
KOKSMA_INLINE void koksma_sobol_at_4d(const koksma_sobol *sequence, uint32_t i, double xs[4])
{
    const uint32_t j = koksma_shuffled(i, sequence->order);
    xs[0] = koksma_scrambled(j, sequence->seeds[0]);
    xs[1] = koksma_scrambled(koksma_pascal(j), sequence->seeds[1]);
    xs[2] = koksma_scrambled(koksma_sobol_mirrored(j, 0), sequence->seeds[2]);
    xs[3] = koksma_scrambled(koksma_sobol_mirrored(j, 1), sequence->seeds[3]);
}

/* Computes sample i of a domain in two dimensions, or in four. For many samples, koksma_sobol_at_2d is faster. */
KOKSMA_INLINE void koksma_sobol_2d(koksma_domain domain, uint32_t i, double xy[2])
{
    const koksma_sobol sequence = koksma_sobol_of(domain);
    koksma_sobol_at_2d(&sequence, i, xy);
}

KOKSMA_INLINE void koksma_sobol_4d(koksma_domain domain, uint32_t i, double xs[4])
{
    const koksma_sobol sequence = koksma_sobol_of(domain);
    koksma_sobol_at_4d(&sequence, i, xs);
}

/* ---- Progressive multi-jittered (0,2) ------------------------------------------------------------------ */

/* Returns `partner`: point 2^level + i shares its stratum of width 2^-level in coordinate k with point i ^
   partner. */
KOKSMA_INLINE uint32_t koksma_pmj02_partner(int k, uint32_t level)
{
    static const uint32_t partners[2][32] = {
        {0x0,      0x0,      0x2,       0x6,       0x6,       0xe,       0x36,       0x4e,
         0x16,     0x2e,     0x276,     0x6ce,     0x716,     0xc2e,     0x3076,     0x40ce,
         0x116,    0x22e,    0x20676,   0x60ece,   0x61716,   0xe2c2e,   0x367076,   0x4ec0ce,
         0x170116, 0x2c022e, 0x2700676, 0x6c00ece, 0x7001716, 0xc002c2e, 0x30007076, 0x4000c0ce},
        {0x0,      0x1,       0x3,       0x3,       0x7,       0x1b,       0x27,       0xb,
         0x17,     0x13b,     0x367,     0x38b,     0x617,     0x183b,     0x2067,     0x8b,
         0x117,    0x1033b,   0x30767,   0x30b8b,   0x71617,   0x1b383b,   0x276067,   0xb808b,
         0x160117, 0x138033b, 0x3600767, 0x3800b8b, 0x6001617, 0x1800383b, 0x20006067, 0x808b}};
    return partners[k][level];
}

/* Returns coordinate k (0 or 1) of point i, as a 32-bit fraction, in the order of the pattern pmj02 without shuffle.
   That order is nearly the same for all keys: only koksma_pmj02_2d is independent between domains. Point i lies in
   the empty half of the stratum of an earlier point, whose upper bits come from a still earlier one. */
KOKSMA_INLINE uint32_t koksma_pmj02_fraction(uint64_t key, uint32_t i, int k)
{
    uint32_t fraction = 0, above = 0xffffffffu, w[4];
    for (;;) {
        uint32_t level = 0, own;
        koksma_words(key, KOKSMA_FOR_POINT, i / 4, (uint32_t)k, w);
        if (i == 0) {
            return fraction ^ (w[0] & above);
        }
        while (level < 31 && i >> (level + 1)) {
            level++;
        }
        own = level < 31 ? 0xffffffffu >> (level + 1) : 0;
        fraction ^= w[i % 4] >> level >> 1 & above & own;
        above &= ~own;
        fraction ^= 1u << (31 - level);
        i = (i ^ 1u << level) ^ koksma_pmj02_partner(k, level);
    }
}

/* Computes sample i. Every aligned block of 2^m samples is a (0,m,2)-net in base 2, and the first 2^m are the first
   2^m points of the pattern pmj02 in another order. Costs about one hash for each bit of the shuffled index that is
   1. */
KOKSMA_INLINE void koksma_pmj02_2d(koksma_domain domain, uint32_t i, double xy[2])
{
    const uint32_t j = koksma_shuffled_from_0(i, koksma_order(domain.key, 0));
    xy[0] = koksma_pmj02_fraction(domain.key, j, 0) * (1.0 / 4294967296.0);
    xy[1] = koksma_pmj02_fraction(domain.key, j, 1) * (1.0 / 4294967296.0);
}

/* ---- Correlated multi-jitter --------------------------------------------------------------------------- */

/* Returns element i of a random permutation of 0 .. n-1 that the key chooses; i < n < 2^31. A bijection of the next
   power of two, walked until it falls below n. Over keys it is not quite uniform up to n = 8: for n = 3 .. 8
   positions of two elements are 0.6, 1.6, 1.3, 1.0, 0.4, 0.5 % off (root mean square over the pairs; 7 % at most),
   those of one element 0.4 % with 3, 0.1 % with 5 to 7. From n = 9 on, tests with 4 million keys find no deviation. */
KOKSMA_INLINE uint32_t koksma_permute(uint32_t i, uint32_t n, uint64_t key)
{
    const uint32_t a = (uint32_t)key, b = (uint32_t)(key >> 32);
    uint32_t mask = n - 1, shift = 1;
    mask |= mask >> 1;
    mask |= mask >> 2;
    mask |= mask >> 4;
    mask |= mask >> 8;
    mask |= mask >> 16;
    while (shift < 16 && mask >> (2 * shift)) {
        shift++;
    }
    do {
        int round;
        uint32_t k = a;
        for (round = 0; round < 6; round++) {
            i = (i ^ k) & mask;
            i = i * (2 * (k >> 7) + 0x2c1b3c6du) & mask;
            i ^= i >> shift;
            i = (i + (k >> 16)) & mask;
            i = i * 0x297a2d39u & mask;
            i ^= i >> (shift + 1 < 32 ? shift + 1 : 31);
            k = (k ^ b) * 0x9e3779b1u;
            k ^= k >> 15;
        }
    } while (i >= n);
    return i;
}

/* Returns the position u in [0,1) of cell number `cell` of at most 2^29 `cells`, as a coordinate in [0,1) that
   rounding never moves out of the cell. u / 2^24 is exact, so that compilers that fuse products and sums give the
   same bits. */
KOKSMA_INLINE double koksma_place(double cell, double u, double cells)
{
    return (cell + (u - u * (1.0 / 16777216.0))) / cells;
}

/* Computes sample i of columns * rows: one in each cell of the grid, and one in each of the columns * rows strata of
   either axis. i is below columns * rows <= 2^29. */
KOKSMA_INLINE void koksma_cmj_2d(koksma_domain domain, uint32_t i, uint32_t columns, uint32_t rows, double xy[2])
{
    uint32_t keys[4], more[4], w[4], s, c, r;
    const double cells = (double)columns * (double)rows;
    koksma_words(domain.key, KOKSMA_FOR_SHUFFLE, 0, 0, keys);
    koksma_words(domain.key, KOKSMA_FOR_SHUFFLE, 1, 0, more);
    koksma_words(domain.key, KOKSMA_FOR_POINT, i, 0, w);
    s = koksma_permute(i, columns * rows, (uint64_t)keys[1] << 32 | keys[0]);
    c = s % columns;
    r = s / columns;
    xy[0] = koksma_place((double)c * rows + koksma_permute(r, rows, (uint64_t)keys[3] << 32 | keys[2]),
                         koksma_to_unit(w[0], w[1]), cells);
    xy[1] = koksma_place((double)r * columns + koksma_permute(c, columns, (uint64_t)more[1] << 32 | more[0]),
                         koksma_to_unit(w[2], w[3]), cells);
}

/* ---- R-sequence ---------------------------------------------------------------------------------------- */

/* Computes sample i of the additive recurrence of the plastic number, shifted on the torus by the domain's random
   vector, in an order that the domain chooses. Every aligned block of 2^m samples, m <= 32, is a run of 2^m
   consecutive points. The order is different in each 2^32 samples; i / 2^32 is not shuffled.

   The shuffle costs evenness where N is no power of two: N samples are then several runs, one for each one bit of N,
   with gaps between them. Their RMS L2 star discrepancy is 1.19 times that of one run in the mean over N = 1 to 1024,
   at most 1.64 times (N = 98). Without the shuffle the same coordinate of two domains would differ by a constant,
   whatever N is. */
KOKSMA_INLINE void koksma_r_2d(koksma_domain domain, uint64_t i, double xy[2])
{
    const uint64_t alpha[2] = {(uint64_t)0xC13FA9A9u << 32 | 0x02A6328Fu, (uint64_t)0x91E10DA5u << 32 | 0xC79E7B1Du};
    const uint32_t part = (uint32_t)(i >> 32), order = koksma_order(domain.key, part);
    const uint64_t point = (uint64_t)part << 32 | koksma_shuffled((uint32_t)i, order);
    uint32_t w[4];
    int k;
    koksma_words(domain.key, KOKSMA_FOR_SHIFT, 0, 0, w);
    for (k = 0; k < 2; k++) {
        const uint64_t x = ((uint64_t)1 << 63) + (point + 1) * alpha[k];
        xy[k] = (double)(x >> 11) * (1.0 / 9007199254740992.0) + koksma_to_unit(w[2 * k], w[2 * k + 1]);
        xy[k] -= xy[k] >= 1;
    }
}

/* ---- Z-order ------------------------------------------------------------------------------------------- */

/* Returns element j of the permutation of 0 .. 3 that a random word chooses. */
KOKSMA_INLINE uint32_t koksma_permute4(uint32_t j, uint32_t word)
{
    uint32_t order = 0xe4u, i; /* four fields of two bits */
    for (i = 3; i > 0; i--) {
        const uint32_t other = (word & 0x3ffu) * (i + 1) >> 10;
        const uint32_t difference = (order >> 2 * i ^ order >> 2 * other) & 3u;
        order ^= difference << 2 * i ^ difference << 2 * other;
        word >>= 10;
    }
    return order >> 2 * j & 3u;
}

/* Returns the rank of pixel (x, y) of a square image of 2^levels pixels a side, levels <= 16, along a Z-curve whose
   quadrants are in an order that is random at each node. Give pixel p the samples rank * spp .. rank * spp + spp - 1
   of one sequence over the whole image, as in koksma_sobol_2d with the image's domain: neighbours share well-spread
   samples. The orders of two domains are alike, because both follow a Z-curve: the pixels of a quadrant have
   consecutive ranks in both. The two ranks of one pixel are independent of each other, and so are the samples that
   they index. */
KOKSMA_INLINE uint32_t koksma_z_rank(koksma_domain domain, uint32_t x, uint32_t y, int levels)
{
    uint32_t rank = 0, path = 1;
    int l;
    for (l = levels - 1; l >= 0; l--) {
        const uint32_t quadrant = (y >> l & 1u) << 1 | (x >> l & 1u);
        uint32_t w[4];
        koksma_words(domain.key, KOKSMA_FOR_SHUFFLE, path, (uint32_t)l + 1, w);
        rank = rank << 2 | koksma_permute4(quadrant, w[0]);
        path = path << 2 | quadrant;
    }
    return rank;
}

#endif
