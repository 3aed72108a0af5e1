/* SPDX-License-Identifier: Apache-2.0 */
/* Philox4x32-10 on vectors of counters, each word in the lower half of a 64-bit lane. Same bits as Random123's
   (Salmon et al. 2011), which the reference twin calls. */
#include <string.h>

#include "kernels/kernels.h"
#include "kernels/lanes64.h"

/* Independent chains hide the multiplier's latency, about as many as the registers hold. */
enum { CHAINS = LANES64 == 8 ? 4 : LANES64 == 4 ? 3 : 2, LANES = CHAINS * LANES64 };

typedef struct block {
    lanes64_u w[4][CHAINS]; /* the upper halves of the lanes are garbage */
} block;

void KERNEL_NAME(uniform)(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, double *out);
void KERNEL_NAME(words)(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, uint32_t *out);

static inline lanes64_u splat(uint64_t x)
{
    return x - (lanes64_u){0};
}

#define INLINE static inline __attribute__((always_inline)) /* once for each number of chains */

INLINE block philox(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, int chains)
{
    block s;
    for (int c = 0; c < chains; c++) {
        s.w[0][c] = lanes64_count() + splat(first + (uint64_t)(c * LANES64));
        s.w[1][c] = s.w[0][c] >> 32;
        s.w[2][c] = splat(lane);
        s.w[3][c] = splat(purpose);
    }
    lanes64_u k0 = splat((uint32_t)seed), k1 = splat(seed >> 32);
    const lanes64 m0 = (lanes64)splat(0xD2511F53u), m1 = (lanes64)splat(0xCD9E8D57u);
    for (int round = 0; round < 10; round++) {
        for (int c = 0; c < chains; c++) {
            const lanes64_u p0 = (lanes64_u)lanes64_product((lanes64)s.w[0][c], m0);
            const lanes64_u p1 = (lanes64_u)lanes64_product((lanes64)s.w[2][c], m1);
            s.w[0][c] = (p1 >> 32) ^ s.w[1][c] ^ k0;
            s.w[1][c] = p1;
            s.w[2][c] = (p0 >> 32) ^ s.w[3][c] ^ k1;
            s.w[3][c] = p0;
        }
        k0 += splat(0x9E3779B9u);
        k1 += splat(0xBB67AE85u);
    }
    return s;
}

/* koksma__unit: (high * 2^21 + low / 2^11) * 2^-53, as an exact sum of two doubles. Integers below 2^52 become
   doubles by way of the mantissa of 2^52. */
static inline lanes64_d unit(lanes64_u high, lanes64_u low)
{
    const lanes64_u exponent = splat(0x4330000000000000u);
    const lanes64_d offset = (lanes64_d)exponent;
    const lanes64_d h = (lanes64_d)((high & splat(0xffffffffu)) | exponent) - offset;
    const lanes64_d l = (lanes64_d)(((low & splat(0xffffffffu)) >> 11) | exponent) - offset;
    return h * 0x1p-32 + l * 0x1p-53;
}

/* The pairs of a block, in order. */
INLINE void store_units(const block *r, int chains, double *out)
{
    for (int c = 0; c < chains; c++, out += 2 * LANES64) {
        const lanes64_d x = unit(r->w[0][c], r->w[1][c]), y = unit(r->w[2][c], r->w[3][c]);
        lanes64_interleave(x, y, out);
    }
}

INLINE void units(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, int chains, double *out)
{
    const block r = philox(seed, purpose, first, lane, chains);
    store_units(&r, chains, out);
}

void KERNEL_NAME(uniform)(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, double *out)
{
    size_t done = 0;
    for (; done + LANES <= count; done += LANES) {
        units(seed, purpose, first + done, lane, CHAINS, out + 2 * done);
    }
    if (CHAINS > 2 && done + 2 * LANES64 <= count) {
        units(seed, purpose, first + done, lane, 2, out + 2 * done);
        done += 2 * LANES64;
    }
    for (; done + LANES64 <= count; done += LANES64) {
        units(seed, purpose, first + done, lane, 1, out + 2 * done);
    }
    if (done < count) {
        double pairs[2 * LANES64];
        units(seed, purpose, first + done, lane, 1, pairs);
        memcpy(out + 2 * done, pairs, 2 * (count - done) * sizeof *out);
    }
}

/* The words of a block, in order; two make a lane. */
INLINE void store_words(const block *r, int chains, uint32_t *out)
{
    const lanes64_u lower = splat(0xffffffffu);
    for (int c = 0; c < chains; c++, out += 4 * LANES64) {
        const lanes64_u x = (r->w[0][c] & lower) | r->w[1][c] << 32, y = (r->w[2][c] & lower) | r->w[3][c] << 32;
        lanes64_interleave((lanes64_d)x, (lanes64_d)y, out);
    }
}

INLINE void quads(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, int chains, uint32_t *out)
{
    const block r = philox(seed, purpose, first, lane, chains);
    store_words(&r, chains, out);
}

void KERNEL_NAME(words)(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, uint32_t *out)
{
    size_t done = 0;
    for (; done + LANES <= count; done += LANES) {
        quads(seed, purpose, first + done, lane, CHAINS, out + 4 * done);
    }
    if (CHAINS > 2 && done + 2 * LANES64 <= count) {
        quads(seed, purpose, first + done, lane, 2, out + 4 * done);
        done += 2 * LANES64;
    }
    for (; done + LANES64 <= count; done += LANES64) {
        quads(seed, purpose, first + done, lane, 1, out + 4 * done);
    }
    if (done < count) {
        uint32_t last[4 * LANES64];
        quads(seed, purpose, first + done, lane, 1, last);
        memcpy(out + 4 * done, last, 4 * (count - done) * sizeof *out);
    }
}
