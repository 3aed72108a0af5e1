/* SPDX-License-Identifier: Apache-2.0 */
/* Multiplies a matrix of 32 x 32 bits with the words of many points, modulo 2. With AVX2 each product is looked up in
   tables for 4 bits by byte shuffles. */
#include <string.h>

#include "kernels/kernels.h"

enum { POINTS = 32 };

#ifdef __AVX2__
#include <immintrin.h>

/* Tables for the byte shuffle, which looks up for 32 points at once the contribution of four bits of a word to one
   byte of the result. */
typedef struct tables {
    /* entry [j][k] is the contribution of byte j to byte k: the low half for the low four bits of byte j, the high half
       for its high four bits */
    __m256i bytes[4][4];
} tables;

/* Transposes, within each 128-bit half, the 4 x 4 matrix of 4-byte words of four vectors. The function is its own
   inverse. */
static inline __attribute__((always_inline)) void transpose(__m256i v[4])
{
    const __m256i a = _mm256_unpacklo_epi32(v[0], v[1]), b = _mm256_unpackhi_epi32(v[0], v[1]);
    const __m256i c = _mm256_unpacklo_epi32(v[2], v[3]), d = _mm256_unpackhi_epi32(v[2], v[3]);
    v[0] = _mm256_unpacklo_epi64(a, c);
    v[1] = _mm256_unpackhi_epi64(a, c);
    v[2] = _mm256_unpacklo_epi64(b, d);
    v[3] = _mm256_unpackhi_epi64(b, d);
}

/* Within each group of four words it puts the first bytes first, then the second, third and fourth bytes. The
   function is its own inverse. */
static inline __attribute__((always_inline)) void sort_bytes(__m256i v[4])
{
    const __m256i order =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15));
    for (int k = 0; k < 4; k++) {
        v[k] = _mm256_shuffle_epi8(v[k], order);
    }
}

static void make_tables(const uint32_t *directions, tables *t)
{
    for (int j = 0; j < 4; j++) {
        const uint32_t *d = directions + 8 * j, *e = d + 4;
        const uint32_t first[8] = {0, d[0], d[1], d[0] ^ d[1], 0, e[0], e[1], e[0] ^ e[1]};
        const __m256i third = _mm256_setr_m128i(_mm_set1_epi32((int)d[2]), _mm_set1_epi32((int)e[2]));
        const __m256i fourth = _mm256_setr_m128i(_mm_set1_epi32((int)d[3]), _mm_set1_epi32((int)e[3]));
        __m256i *v = t->bytes[j];
        memcpy(v, first, sizeof first);
        v[1] = _mm256_xor_si256(v[0], third);
        v[2] = _mm256_xor_si256(v[0], fourth);
        v[3] = _mm256_xor_si256(v[1], fourth);
        sort_bytes(v);
        transpose(v);
    }
}

static inline void multiply(const tables *t, const uint32_t *index, uint32_t *out)
{
    const __m256i nibble = _mm256_set1_epi8(15);
    __m256i v[4], x[4];
    memcpy(v, index, sizeof v);
    sort_bytes(v);
    transpose(v);
    for (int j = 0; j < 4; j++) {
        const __m256i low = _mm256_and_si256(v[j], nibble);
        const __m256i high = _mm256_and_si256(_mm256_srli_epi16(v[j], 4), nibble);
        for (int k = 0; k < 4; k++) {
            const __m256i of_low = _mm256_permute2x128_si256(t->bytes[j][k], t->bytes[j][k], 0x00);
            const __m256i of_high = _mm256_permute2x128_si256(t->bytes[j][k], t->bytes[j][k], 0x11);
            const __m256i sum =
                _mm256_xor_si256(_mm256_shuffle_epi8(of_low, low), _mm256_shuffle_epi8(of_high, high));
            x[k] = j ? _mm256_xor_si256(x[k], sum) : sum;
        }
    }
    transpose(x);
    sort_bytes(x);
    memcpy(out, x, sizeof x);
}

#else

typedef struct tables {
    const uint32_t *directions;
} tables;

static void make_tables(const uint32_t *directions, tables *t)
{
    t->directions = directions;
}

static inline void multiply(const tables *t, const uint32_t *index, uint32_t *out)
{
    uint32_t x[POINTS] = {0}, j[POINTS];
    memcpy(j, index, sizeof j);
    for (int b = 0; b < 32; b++) {
        const uint32_t direction = t->directions[b];
        for (int l = 0; l < POINTS; l++) {
            x[l] ^= direction & (0u - (j[l] >> b & 1u));
        }
    }
    memcpy(out, x, sizeof x);
}

#endif

void KERNEL_NAME(digital_at)(size_t count, const uint32_t *index, const uint32_t *directions, uint32_t *out)
{
    tables t;
    make_tables(directions, &t);
    size_t i = 0;
    for (; i + POINTS <= count; i += POINTS) {
        multiply(&t, index + i, out + i);
    }
    if (i < count) {
        uint32_t last[POINTS] = {0};
        memcpy(last, index + i, (count - i) * sizeof *last);
        multiply(&t, last, last);
        memcpy(out + i, last, (count - i) * sizeof *out);
    }
}
