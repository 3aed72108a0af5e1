/* SPDX-License-Identifier: Apache-2.0 */
/*
 * SIMD kernels for the samples of a pixel: random orders, pairs of coordinates put into such an order, random
 * positions in cells, and the points of nets.
 *
 * Up to KOKSMA__SHUFFLED samples are put in order by the Fisher-Yates shuffle, which makes each of the n! orders
 * equally likely. More samples are permuted by a bijection of the k-bit numbers below the next power of two, as in
 * Kensler (2013); numbers that the bijection maps to n or above are mapped again. Each round of the bijection
 * computes
 *
 *     x = m x + a mod 2^k,   x = x XOR (x >> 2),   x = x rotated by (k + 1) / 2 bits.
 *
 * Each round takes 16 random bits for m, which is made odd, and 16 for a. There are six rounds: with five, the pairs
 * of positions still differ measurably from those of a random order (docs/decisions.md, 40).
 */
#include <string.h>

#include "core/random.h"
#include "render/pipelines/batch_kernel.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
enum { BYTES = 64 };
#elif defined(__AVX2__)
enum { BYTES = 32 };
#else
enum { BYTES = 16 };
#endif

typedef uint16_t shorts __attribute__((vector_size(BYTES)));
/* gcc combines several logical operations on this type into one instruction */
typedef uint64_t longs __attribute__((vector_size(BYTES)));

/* The random words were stored 32 bytes at a time; a wider load would have to wait for these stores. */
typedef uint32_t octet __attribute__((vector_size(32)));
typedef int32_t ints __attribute__((vector_size(32)));
typedef float floats __attribute__((vector_size(32)));

enum { SHORTS = BYTES / 2, FLOATS = 8, VECTORS = 64 / SHORTS, ROUNDS = 6 };

/* ---- Orders ------------------------------------------------------------------------------------------------- */

static void shuffle_few(const uint32_t *words, uint32_t n, uint16_t *out)
{
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t j = koksma__below(words[i], i + 1);
        out[i] = out[j];
        out[j] = (uint16_t)i;
    }
}

/* Applies the bijection to several vectors at once, because the steps of one vector depend on each other. The bits
   above the lowest k need not be cleared after each step: they are masked off only where a right shift would move
   them down. */
INLINE void walk(const uint32_t *words, int bits, int vectors, shorts *x)
{
    const uint16_t turn = (uint16_t)((bits + 1) / 2), back = (uint16_t)(bits - turn),
                   most = (uint16_t)((1u << bits) - 1);
    const shorts mask = most - (shorts){0}, quarter = mask >> 2, turned = mask >> turn;
    for (int r = 0; r < ROUNDS; r++) {
        const shorts factor = (uint16_t)(words[r] | 1) - (shorts){0}, add = (uint16_t)(words[r] >> 16) - (shorts){0};
        for (int v = 0; v < vectors; v++) {
            const shorts y = x[v] * factor + add;
            const longs z = (longs)y ^ ((longs)(y >> 2) & (longs)quarter);
            const longs low = (longs)((shorts)z >> turn), high = (longs)((shorts)z << back);
            x[v] = (shorts)((low & (longs)turned) | high);
        }
    }
    for (int v = 0; v < vectors; v++) {
        x[v] = x[v] & mask;
    }
}

INLINE bool any(shorts mask)
{
    uint64_t parts[BYTES / 8], all = 0;
    memcpy(parts, &mask, sizeof parts);
    for (int p = 0; p < BYTES / 8; p++) {
        all |= parts[p];
    }
    return all != 0;
}

