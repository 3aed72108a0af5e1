/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sampling patterns for renderers, in one header: no library, no allocation, no set-up. C99, C11, C++98 and later,
 * CUDA. The header is long because a renderer needs no other file.
 *
 * A sample depends only on a domain and an index; the sampler has no state and counts no dimensions. A domain is a
 * 64-bit key. Make a domain for each pixel, derive from it a domain for each use of samples (lens, light, direction
 * at bounce 3 ...), and compute sample i of the derived domain. Draw from each domain with only one of the
 * functions.
 *
 *     const koksma_domain pixel = koksma_domain_of_pixel(seed, x, y);
 *     for (uint32_t i = 0; i < spp; i++) {
 *         double film[2], lens[2];
 *         koksma_sobol_2d(koksma_domain_of_use(pixel, FILM), i, film);
 *         koksma_sobol_2d(koksma_domain_of_use(pixel, LENS), i, lens);
 *         ...
 *
 * Within a domain the samples are evenly distributed. An aligned block consists of samples a 2^m .. (a + 1) 2^m - 1
 * for whole numbers a and m, such as the first 2^m samples. For all functions but koksma_cmj_2d numbers of samples
 * that are powers of two work best.
 *
 *     koksma_sobol_2d    every aligned block is a (0,m,2)-net in base 2
 *     koksma_sobol_4d    its first two dimensions equal koksma_sobol_2d; its first dimension is koksma_sobol_1d, its
 *                        first three are koksma_sobol_3d
 *     koksma_pmj02_2d    every aligned block is a (0,m,2)-net in base 2
 *     koksma_cmj_2d      all columns * rows samples together have one sample in each cell of the grid and in each
 *                        stratum of each axis; fewer samples have no guarantee
 *     koksma_r_2d        every aligned block is 2^m consecutive points of the R-sequence, shifted on the torus
 *     koksma_white_4d    independent random numbers without stratification
 *
 * Samples of different domains are independent: between two uses (also nested uses), pixels or seeds, and between
 * two functions. Sample i of one domain is paired with a random sample of the other domain, so the mean over N
 * samples of a function of both converges as N^-1/2, as with random numbers. For u of one domain and v of another,
 * the RMS error of the mean of (u - 1/2)(v - 1/2) is 1 / (12 sqrt(N)) with random numbers. The table has the RMS
 * error of each function divided by this value, measured at N = 16, 64 ... 4096:
 *
 *     koksma_sobol_2d    1.26; sqrt(49/31) = 1.257 by theory for padding by nested shuffles (Burley 2020)
 *     koksma_sobol_4d    1.26
 *     koksma_pmj02_2d    1.26
 *     koksma_cmj_2d      1.00; 1.03 at N = 16
 *     koksma_r_2d        1.07
 *     koksma_white_4d    1.00
 *
 * The order of a domain's samples depends on 32 random bits: with probability 2^-32 two domains have the same order
 * and are then dependent. The points of koksma_sobol_2d and koksma_pmj02_2d have the same probability distribution
 * but different values.
 *
 * The points equal those of the following patterns of libkoksma bit for bit, with the key of the domain as seed (hash-owen
 * hashes where scramble=owen permutes; both are nets):
 *
 *     koksma_sobol_2d    sobol:scramble=hash-owen,shuffle=1
 *     koksma_sobol_4d    sobol:scramble=hash-owen,shuffle=1
 *     koksma_pmj02_2d    pmj02:shuffle=1
 *     koksma_cmj_2d      correlated-multi-jittered:columns=C
 *     koksma_r_2d        r-sequence:shuffle=1,shift=1
 *     koksma_z_rank      z-sampler (the order of the pixels)
 *
 * Options that let a compiler change floating-point arithmetic, such as -ffast-math, change the last bits of
 * koksma_cmj_2d and may round a coordinate up to 1.
 *
 * These functions do not check their arguments: pointers must not be NULL, and arguments must be in the ranges that
 * the comments give. To check the ranges define KOKSMA_ASSERT(condition) as assert(condition) before you include
 * the header.
 *
 * Coordinates are in [0,1). Draw floats with koksma_sobol_2f and similar functions, or convert doubles with
 * koksma_to_float, because (float)0.99999999 is 1. `docs/put-it-into-your-renderer.md` has examples.
 *
 * Sources: Philox: Salmon et al. 2011. Owen hashing: Laine & Karras 2011, Burley 2020; constants of Vegdahl 2021.
 * Seeds: constants of Wellons 2018 and of Degski's hash. PMJ02 by matrices: Helmer, Christensen & Kensler 2021.
 * Correlated multi-jitter: Kensler 2013. R-sequence: Roberts 2018. Padding by shuffled copies: Burley 2020.
 * Z-order: Ahmed & Wonka 2020.
 */
#ifndef KOKSMA_SAMPLER_H
#define KOKSMA_SAMPLER_H

#include <stdint.h>

#if defined(__GNUC__) && defined(__cplusplus) /* this is C, whose casts are old-style ones */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#endif

#if defined(__CUDACC__)
#define KOKSMA_INLINE static __host__ __device__ inline
#else
#define KOKSMA_INLINE static inline
#endif

/* The size of an array that a function fills: C compilers then warn about a shorter one (C99 6.7.5.3). */
#if defined(__cplusplus) || defined(_MSC_VER)
#define KOKSMA__N(n) n
#else
#define KOKSMA__N(n) static n
#endif

#if !defined(KOKSMA_ASSERT)
#define KOKSMA_ASSERT(condition) ((void)0)
#endif

/* A domain: a stream of samples. Make domains with the functions below; equal keys give equal samples. */
typedef struct koksma_domain {
    uint64_t key;
} koksma_domain;

/* ---- Random words: Philox4x32-10 ----------------------------------------------------------------------- */

/* The purposes of random words, which enter their hash. libkoksma uses the same numbers. */
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

/* Returns a hash of a key: one round of multiplying and folding, which is a bijection. Two rounds turn keys that
   differ in few bits into unrelated keys: deriving a domain is one round, and each draw begins with another. */
KOKSMA_INLINE uint64_t koksma_mix(uint64_t key)
{
    key *= (uint64_t)0xd6e8feb8u << 32 | 0x6659fd93u;
    return key ^ key >> 32;
}

/* Returns the key derived from another key by a purpose and a number. The number is multiplied by a constant so
   that small numbers and keys do not collide: number 1 of key 2 differs from number 2 of key 1. */
KOKSMA_INLINE uint64_t koksma__derived(uint64_t key, uint32_t purpose, uint32_t number)
{
    return koksma_mix(key ^ ((uint64_t)purpose << 32 | 0x85a308d3u) ^
                      number * ((uint64_t)0x9e3779b9u << 32 | 0x7f4a7c15u));
}

/* Returns the domain for one use of the samples of another domain, such as the lens. Choose a number for each use;
   domains may be nested to any depth. Two uses of one domain never have the same key. */
KOKSMA_INLINE koksma_domain koksma_domain_of_use(koksma_domain domain, uint32_t use)
{
    koksma_domain sub;
    sub.key = koksma__derived(domain.key, 0x243f6a88u, use);
    return sub;
}

/* Returns the domain of pixel (x, y) of the image with this seed. Two pixels of one image never have the same key. */
KOKSMA_INLINE koksma_domain koksma_domain_of_pixel(uint64_t seed, uint32_t x, uint32_t y)
{
    const uint64_t image = koksma_mix(seed ^ ((uint64_t)0x13198a2eu << 32 | 0x03707344u));
    koksma_domain pixel;
    pixel.key = koksma_mix(koksma_mix(image ^ ((uint64_t)y << 32 | x)));
    return pixel;
}

/* Returns the domain of sample i of another domain, for splitting the sample into a variable number of subsamples,
   such as shadow rays. The subsamples of one sample are evenly distributed and independent of those of other
   samples. If each sample has the same number of subsamples, use koksma_part_of_sample, which distributes all of
   them evenly together. */
KOKSMA_INLINE koksma_domain koksma_domain_of_sample(koksma_domain domain, uint32_t i)
{
    koksma_domain sub;
    sub.key = koksma__derived(domain.key, 0xa4093822u, i);
    return sub;
}

/* Returns the index of part s, 0 .. count - 1, of sample i if each sample is split into `count` parts. If count is
   a power of two, the parts of one sample, and those of an aligned block of samples, are aligned blocks. The
   product (i + 1) * count must be at most 2^32. */
KOKSMA_INLINE uint32_t koksma_part_of_sample(uint32_t i, uint32_t count, uint32_t s)
{
    KOKSMA_ASSERT(s < count && i <= 0xffffffffu / count && i * count <= 0xffffffffu - s);
    return i * count + s;
}

/* Returns the seed of one frame of an animation, for koksma_domain_of_pixel; the samples of different frames are
   independent. To accumulate frames into one image keep the seed instead, and give frame f the samples
   f * spp .. f * spp + spp - 1. */
KOKSMA_INLINE uint64_t koksma_seed_of_frame(uint64_t seed, uint32_t frame)
{
    return koksma_mix(koksma__derived(seed, 0x082efa98u, frame));
}

/* ---- Numbers ------------------------------------------------------------------------------------------- */

/* Converts x in [0,1) to a float rounded down to a multiple of 2^-24, so that the float is never 1. */
KOKSMA_INLINE float koksma_to_float(double x)
{
    KOKSMA_ASSERT(x >= 0 && x < 1);
    return (float)(uint32_t)(x * 16777216.0) * (1.0f / 16777216.0f);
}

/* Returns the upper 53 bits of two random words as a double in [0,1). */
KOKSMA_INLINE double koksma_to_unit(uint32_t high, uint32_t low)
{
    return (double)((uint64_t)high << 21 | low >> 11) * (1.0 / 9007199254740992.0);
}

/* Returns x with its 32 bits in reverse order. */
KOKSMA_INLINE uint32_t koksma_mirror(uint32_t x)
{
#if defined(__CUDA_ARCH__)
    return __brev(x);
#else
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    return x << 16 | x >> 16;
#endif
}

/* ---- Four words at once -------------------------------------------------------------------------------- */

/* The sampling functions compute four coordinates at once: in a vector register if gcc or clang compile for 64-bit
   x86 or ARM, otherwise one after the other with the same bits. Define KOKSMA_PLAIN before you include the header
   to avoid vector registers. */
#if !defined(KOKSMA_PLAIN) && !defined(__CUDACC__) &&                                                                \
    ((defined(__GNUC__) && __GNUC__ >= 9) || defined(__clang__)) &&                                                  \
    (defined(__x86_64__) || (defined(__aarch64__) && !defined(__AARCH64EB__)))
#define KOKSMA_VECTOR
#endif

#if defined(KOKSMA_VECTOR)
typedef uint32_t koksma__four __attribute__((vector_size(16)));
typedef int32_t koksma__four_signed __attribute__((vector_size(16)));
typedef uint64_t koksma__two_long __attribute__((vector_size(16)));
typedef uint32_t koksma__four_in_table __attribute__((vector_size(16), may_alias));
typedef float koksma__four_float __attribute__((vector_size(16)));
typedef double koksma__four_double __attribute__((vector_size(32)));
#if defined(__SSSE3__)
typedef char koksma__bytes __attribute__((vector_size(16)));
#endif
#define KOKSMA_ALIGNED __attribute__((aligned(16)))
#else
#if defined(__CUDACC__)
#define KOKSMA_ALIGNED __align__(16)
#else
#define KOKSMA_ALIGNED
#endif
typedef struct koksma__four {
    uint32_t word[4];
} koksma__four;
#endif

/* Returns Owen's nested uniform scrambling of x, whose bits are in reverse order: whether a bit is flipped depends on
   a hash of all bits below it. */
KOKSMA_INLINE uint32_t koksma_owen_hash(uint32_t x, uint32_t seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/* Returns the seed that chooses the order of a domain's samples. */
KOKSMA_INLINE uint32_t koksma_seed_of_order(uint64_t key)
{
    return (uint32_t)(koksma_mix(koksma_mix(key)) >> 32);
}

/* Returns the seed of dimension 0, 1, 2 ... of a domain: a hash of all bits of the key and of the dimension. */
KOKSMA_INLINE uint32_t koksma_seed_of(uint64_t key, uint32_t dimension)
{
    const uint64_t mixed = koksma_mix(key);
    uint32_t x = (uint32_t)mixed + (dimension + 1) * 0x9e3779b9u;
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x += (uint32_t)(mixed >> 32);
    x *= 0x846ca68bu;
    return x ^ x >> 16;
}

/* Returns the seeds of dimensions 0 to 3 of a domain. */
KOKSMA_INLINE koksma__four koksma__four_seeds(uint64_t key)
{
#if defined(KOKSMA_VECTOR)
    const uint64_t mixed = koksma_mix(key);
    const koksma__four lanes = {0x9e3779b9u, 0x3c6ef372u, 0xdaa66d2bu, 0x78dde6e4u};
    koksma__four x = lanes + (uint32_t)mixed;
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x += (uint32_t)(mixed >> 32);
    x *= 0x846ca68bu;
    return x ^ x >> 16;
#else
    koksma__four x;
    uint32_t k;
    for (k = 0; k < 4; k++) {
        x.word[k] = koksma_seed_of(key, k);
    }
    return x;
#endif
}

#if defined(KOKSMA_VECTOR)
/* Reverses the order of the bits in each of four words: with a byte shuffle and either tables of half bytes (SSSE3)
   or a matrix product (GFNI). */
KOKSMA_INLINE koksma__four koksma__mirror_four(koksma__four x)
{
#if defined(__SSSE3__)
    const koksma__bytes swap = {3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12};
    const koksma__bytes bytes = (koksma__bytes)__builtin_ia32_pshufb128((koksma__bytes)x, swap);
#if defined(__GFNI__)
    const uint64_t rows = (uint64_t)0x80402010u << 32 | 0x08040201u;
    const koksma__two_long matrix = {rows, rows};
    return (koksma__four)__builtin_ia32_vgf2p8affineqb_v16qi(bytes, (koksma__bytes)matrix, 0);
#else
    const koksma__two_long lower = {(uint64_t)0x0e060a02u << 32 | 0x0c040800u,
                                    (uint64_t)0x0f070b03u << 32 | 0x0d050901u};
    const koksma__two_long upper = lower << 4;
    x = (koksma__four)bytes;
    return (koksma__four)__builtin_ia32_pshufb128((koksma__bytes)upper, (koksma__bytes)(x & 0x0f0f0f0fu)) |
           (koksma__four)__builtin_ia32_pshufb128((koksma__bytes)lower, (koksma__bytes)(x >> 4 & 0x0f0f0f0fu));
#endif
#else
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    return x << 16 | x >> 16;
#endif
}
#endif

/* Owen-scrambles four coordinates whose bits are in reverse order, each by its seed, and reverses their bits. */
KOKSMA_INLINE koksma__four koksma__scramble_four(koksma__four x, koksma__four seeds)
{
#if defined(KOKSMA_VECTOR)
    x ^= x * 0x3d20adeau;
    x += seeds;
    x *= seeds >> 16 | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return koksma__mirror_four(x);
#else
    int k;
    for (k = 0; k < 4; k++) {
        x.word[k] = koksma_mirror(koksma_owen_hash(x.word[k], seeds.word[k]));
    }
    return x;
#endif
}

/* Returns x 2^-32 exactly. The conversion goes through a signed number because compilers vectorise conversions of
   signed numbers. */
KOKSMA_INLINE double koksma_fraction(uint32_t x)
{
    return ((double)(int32_t)(x ^ 0x80000000u) + 2147483648.0) * (1.0 / 4294967296.0);
}

/* Copies four words from memory to a koksma__four; koksma__four_to_words copies them back. */
KOKSMA_INLINE koksma__four koksma__four_of_words(const uint32_t words[4])
{
    koksma__four x;
#if defined(KOKSMA_VECTOR)
    __builtin_memcpy(&x, words, sizeof x);
#else
    int k;
    for (k = 0; k < 4; k++) {
        x.word[k] = words[k];
    }
#endif
    return x;
}

KOKSMA_INLINE void koksma__four_to_words(koksma__four x, uint32_t words[4])
{
#if defined(KOKSMA_VECTOR)
    __builtin_memcpy(words, &x, sizeof x);
#else
    int k;
    for (k = 0; k < 4; k++) {
        words[k] = x.word[k];
    }
#endif
}

/* Stores the first `count` of four words as fractions in [0,1). */
KOKSMA_INLINE void koksma__to_doubles(koksma__four x, int count, double *xs)
{
#if defined(KOKSMA_VECTOR)
    const koksma__four_double unit =
        (__builtin_convertvector((koksma__four_signed)(x ^ 0x80000000u), koksma__four_double) + 2147483648.0) *
        (1.0 / 4294967296.0);
    __builtin_memcpy(xs, &unit, (unsigned)count * sizeof *xs);
#else
    int k;
    for (k = 0; k < count; k++) {
        xs[k] = koksma_fraction(x.word[k]);
    }
#endif
}

/* Stores the first `count` of four words as fractions in [0,1), rounded down to multiples of 2^-24. */
KOKSMA_INLINE void koksma__to_floats(koksma__four x, int count, float *xs)
{
#if defined(KOKSMA_VECTOR)
    const koksma__four_float unit =
        __builtin_convertvector((koksma__four_signed)(x >> 8), koksma__four_float) * (1.0f / 16777216.0f);
    __builtin_memcpy(xs, &unit, (unsigned)count * sizeof *xs);
#else
    int k;
    for (k = 0; k < count; k++) {
        xs[k] = (float)(int32_t)(x.word[k] >> 8) * (1.0f / 16777216.0f);
    }
#endif
}

/* ---- The order of the samples of a domain -------------------------------------------------------------- */

/* Returns the random word that chooses the order of samples 2^32 part .. 2^32 (part + 1) - 1 of koksma_r_2d. */
KOKSMA_INLINE uint32_t koksma_order(uint64_t key, uint32_t part)
{
    uint32_t w[4];
    koksma_words(key, KOKSMA_FOR_SHUFFLE, part, 0x6f726465u, w);
    return w[0];
}

/* Returns the index at position i of the order that the random word `order` chooses: the nested uniform shuffle of
   all 32-bit indices by Owen hashing. Aligned blocks of 2^m positions become aligned blocks of 2^m indices. */
KOKSMA_INLINE uint32_t koksma_shuffled(uint32_t i, uint32_t order)
{
    return koksma_mirror(koksma_owen_hash(koksma_mirror(i), order));
}

/* Returns the row of a table of a digital sequence that half byte n of an index selects; half byte 0 is the lowest. j
   is the index with its 32 bits in reverse order. Rows have `width` (2 or 4) words. */
KOKSMA_INLINE koksma__four koksma__row(const uint32_t *table, uint32_t width, uint32_t n, uint32_t j)
{
    const uint32_t fourfold = n < 7 ? j >> (26 - 4 * n) : j << 2;
    const uint32_t *row = table + 16 * width * n + (width == 4 ? fourfold & 60u : fourfold >> 1 & 30u);
#if defined(KOKSMA_VECTOR)
    if (width == 4) {
        return *(const koksma__four_in_table *)row;
    } else {
        const koksma__two_long half = {(uint64_t)row[1] << 32 | row[0], 0};
        return (koksma__four)half;
    }
#elif defined(__CUDA_ARCH__)
    if (width == 4) { /* koksma__sobol_four computes the first two words */
        const uint2 half = *(const uint2 *)(row + 2);
        const koksma__four x = {{0, 0, half.x, half.y}};
        return x;
    } else {
        const uint2 half = *(const uint2 *)row;
        const koksma__four x = {{half.x, half.y, 0, 0}};
        return x;
    }
#else
    koksma__four x;
    uint32_t k;
    for (k = 0; k < 4; k++) {
        x.word[k] = k < width ? row[k] : 0;
    }
    return x;
#endif
}

/* Returns a XOR b. */
KOKSMA_INLINE koksma__four koksma__xor(koksma__four a, koksma__four b)
{
#if defined(KOKSMA_VECTOR)
    return a ^ b;
#else
    int k;
    for (k = 0; k < 4; k++) {
        a.word[k] ^= b.word[k];
    }
    return a;
#endif
}

/* Returns the point of a digital sequence, with bits in reverse order, at position i of a shuffled order: the sum
   modulo 2 of one table row for each half byte of the index. Aligned blocks of 2^m positions are aligned blocks of
   2^m indices. The order is that of koksma_shuffled except for an XOR of the upper 16 bits of the index, which
   keeps positions below 2^16 at indices below 2^16, for which four rows suffice. In an Owen-scrambled digital
   sequence this XOR is a digital shift and changes no probability. */
KOKSMA_INLINE koksma__four koksma__digital(const uint32_t *table, uint32_t width, uint32_t i, uint32_t order)
{
    uint32_t j = koksma_owen_hash(koksma_mirror(i), order);
    koksma__four x;
#if defined(KOKSMA_VECTOR)
    /* Without this barrier gcc computes j and its first table row a second time, for the next iteration of a loop. */
    __asm__("" : "+r"(j));
#endif
    x = koksma__xor(koksma__xor(koksma__row(table, width, 0, j), koksma__row(table, width, 1, j)),
                    koksma__xor(koksma__row(table, width, 2, j), koksma__row(table, width, 3, j)));
    if (i >> 16) {
        j ^= koksma_owen_hash(0, order);
        x = koksma__xor(x,
                        koksma__xor(koksma__xor(koksma__row(table, width, 4, j), koksma__row(table, width, 5, j)),
                                    koksma__xor(koksma__row(table, width, 6, j), koksma__row(table, width, 7, j))));
    }
    return x;
}

/* ---- Sobol', Owen-scrambled by hashing, in shuffled order ---------------------------------------------- */

/* Multiplies i by the upper triangular Pascal matrix modulo 2, which gives the second coordinate of the Sobol'
   sequence with bits in reverse order. */
KOKSMA_INLINE uint32_t koksma_pascal(uint32_t i)
{
    i ^= (i & 0xaaaaaaaau) >> 1;
    i ^= (i & 0xccccccccu) >> 2;
    i ^= (i & 0xf0f0f0f0u) >> 4;
    i ^= (i & 0xff00ff00u) >> 8;
    return i ^ (i & 0xffff0000u) >> 16;
}

/* Returns sample i of the first four dimensions of the Sobol' sequence (Joe & Kuo 2008), shuffled and
   Owen-scrambled, as 32-bit fractions. */
KOKSMA_INLINE koksma__four koksma__sobol_four(uint32_t i, uint32_t order, koksma__four seeds)
{
    static KOKSMA_ALIGNED const uint32_t table[512] = {
        0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x00000008u, 0x0000000fu, 0x00000009u, 0x0000000au,
        0x00000004u, 0x00000005u, 0x00000006u, 0x00000004u, 0x0000000cu, 0x0000000au, 0x0000000fu, 0x0000000eu,
        0x00000002u, 0x00000003u, 0x00000003u, 0x00000003u, 0x0000000au, 0x0000000cu, 0x0000000au, 0x00000009u,
        0x00000006u, 0x00000006u, 0x00000005u, 0x00000007u, 0x0000000eu, 0x00000009u, 0x0000000cu, 0x0000000du,
        0x00000001u, 0x00000001u, 0x00000001u, 0x00000001u, 0x00000009u, 0x0000000eu, 0x00000008u, 0x0000000bu,
        0x00000005u, 0x00000004u, 0x00000007u, 0x00000005u, 0x0000000du, 0x0000000bu, 0x0000000eu, 0x0000000fu,
        0x00000003u, 0x00000002u, 0x00000002u, 0x00000002u, 0x0000000bu, 0x0000000du, 0x0000000bu, 0x00000008u,
        0x00000007u, 0x00000007u, 0x00000004u, 0x00000006u, 0x0000000fu, 0x00000008u, 0x0000000du, 0x0000000cu,
        0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x00000080u, 0x000000ffu, 0x000000a3u, 0x000000c9u,
        0x00000040u, 0x00000055u, 0x00000071u, 0x00000045u, 0x000000c0u, 0x000000aau, 0x000000d2u, 0x0000008cu,
        0x00000020u, 0x00000033u, 0x0000003au, 0x0000002eu, 0x000000a0u, 0x000000ccu, 0x00000099u, 0x000000e7u,
        0x00000060u, 0x00000066u, 0x0000004bu, 0x0000006bu, 0x000000e0u, 0x00000099u, 0x000000e8u, 0x000000a2u,
        0x00000010u, 0x00000011u, 0x00000017u, 0x0000001fu, 0x00000090u, 0x000000eeu, 0x000000b4u, 0x000000d6u,
        0x00000050u, 0x00000044u, 0x00000066u, 0x0000005au, 0x000000d0u, 0x000000bbu, 0x000000c5u, 0x00000093u,
        0x00000030u, 0x00000022u, 0x0000002du, 0x00000031u, 0x000000b0u, 0x000000ddu, 0x0000008eu, 0x000000f8u,
        0x00000070u, 0x00000077u, 0x0000005cu, 0x00000074u, 0x000000f0u, 0x00000088u, 0x000000ffu, 0x000000bdu,
        0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x00000800u, 0x00000f0fu, 0x000009aau, 0x00000b67u,
        0x00000400u, 0x00000505u, 0x00000677u, 0x0000079au, 0x00000c00u, 0x00000a0au, 0x00000fddu, 0x00000cfdu,
        0x00000200u, 0x00000303u, 0x00000339u, 0x000002a4u, 0x00000a00u, 0x00000c0cu, 0x00000a93u, 0x000009c3u,
        0x00000600u, 0x00000606u, 0x0000054eu, 0x0000053eu, 0x00000e00u, 0x00000909u, 0x00000ce4u, 0x00000e59u,
        0x00000100u, 0x00000101u, 0x00000116u, 0x0000011bu, 0x00000900u, 0x00000e0eu, 0x000008bcu, 0x00000a7cu,
        0x00000500u, 0x00000404u, 0x00000761u, 0x00000681u, 0x00000d00u, 0x00000b0bu, 0x00000ecbu, 0x00000de6u,
        0x00000300u, 0x00000202u, 0x0000022fu, 0x000003bfu, 0x00000b00u, 0x00000d0du, 0x00000b85u, 0x000008d8u,
        0x00000700u, 0x00000707u, 0x00000458u, 0x00000425u, 0x00000f00u, 0x00000808u, 0x00000df2u, 0x00000f42u,
        0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x00008000u, 0x0000ffffu, 0x0000aa09u, 0x0000a0c3u,
        0x00004000u, 0x00005555u, 0x00007706u, 0x00004041u, 0x0000c000u, 0x0000aaaau, 0x0000dd0fu, 0x0000e082u,
        0x00002000u, 0x00003333u, 0x00003903u, 0x0000302du, 0x0000a000u, 0x0000ccccu, 0x0000930au, 0x000090eeu,
        0x00006000u, 0x00006666u, 0x00004e05u, 0x0000706cu, 0x0000e000u, 0x00009999u, 0x0000e40cu, 0x0000d0afu,
        0x00001000u, 0x00001111u, 0x00001601u, 0x0000101eu, 0x00009000u, 0x0000eeeeu, 0x0000bc08u, 0x0000b0ddu,
        0x00005000u, 0x00004444u, 0x00006107u, 0x0000505fu, 0x0000d000u, 0x0000bbbbu, 0x0000cb0eu, 0x0000f09cu,
        0x00003000u, 0x00002222u, 0x00002f02u, 0x00002033u, 0x0000b000u, 0x0000ddddu, 0x0000850bu, 0x000080f0u,
        0x00007000u, 0x00007777u, 0x00005804u, 0x00006072u, 0x0000f000u, 0x00008888u, 0x0000f20du, 0x0000c0b1u,
        0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x00080000u, 0x000f000fu, 0x000909a3u, 0x000c9baeu,
        0x00040000u, 0x00050005u, 0x00060671u, 0x000457dfu, 0x000c0000u, 0x000a000au, 0x000f0fd2u, 0x0008cc71u,
        0x00020000u, 0x00030003u, 0x0003033au, 0x0002e28au, 0x000a0000u, 0x000c000cu, 0x000a0a99u, 0x000e7924u,
        0x00060000u, 0x00060006u, 0x0005054bu, 0x0006b555u, 0x000e0000u, 0x00090009u, 0x000c0ce8u, 0x000a2efbu,
        0x00010000u, 0x00010001u, 0x00010117u, 0x0001f104u, 0x00090000u, 0x000e000eu, 0x000808b4u, 0x000d6aaau,
        0x00050000u, 0x00040004u, 0x00070766u, 0x0005a6dbu, 0x000d0000u, 0x000b000bu, 0x000e0ec5u, 0x00093d75u,
        0x00030000u, 0x00020002u, 0x0002022du, 0x0003138eu, 0x000b0000u, 0x000d000du, 0x000b0b8eu, 0x000f8820u,
        0x00070000u, 0x00070007u, 0x0004045cu, 0x00074451u, 0x000f0000u, 0x00080008u, 0x000d0dffu, 0x000bdfffu,
        0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x00800000u, 0x00ff00ffu, 0x00a3aaaau, 0x00b6dba4u,
        0x00400000u, 0x00550055u, 0x00717777u, 0x0079e7dbu, 0x00c00000u, 0x00aa00aau, 0x00d2ddddu, 0x00cf3c7fu,
        0x00200000u, 0x00330033u, 0x003a3939u, 0x002a7289u, 0x00a00000u, 0x00cc00ccu, 0x00999393u, 0x009ca92du,
        0x00600000u, 0x00660066u, 0x004b4e4eu, 0x00539552u, 0x00e00000u, 0x00990099u, 0x00e8e4e4u, 0x00e54ef6u,
        0x00100000u, 0x00110011u, 0x00171616u, 0x0011a105u, 0x00900000u, 0x00ee00eeu, 0x00b4bcbcu, 0x00a77aa1u,
        0x00500000u, 0x00440044u, 0x00666161u, 0x006846deu, 0x00d00000u, 0x00bb00bbu, 0x00c5cbcbu, 0x00de9d7au,
        0x00300000u, 0x00220022u, 0x002d2f2fu, 0x003bd38cu, 0x00b00000u, 0x00dd00ddu, 0x008e8585u, 0x008d0828u,
        0x00700000u, 0x00770077u, 0x005c5858u, 0x00423457u, 0x00f00000u, 0x00880088u, 0x00fff2f2u, 0x00f4eff3u,
        0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x08000000u, 0x0f0f0f0fu, 0x09a30009u, 0x0a000b6du,
        0x04000000u, 0x05050505u, 0x06710006u, 0x0400079eu, 0x0c000000u, 0x0a0a0a0au, 0x0fd2000fu, 0x0e000cf3u,
        0x02000000u, 0x03030303u, 0x033a0003u, 0x030002a7u, 0x0a000000u, 0x0c0c0c0cu, 0x0a99000au, 0x090009cau,
        0x06000000u, 0x06060606u, 0x054b0005u, 0x07000539u, 0x0e000000u, 0x09090909u, 0x0ce8000cu, 0x0d000e54u,
        0x01000000u, 0x01010101u, 0x01170001u, 0x0100011au, 0x09000000u, 0x0e0e0e0eu, 0x08b40008u, 0x0b000a77u,
        0x05000000u, 0x04040404u, 0x07660007u, 0x05000684u, 0x0d000000u, 0x0b0b0b0bu, 0x0ec5000eu, 0x0f000de9u,
        0x03000000u, 0x02020202u, 0x022d0002u, 0x020003bdu, 0x0b000000u, 0x0d0d0d0du, 0x0b8e000bu, 0x080008d0u,
        0x07000000u, 0x07070707u, 0x045c0004u, 0x06000423u, 0x0f000000u, 0x08080808u, 0x0dff000du, 0x0c000f4eu,
        0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x80000000u, 0xffffffffu, 0xaaaa00a3u, 0xc900a00au,
        0x40000000u, 0x55555555u, 0x77770071u, 0x45004004u, 0xc0000000u, 0xaaaaaaaau, 0xdddd00d2u, 0x8c00e00eu,
        0x20000000u, 0x33333333u, 0x3939003au, 0x2e003003u, 0xa0000000u, 0xccccccccu, 0x93930099u, 0xe7009009u,
        0x60000000u, 0x66666666u, 0x4e4e004bu, 0x6b007007u, 0xe0000000u, 0x99999999u, 0xe4e400e8u, 0xa200d00du,
        0x10000000u, 0x11111111u, 0x16160017u, 0x1f001001u, 0x90000000u, 0xeeeeeeeeu, 0xbcbc00b4u, 0xd600b00bu,
        0x50000000u, 0x44444444u, 0x61610066u, 0x5a005005u, 0xd0000000u, 0xbbbbbbbbu, 0xcbcb00c5u, 0x9300f00fu,
        0x30000000u, 0x22222222u, 0x2f2f002du, 0x31002002u, 0xb0000000u, 0xddddddddu, 0x8585008eu, 0xf8008008u,
        0x70000000u, 0x77777777u, 0x5858005cu, 0x74006006u, 0xf0000000u, 0x88888888u, 0xf2f200ffu, 0xbd00c00cu};
#if defined(__CUDA_ARCH__)
    /* A GPU computes the index and its product with the Pascal matrix faster than it looks them up. */
    const uint32_t upper = koksma_owen_hash(0, order) & 0xffffu;
    const uint32_t index = koksma_mirror(koksma_owen_hash(koksma_mirror(i), order) ^ upper);
    koksma__four x = koksma__digital(table, 4, i, order);
    x.word[0] = index;
    x.word[1] = koksma_pascal(index);
    return koksma__scramble_four(x, seeds);
#else
    return koksma__scramble_four(koksma__digital(table, 4, i, order), seeds);
#endif
}

/* The seeds of the Sobol' sequence of a domain. Compute them once for a loop over many samples of the domain. */
typedef struct koksma_sobol {
    uint32_t seeds[4], order;
} koksma_sobol;

/* Computes the seeds of the Sobol' sequence of a domain. */
KOKSMA_INLINE koksma_sobol koksma_sobol_of(koksma_domain domain)
{
    koksma_sobol sequence;
    koksma__four_to_words(koksma__four_seeds(domain.key), sequence.seeds);
    sequence.order = koksma_seed_of_order(domain.key);
    return sequence;
}

/* Returns Sobol' sample i of a domain as four 32-bit fractions. */
KOKSMA_INLINE koksma__four koksma__sobol_words(koksma_domain domain, uint32_t i)
{
    return koksma__sobol_four(i, koksma_seed_of_order(domain.key), koksma__four_seeds(domain.key));
}

/* Computes Sobol' sample i of a domain in one to four dimensions, as doubles or as floats, which are the doubles
   rounded down. A sample of fewer dimensions has the first coordinates of the four-dimensional sample. Every
   aligned block of 2^m samples has one sample in each of 2^m equal intervals of each axis, and its first two
   dimensions are a (0,m,2)-net in base 2. */
KOKSMA_INLINE double koksma_sobol_1d(koksma_domain domain, uint32_t i)
{
    double x;
    koksma__to_doubles(koksma__sobol_words(domain, i), 1, &x);
    return x;
}

KOKSMA_INLINE void koksma_sobol_2d(koksma_domain domain, uint32_t i, double xy[KOKSMA__N(2)])
{
    koksma__to_doubles(koksma__sobol_words(domain, i), 2, xy);
}

KOKSMA_INLINE void koksma_sobol_3d(koksma_domain domain, uint32_t i, double xs[KOKSMA__N(3)])
{
    koksma__to_doubles(koksma__sobol_words(domain, i), 3, xs);
}

KOKSMA_INLINE void koksma_sobol_4d(koksma_domain domain, uint32_t i, double xs[KOKSMA__N(4)])
{
    koksma__to_doubles(koksma__sobol_words(domain, i), 4, xs);
}

KOKSMA_INLINE float koksma_sobol_1f(koksma_domain domain, uint32_t i)
{
    float x;
    koksma__to_floats(koksma__sobol_words(domain, i), 1, &x);
    return x;
}

KOKSMA_INLINE void koksma_sobol_2f(koksma_domain domain, uint32_t i, float xy[KOKSMA__N(2)])
{
    koksma__to_floats(koksma__sobol_words(domain, i), 2, xy);
}

KOKSMA_INLINE void koksma_sobol_3f(koksma_domain domain, uint32_t i, float xs[KOKSMA__N(3)])
{
    koksma__to_floats(koksma__sobol_words(domain, i), 3, xs);
}

KOKSMA_INLINE void koksma_sobol_4f(koksma_domain domain, uint32_t i, float xs[KOKSMA__N(4)])
{
    koksma__to_floats(koksma__sobol_words(domain, i), 4, xs);
}

/* Computes sample i of the Sobol' sequence whose seeds koksma_sobol_of returned. */
KOKSMA_INLINE void koksma_sobol_at_2d(const koksma_sobol *sequence, uint32_t i, double xy[KOKSMA__N(2)])
{
    koksma__to_doubles(koksma__sobol_four(i, sequence->order, koksma__four_of_words(sequence->seeds)), 2, xy);
}

KOKSMA_INLINE void koksma_sobol_at_4d(const koksma_sobol *sequence, uint32_t i, double xs[KOKSMA__N(4)])
{
    koksma__to_doubles(koksma__sobol_four(i, sequence->order, koksma__four_of_words(sequence->seeds)), 4, xs);
}

/* Computes Sobol' samples first .. first + count - 1 of a domain in dim = 1 to 4 dimensions: xs[dim * k ...]
   receives sample first + k. */
KOKSMA_INLINE void koksma_sobol_range(koksma_domain domain, uint32_t first, uint32_t count, int dim, double *xs)
{
    const uint32_t order = koksma_seed_of_order(domain.key);
    const koksma__four seeds = koksma__four_seeds(domain.key);
    uint32_t k;
    KOKSMA_ASSERT(dim >= 1 && dim <= 4);
    for (k = 0; k < count; k++, xs += dim) {
        koksma__to_doubles(koksma__sobol_four(first + k, order, seeds), dim, xs);
    }
}

KOKSMA_INLINE void koksma_sobol_range_float(koksma_domain domain, uint32_t first, uint32_t count, int dim, float *xs)
{
    const uint32_t order = koksma_seed_of_order(domain.key);
    const koksma__four seeds = koksma__four_seeds(domain.key);
    uint32_t k;
    KOKSMA_ASSERT(dim >= 1 && dim <= 4);
    for (k = 0; k < count; k++, xs += dim) {
        koksma__to_floats(koksma__sobol_four(first + k, order, seeds), dim, xs);
    }
}

/* Computes Sobol' sample indices[k] of domains[k] for each lane k < count of a wavefront, in dim = 1 to 4
   dimensions; xs[dim * k ...] receives it. */
KOKSMA_INLINE void koksma_sobol_lanes(uint32_t count, const koksma_domain *domains, const uint32_t *indices, int dim,
                                      double *xs)
{
    uint32_t k;
    KOKSMA_ASSERT(dim >= 1 && dim <= 4);
    for (k = 0; k < count; k++, xs += dim) {
        koksma__to_doubles(koksma__sobol_words(domains[k], indices[k]), dim, xs);
    }
}

KOKSMA_INLINE void koksma_sobol_lanes_float(uint32_t count, const koksma_domain *domains, const uint32_t *indices,
                                            int dim, float *xs)
{
    uint32_t k;
    KOKSMA_ASSERT(dim >= 1 && dim <= 4);
    for (k = 0; k < count; k++, xs += dim) {
        koksma__to_floats(koksma__sobol_words(domains[k], indices[k]), dim, xs);
    }
}

/* ---- White noise --------------------------------------------------------------------------------------- */

/* Returns the four random words of sample i of a domain, which are independent of those of all other samples. */
KOKSMA_INLINE koksma__four koksma__white_words(koksma_domain domain, uint32_t i)
{
    return koksma__four_seeds(koksma__derived(domain.key, 0x452821e6u, i));
}

/* Computes independent random numbers, doubles with 32 random bits or floats with 24. Use them for choices that
   need no stratification, such as Russian roulette, and as the baseline of comparisons. */
KOKSMA_INLINE double koksma_white_1d(koksma_domain domain, uint32_t i)
{
    double x;
    koksma__to_doubles(koksma__white_words(domain, i), 1, &x);
    return x;
}

KOKSMA_INLINE void koksma_white_4d(koksma_domain domain, uint32_t i, double xs[KOKSMA__N(4)])
{
    koksma__to_doubles(koksma__white_words(domain, i), 4, xs);
}

KOKSMA_INLINE float koksma_white_1f(koksma_domain domain, uint32_t i)
{
    float x;
    koksma__to_floats(koksma__white_words(domain, i), 1, &x);
    return x;
}

KOKSMA_INLINE void koksma_white_4f(koksma_domain domain, uint32_t i, float xs[KOKSMA__N(4)])
{
    koksma__to_floats(koksma__white_words(domain, i), 4, xs);
}

/* ---- Progressive multi-jittered (0,2) ------------------------------------------------------------------ */

/* Computes sample i of the PMJ02 sequence as a digital sequence (Helmer, Christensen & Kensler 2021: the matrices
   are Stirling numbers modulo 2), scrambled and shuffled like koksma_sobol_2d. Every aligned block of 2^m samples
   is a (0,m,2)-net. */
KOKSMA_INLINE void koksma_pmj02_2d(koksma_domain domain, uint32_t i, double xy[KOKSMA__N(2)])
{
    static KOKSMA_ALIGNED const uint32_t table[256] = {
        0x00000000u, 0x00000000u, 0x0000000cu, 0x0000000au, 0x00000006u, 0x00000006u, 0x0000000au, 0x0000000cu,
        0x00000002u, 0x00000003u, 0x0000000eu, 0x00000009u, 0x00000004u, 0x00000005u, 0x00000008u, 0x0000000fu,
        0x00000001u, 0x00000001u, 0x0000000du, 0x0000000bu, 0x00000007u, 0x00000007u, 0x0000000bu, 0x0000000du,
        0x00000003u, 0x00000002u, 0x0000000fu, 0x00000008u, 0x00000005u, 0x00000004u, 0x00000009u, 0x0000000eu,
        0x00000000u, 0x00000000u, 0x000000f0u, 0x00000088u, 0x00000078u, 0x00000078u, 0x00000088u, 0x000000f0u,
        0x00000028u, 0x0000003cu, 0x000000d8u, 0x000000b4u, 0x00000050u, 0x00000044u, 0x000000a0u, 0x000000ccu,
        0x00000014u, 0x00000014u, 0x000000e4u, 0x0000009cu, 0x0000006cu, 0x0000006cu, 0x0000009cu, 0x000000e4u,
        0x0000003cu, 0x00000028u, 0x000000ccu, 0x000000a0u, 0x00000044u, 0x00000050u, 0x000000b4u, 0x000000d8u,
        0x00000000u, 0x00000000u, 0x00000cc0u, 0x00000aa0u, 0x00000660u, 0x00000660u, 0x00000aa0u, 0x00000cc0u,
        0x00000220u, 0x00000330u, 0x00000ee0u, 0x00000990u, 0x00000440u, 0x00000550u, 0x00000880u, 0x00000ff0u,
        0x00000110u, 0x00000110u, 0x00000dd0u, 0x00000bb0u, 0x00000770u, 0x00000770u, 0x00000bb0u, 0x00000dd0u,
        0x00000330u, 0x00000220u, 0x00000ff0u, 0x00000880u, 0x00000550u, 0x00000440u, 0x00000990u, 0x00000ee0u,
        0x00000000u, 0x00000000u, 0x0000ff00u, 0x00008080u, 0x00007f80u, 0x00007f80u, 0x00008080u, 0x0000ff00u,
        0x00002a80u, 0x00003fc0u, 0x0000d580u, 0x0000bf40u, 0x00005500u, 0x00004040u, 0x0000aa00u, 0x0000c0c0u,
        0x00001540u, 0x00001540u, 0x0000ea40u, 0x000095c0u, 0x00006ac0u, 0x00006ac0u, 0x000095c0u, 0x0000ea40u,
        0x00003fc0u, 0x00002a80u, 0x0000c0c0u, 0x0000aa00u, 0x00004040u, 0x00005500u, 0x0000bf40u, 0x0000d580u,
        0x00000000u, 0x00000000u, 0x000c0c00u, 0x000a0a00u, 0x00060600u, 0x00060600u, 0x000a0a00u, 0x000c0c00u,
        0x00020200u, 0x00030300u, 0x000e0e00u, 0x00090900u, 0x00040400u, 0x00050500u, 0x00080800u, 0x000f0f00u,
        0x00010100u, 0x00010100u, 0x000d0d00u, 0x000b0b00u, 0x00070700u, 0x00070700u, 0x000b0b00u, 0x000d0d00u,
        0x00030300u, 0x00020200u, 0x000f0f00u, 0x00080800u, 0x00050500u, 0x00040400u, 0x00090900u, 0x000e0e00u,
        0x00000000u, 0x00000000u, 0x00f0f000u, 0x00888800u, 0x00787800u, 0x00787800u, 0x00888800u, 0x00f0f000u,
        0x00282800u, 0x003c3c00u, 0x00d8d800u, 0x00b4b400u, 0x00505000u, 0x00444400u, 0x00a0a000u, 0x00cccc00u,
        0x00141400u, 0x00141400u, 0x00e4e400u, 0x009c9c00u, 0x006c6c00u, 0x006c6c00u, 0x009c9c00u, 0x00e4e400u,
        0x003c3c00u, 0x00282800u, 0x00cccc00u, 0x00a0a000u, 0x00444400u, 0x00505000u, 0x00b4b400u, 0x00d8d800u,
        0x00000000u, 0x00000000u, 0x0cccc000u, 0x0aaaa000u, 0x06666000u, 0x06666000u, 0x0aaaa000u, 0x0cccc000u,
        0x02222000u, 0x03333000u, 0x0eeee000u, 0x09999000u, 0x04444000u, 0x05555000u, 0x08888000u, 0x0ffff000u,
        0x01111000u, 0x01111000u, 0x0dddd000u, 0x0bbbb000u, 0x07777000u, 0x07777000u, 0x0bbbb000u, 0x0dddd000u,
        0x03333000u, 0x02222000u, 0x0ffff000u, 0x08888000u, 0x05555000u, 0x04444000u, 0x09999000u, 0x0eeee000u,
        0x00000000u, 0x00000000u, 0xffff0000u, 0x80008000u, 0x7fff8000u, 0x7fff8000u, 0x80008000u, 0xffff0000u,
        0x2aaa8000u, 0x3fffc000u, 0xd5558000u, 0xbfff4000u, 0x55550000u, 0x40004000u, 0xaaaa0000u, 0xc000c000u,
        0x15554000u, 0x15554000u, 0xeaaa4000u, 0x9555c000u, 0x6aaac000u, 0x6aaac000u, 0x9555c000u, 0xeaaa4000u,
        0x3fffc000u, 0x2aaa8000u, 0xc000c000u, 0xaaaa0000u, 0x40004000u, 0x55550000u, 0xbfff4000u, 0xd5558000u};
    const koksma__four x = koksma__digital(table, 2, i, koksma_seed_of_order(domain.key));
    koksma__to_doubles(koksma__scramble_four(x, koksma__four_seeds(domain.key)), 2, xy);
}

/* ---- Correlated multi-jitter --------------------------------------------------------------------------- */

/* Returns element i of a random permutation of 0 .. n-1 that the key chooses; i < n < 2^31. The function applies a
   bijection of 0 .. 2^k - 1, 2^k >= n, repeatedly until the result is below n (cycle walking). Up to n = 8 the
   permutation is not quite uniform over the keys: for n = 3 .. 8 the probability that two given elements are at two
   given positions deviates by 0.6, 1.6, 1.3, 1.0, 0.4, 0.5 % (root mean square over the pairs; at most 7 %); the
   probability that one given element is at a given position deviates by 0.4 % for n = 3 and 0.1 % for n = 5 to 7.
   From n = 9 on, tests with 4 million keys find no deviation. */
KOKSMA_INLINE uint32_t koksma_permute(uint32_t i, uint32_t n, uint64_t key)
{
    const uint32_t a = (uint32_t)key, b = (uint32_t)(key >> 32);
    uint32_t mask = n - 1, shift = 1;
    KOKSMA_ASSERT(i < n && n >> 31 == 0);
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

/* Returns the coordinate in [0,1) of the relative position u in [0,1) within cell number `cell` of `cells` <= 2^29
   equal cells; rounding never moves the coordinate out of its cell. u / 2^24 is exact, so compilers that fuse
   products and sums give the same bits. */
KOKSMA_INLINE double koksma_place(double cell, double u, double cells)
{
    return (cell + (u - u * (1.0 / 16777216.0))) / cells;
}

/* Computes sample i of a correlated multi-jittered set of columns * rows samples: one in each cell of the grid, and
   one in each of the columns * rows strata of each axis. i must be less than columns * rows <= 2^29. */
KOKSMA_INLINE void koksma_cmj_2d(koksma_domain domain, uint32_t i, uint32_t columns, uint32_t rows,
                                 double xy[KOKSMA__N(2)])
{
    uint32_t keys[4], more[4], w[4], s, c, r;
    const double cells = (double)columns * (double)rows;
    KOKSMA_ASSERT(cells <= 536870912.0 && (double)i < cells);
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

/* Computes sample i of the R-sequence, the additive recurrence of the plastic number, shifted on the torus by the
   domain's random vector, in an order that the domain chooses. Every aligned block of 2^m samples, m <= 32, is a
   run of 2^m consecutive points. Each block of 2^32 samples has a different order; the blocks themselves are not
   shuffled.

   If N is not a power of two, the first N samples are less even than N consecutive points of the sequence: they are
   several runs of points, one for each 1 among the binary digits of N, with gaps between the runs. Their RMS L2 star
   discrepancy is 1.19 times that of one run in the mean over N = 1 to 1024, and at most 1.64 times (N = 98). The
   samples are shuffled nevertheless, because otherwise the same coordinate of two domains would differ by the same
   number, modulo 1, in all samples. */
KOKSMA_INLINE void koksma_r_2d(koksma_domain domain, uint64_t i, double xy[KOKSMA__N(2)])
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

/* Returns element j, 0 to 3, of the permutation of 0 .. 3 that a random word chooses. */
KOKSMA_INLINE uint32_t koksma_permute4(uint32_t j, uint32_t word)
{
    uint32_t order = 0xe4u, i; /* four fields of two bits: at first 0, 1, 2, 3 */
    KOKSMA_ASSERT(j < 4);
    for (i = 3; i > 0; i--) {
        const uint32_t other = (word & 0x3ffu) * (i + 1) >> 10;
        const uint32_t difference = (order >> 2 * i ^ order >> 2 * other) & 3u;
        order ^= difference << 2 * i ^ difference << 2 * other;
        word >>= 10;
    }
    return order >> 2 * j & 3u;
}

/* Returns the rank of pixel (x, y) of a square image of 2^levels pixels a side, levels <= 16, along a Z-curve whose
   quadrants are in random order at each node. Give a pixel the samples rank * spp .. rank * spp + spp - 1 of one
   sequence for the whole image, such as koksma_sobol_2d with the image's domain: the samples of neighbouring pixels
   are then evenly distributed together. The image may have 2^32 samples, 4^levels * spp, because indices have 32 bits:
   of more, pixels far apart would have the same samples. The orders of two domains are similar, because both follow a
   Z-curve: the pixels of a quadrant have consecutive ranks in both. The two ranks of one pixel are independent of each
   other, and so are the samples that they index. */
KOKSMA_INLINE uint32_t koksma_z_rank(koksma_domain domain, uint32_t x, uint32_t y, int levels)
{
    uint32_t rank = 0, path = 1;
    int l;
    KOKSMA_ASSERT(levels >= 0 && levels <= 16);
    for (l = levels - 1; l >= 0; l--) {
        const uint32_t quadrant = (y >> l & 1u) << 1 | (x >> l & 1u);
        uint32_t w[4];
        koksma_words(domain.key, KOKSMA_FOR_SHUFFLE, path, (uint32_t)l + 1, w);
        rank = rank << 2 | koksma_permute4(quadrant, w[0]);
        path = path << 2 | quadrant;
    }
    return rank;
}

#if defined(__GNUC__) && defined(__cplusplus)
#pragma GCC diagnostic pop
#endif

#endif
