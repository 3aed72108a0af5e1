/* SPDX-License-Identifier: Apache-2.0 */
/* SHA-256 (FIPS 180-4, section 6.2): blocks of 64 bytes are mixed into a state of eight words by 64 rounds. The
   constants are the first 32 bits of the fractional parts of the cube roots of the first 64 primes, and of the square
   roots of the first eight. */
#include "core/hash.h"

#include <string.h>

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

static void mix(uint32_t state[8], const unsigned char block[64])
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