void BATCH_NAME(order)(const uint32_t *words, size_t n, uint16_t *out)
{
    if (n <= KOKSMA__SHUFFLED) {
        shuffle_few(words, (uint32_t)n, out);
        return;
    }
    const int bits = 32 - __builtin_clz((uint32_t)n - 1);
    shorts first;
    for (int l = 0; l < SHORTS; l++) {
        first[l] = (uint16_t)l;
    }
    if ((n & (n - 1)) == 0) {
        for (size_t i = 0; i < n; i += VECTORS * SHORTS) { /* a block has 64 numbers, and n is never below 64 here */
            shorts x[VECTORS];
            for (int v = 0; v < VECTORS; v++, first += SHORTS) {
                x[v] = first;
            }
            walk(words, bits, VECTORS, x);
            memcpy(out + i, x, sizeof x);
        }
        return;
    }
    const shorts last = (uint16_t)(n - 1) - (shorts){0};
    for (size_t i = 0; i < n; i += SHORTS, first += SHORTS) {
        const shorts start = (shorts)(first > last);
        shorts x = (last & start) | (first & ~start), beyond;
        walk(words, bits, 1, &x);
        while (beyond = (shorts)(x > last), any(beyond)) {
            shorts next = x;
            walk(words, bits, 1, &next);
            x = (next & beyond) | (x & ~beyond);
        }
        memcpy(out + i, &x, sizeof x);
    }
}

/* Stores two pairs of coordinates at a time, because the loops that read them next load several pairs at once. */
void BATCH_NAME(gather)(const float *from, const uint16_t *order, size_t n, float *to)
{
    typedef double two __attribute__((vector_size(16)));
    size_t i = 0;
    for (; i + 2 <= n; i += 2) {
        double a, b;
        memcpy(&a, from + 2 * (size_t)order[i], sizeof a);
        memcpy(&b, from + 2 * (size_t)order[i + 1], sizeof b);
        const two pairs = {a, b};
        memcpy(to + 2 * i, &pairs, sizeof pairs);
    }
    if (i < n) {
        memcpy(to + 2 * i, from + 2 * (size_t)order[i], 2 * sizeof *to);
    }
}

void BATCH_NAME(gather_both)(const float *from, const uint16_t *xs, const uint16_t *ys, size_t n, float *to)
{
    typedef float four __attribute__((vector_size(16)));
    size_t i = 0;
    for (; i + 2 <= n; i += 2) {
        const four pairs = {from[2 * (size_t)xs[i]], from[2 * (size_t)ys[i] + 1], from[2 * (size_t)xs[i + 1]],
                            from[2 * (size_t)ys[i + 1] + 1]};
        memcpy(to + 2 * i, &pairs, sizeof pairs);
    }
    if (i < n) {
        to[2 * i] = from[2 * (size_t)xs[i]];
        to[2 * i + 1] = from[2 * (size_t)ys[i] + 1];
    }
}

/* ---- Places ------------------------------------------------------------------------------------------------- */

INLINE void in_turn(const float xy[2], floats *v)
{
    for (int l = 0; l < FLOATS; l++) {
        (*v)[l] = xy[l % 2];
    }
}

void BATCH_NAME(move)(const float *xs, const float offset[2], size_t n, float *to)
{
    floats offsets;
    size_t i = 0;
    in_turn(offset, &offsets);
    for (; i + FLOATS <= 2 * n; i += FLOATS) {
        floats x;
        memcpy(&x, xs + i, sizeof x);
        x += offsets;
        memcpy(to + i, &x, sizeof x);
    }
    for (; i < 2 * n; i++) {
        to[i] = xs[i] + offset[i % 2];
    }
}

void BATCH_NAME(jitter)(const float *corners, const uint32_t *words, const float scale[2], const float offset[2],
                        size_t n, float *to)
{
    floats scales, offsets;
    size_t i = 0;
    in_turn(scale, &scales);
    in_turn(offset, &offsets);
    for (; i + FLOATS <= 2 * n; i += FLOATS) {
        octet w;
        floats x;
        memcpy(&w, words + i, sizeof w);
        memcpy(&x, corners + i, sizeof x);
        x = x + __builtin_convertvector((ints)(w >> 8), floats) * scales + offsets;
        memcpy(to + i, &x, sizeof x);
    }
    for (; i < 2 * n; i++) {
        to[i] = corners[i] + (float)(int32_t)(words[i] >> 8) * scale[i % 2] + offset[i % 2];
    }
}

