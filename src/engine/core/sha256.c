/* SPDX-License-Identifier: Apache-2.0 */
/* SHA-256 (FIPS 180-4, section 6.2): blocks of 64 bytes are mixed into a state of eight words by 64 rounds. The
   constants are the first 32 bits of the fractional parts of the cube roots of the first 64 primes, and of the square
   roots of the first eight. If an x86 processor has instructions for SHA-256, one of which does two rounds, hashing
   is eight times as fast. They are not used if the environment has KOKSMA_KERNELS=ref or =baseline. */
#include "core/hash.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#ifdef KOKSMA_X86_KERNELS
#include <cpuid.h>
#include <immintrin.h>
#endif

static const uint32_t constants[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static inline uint32_t rotate(uint32_t x, int n)
{
    return x >> n | x << (32 - n);
}

/* Computes round k, given modulo 8. The working variables a to h stay in place while their names rotate: a is s[-k]
   and h is s[7 - k], with indices modulo 8. */
static inline void mix_round(uint32_t s[8], unsigned k, uint32_t add)
{
    const uint32_t a = s[(8 - k) % 8], b = s[(9 - k) % 8], c = s[(10 - k) % 8];
    const uint32_t e = s[(12 - k) % 8], f = s[(13 - k) % 8], g = s[(14 - k) % 8];
    const uint32_t t = s[(15 - k) % 8] + (rotate(e, 6) ^ rotate(e, 11) ^ rotate(e, 25)) + ((e & f) ^ (~e & g)) + add;
    s[(11 - k) % 8] += t;
    s[(15 - k) % 8] = t + (rotate(a, 2) ^ rotate(a, 13) ^ rotate(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
}

static void mix_plain(uint32_t state[8], const unsigned char block[64])
{
    uint32_t w[64], s[8];
    for (int i = 0; i < 16; i++) {
        const unsigned char *b = &block[4 * i];
        w[i] = (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
    }
    for (int i = 16; i < 64; i++) {
        const uint32_t a = w[i - 15], b = w[i - 2];
        w[i] = w[i - 16] + (rotate(a, 7) ^ rotate(a, 18) ^ a >> 3) + w[i - 7] +
               (rotate(b, 17) ^ rotate(b, 19) ^ b >> 10);
    }
    memcpy(s, state, sizeof s);
    for (int i = 0; i < 64; i += 8) { /* rotating the indices of a to h saves moving their values */
        mix_round(s, 0, constants[i] + w[i]);
        mix_round(s, 1, constants[i + 1] + w[i + 1]);
        mix_round(s, 2, constants[i + 2] + w[i + 2]);
        mix_round(s, 3, constants[i + 3] + w[i + 3]);
        mix_round(s, 4, constants[i + 4] + w[i + 4]);
        mix_round(s, 5, constants[i + 5] + w[i + 5]);
        mix_round(s, 6, constants[i + 6] + w[i + 6]);
        mix_round(s, 7, constants[i + 7] + w[i + 7]);
    }
    for (int i = 0; i < 8; i++) {
        state[i] += s[i];
    }
}

#ifdef KOKSMA_X86_KERNELS
#define WITH_SHA __attribute__((target("sha,sse4.1,ssse3")))

/* The state in the order that the instructions need: words a, b, e, f in one register and c, d, g, h in the other,
   beginning with the highest word. */
typedef struct lanes {
    __m128i abef, cdgh;
} lanes;

/* Four rounds with four words of the message. */
WITH_SHA static inline void mix_4(lanes *s, __m128i words, const uint32_t *add)
{
    const __m128i sum = _mm_add_epi32(words, _mm_loadu_si128((const __m128i *)(const void *)add));
    s->cdgh = _mm_sha256rnds2_epu32(s->cdgh, s->abef, sum);
    s->abef = _mm_sha256rnds2_epu32(s->abef, s->cdgh, _mm_shuffle_epi32(sum, 0x0e));
}

/* Computes the next four words of the message from the last 16; w[0] has the oldest four. */
WITH_SHA static inline __m128i next_4(__m128i w0, __m128i w1, __m128i w2, __m128i w3)
{
    return _mm_sha256msg2_epu32(_mm_add_epi32(_mm_sha256msg1_epu32(w0, w1), _mm_alignr_epi8(w3, w2, 4)), w3);
}

WITH_SHA static void mix_fast(uint32_t state[8], const unsigned char block[64])
{
    const __m128i big_endian = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
    __m128i *const halves = (__m128i *)(void *)state, w[4];
    const __m128i cdab = _mm_shuffle_epi32(_mm_loadu_si128(halves), 0xb1);
    const __m128i efgh = _mm_shuffle_epi32(_mm_loadu_si128(halves + 1), 0x1b);
    const lanes before = {_mm_alignr_epi8(cdab, efgh, 8), _mm_blend_epi16(efgh, cdab, 0xf0)};
    lanes s = before;
    for (int i = 0; i < 4; i++) {
        w[i] = _mm_shuffle_epi8(_mm_loadu_si128((const __m128i *)(const void *)(block + 16 * i)), big_endian);
        mix_4(&s, w[i], &constants[4 * i]);
    }
    for (int i = 16; i < 64; i += 16) {
        w[0] = next_4(w[0], w[1], w[2], w[3]);
        mix_4(&s, w[0], &constants[i]);
        w[1] = next_4(w[1], w[2], w[3], w[0]);
        mix_4(&s, w[1], &constants[i + 4]);
        w[2] = next_4(w[2], w[3], w[0], w[1]);
        mix_4(&s, w[2], &constants[i + 8]);
        w[3] = next_4(w[3], w[0], w[1], w[2]);
        mix_4(&s, w[3], &constants[i + 12]);
    }
    const __m128i feba = _mm_shuffle_epi32(_mm_add_epi32(s.abef, before.abef), 0x1b);
    const __m128i dchg = _mm_shuffle_epi32(_mm_add_epi32(s.cdgh, before.cdgh), 0xb1);
    _mm_storeu_si128(halves, _mm_blend_epi16(feba, dchg, 0xf0));
    _mm_storeu_si128(halves + 1, _mm_alignr_epi8(dchg, feba, 8));
}

static bool can_mix_fast(void)
{
    const char *wish = getenv("KOKSMA_KERNELS");
    unsigned a, b, c, d;
    return (!wish || (strcmp(wish, "ref") != 0 && strcmp(wish, "baseline") != 0)) &&
           __builtin_cpu_supports("sse4.1") && __get_cpuid_count(7, 0, &a, &b, &c, &d) && b >> 29 & 1;
}

static void mix(uint32_t state[8], const unsigned char block[64])
{
    static atomic_int fast = -1; /* -1: unknown */
    int use = atomic_load_explicit(&fast, memory_order_relaxed);
    if (use < 0) {
        use = can_mix_fast();
        atomic_store_explicit(&fast, use, memory_order_relaxed);
    }
    (use ? mix_fast : mix_plain)(state, block);
}
#else
static void mix(uint32_t state[8], const unsigned char block[64])
{
    mix_plain(state, block);
}
#endif

void koksma__sha256_init(koksma__sha256 *h)
{
    *h = (koksma__sha256){
        .state = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19}};
}

void koksma__sha256_add(koksma__sha256 *h, const void *bytes, size_t size)
{
    for (const unsigned char *from = bytes; size;) {
        const size_t used = h->size % 64, n = size < 64 - used ? size : 64 - used;
        memcpy(h->block + used, from, n);
        h->size += n;
        from += n;
        size -= n;
        if (h->size % 64 == 0) {
            mix(h->state, h->block);
        }
    }
}

void koksma__sha256_finish(koksma__sha256 *h, char text[KOKSMA__SHA256_TEXT])
{
    static const unsigned char padding[64] = {0x80};
    const uint64_t bits = 8 * h->size;
    unsigned char end[8];
    koksma__sha256_add(h, padding, 1 + (119 - h->size % 64) % 64);
    for (int i = 0; i < 8; i++) {
        end[i] = (unsigned char)(bits >> (56 - 8 * i));
    }
    koksma__sha256_add(h, end, sizeof end);
    for (int i = 0; i < 64; i++) {
        text[i] = "0123456789abcdef"[h->state[i / 8] >> (28 - 4 * (i % 8)) & 15];
    }
    text[64] = '\0';
}