/* Permutes the lanes of v: lane l gets the value of lane number lane[l], which must be below 8. */
INLINE void permute_lanes(const octet *lane, octet *v)
{
#if defined(__AVX2__)
    *v = (octet)_mm256_permutevar8x32_epi32((__m256i)*v, (__m256i)*lane);
#else
    uint32_t from[8], to[8];
    memcpy(from, v, sizeof from);
    for (int l = 0; l < 8; l++) {
        to[l] = from[(*lane)[l]];
    }
    memcpy(v, to, sizeof to);
#endif
}

/* Computes a coordinate of eight new points of a level (grow.h). On entry the lane of point 2^level + i holds the
   coordinate of the earlier point i XOR partner; on return it holds the new coordinate, which is random in the other
   half of the earlier point's stratum. */
INLINE void grow_lanes(const octet *words, int level, octet *v)
{
    const uint32_t low = UINT32_MAX >> level >> 1;
    *v = ((*v & ~low) ^ (low + 1)) | *words >> (uint32_t)(level + 1);
}

/* Computes a coordinate of the first eight points: at each level, each lane i from 2^level on is derived from lane i
   XOR (2^level + partner). */
INLINE void grow_eight(const octet *words, const uint32_t *partners, octet *v)
{
    const octet lane = {0, 1, 2, 3, 4, 5, 6, 7};
    *v = *words;
    for (int level = 0; level < 3; level++) {
        const uint32_t start = 1u << level;
        const octet from = lane ^ (start | (partners[level] & (start - 1))), later = (octet)(lane >= start);
        octet grown = *v;
        permute_lanes(&from, &grown);
        grow_lanes(words, level, &grown);
        *v = (grown & later) | (*v & ~later);
    }
}

/* Computes one coordinate of n points, as 32-bit numbers, by the algorithm of grow.h; reads and writes whole vectors
   of eight. */
INLINE void grow(const uint32_t *words, const uint32_t *partners, size_t n, uint32_t *v)
{
    octet x, w;
    memcpy(&w, words, sizeof w);
    grow_eight(&w, partners, &x);
    memcpy(v, &x, sizeof x);
    for (int level = 3; (size_t)1 << level < n; level++) {
        const size_t start = (size_t)1 << level, count = n - start < start ? n - start : start;
        const uint32_t partner = partners[level];
        const octet lanes = (octet){0, 1, 2, 3, 4, 5, 6, 7} ^ (partner & 7);
        for (size_t i = 0; i < count; i += 8) {
            memcpy(&x, v + (i ^ (partner & (start - 8))), sizeof x);
            memcpy(&w, words + start + i, sizeof w);
            permute_lanes(&lanes, &x);
            grow_lanes(&w, level, &x);
            memcpy(v + start + i, &x, sizeof x);
        }
    }
}

void BATCH_NAME(net)(const uint32_t *words, const uint32_t partners[2][32], int dim, const float offset[2], size_t n,
                     uint32_t *v, float *to)
{
    const size_t stride = (n + 7) / 8 * 8;
    const float ox = offset[0], oy = offset[1];
    uint32_t *const second = v + stride;
    grow(words, partners[0], n, v);
    if (dim == 1) {
        memset(second, 0, n * sizeof *v);
    } else {
        grow(words + (n + 3) / 4 * 4, partners[1], n, second);
    }
    for (size_t i = 0; i < n; i++) {
        to[2 * i] = (float)(int32_t)(v[i] >> 8) * 0x1p-24f + ox;
        to[2 * i + 1] = (float)(int32_t)(second[i] >> 8) * 0x1p-24f + oy;
    }
}
