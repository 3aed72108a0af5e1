/* SPDX-License-Identifier: Apache-2.0 */
/* Nested uniform (Owen) scrambling in a small odd base, for several strata at once. Each stratum contains one point
   that is known and its relatives: points that agree with it in the digits before the current one
   (patterns/nets/owen_digits.c). The digits that have not been drawn yet are stored as the 4-bit parts of one word.
   Coordinates are stored as whole numbers below 2^53 in doubles; the arguments of lanes64_floor are below 2^52, as it
   requires. */
#include <string.h>

#include "core/random.h"
#include "kernels/kernels.h"
#include "kernels/lanes64.h"

enum { CHAINS = 2, LANES = CHAINS * LANES64 };

#define EVERY_DIGIT 0xfedcba9876543210u

typedef struct strata {
    lanes64_d prefix[CHAINS]; /* the digits above the current one, as a multiple of the base */
    lanes64_u order[CHAINS];  /* digit number d begins at bit 4 d; number 0 is the digit of the point itself */
} strata;

/* to_doubles converts the low 32 bits of each lane to a double. to_words is its inverse: it converts whole doubles below
   2^32 to words. */
static inline lanes64_d to_doubles(lanes64_u x)
{
    return (lanes64_d)lanes64_halves(x, lanes64_splat(0x4330000000000000u)) - 0x1p52;
}

static inline lanes64_u to_words(lanes64_d x)
{
    return (lanes64_u)(x + 0x1p52) & 0xffffffffu;
}

static inline lanes64_u chosen(lanes64_i mask, lanes64_u x, lanes64_u y)
{
    return ((lanes64_u)mask & x) | (~(lanes64_u)mask & y);
}

static inline __attribute__((always_inline)) void look_at(uint32_t base, double width, const double *v, strata *s)
{
    const double inverse = 1 / width, part = 1.0 / base;
    const lanes64_d one = lanes64_splat_d(1);
    for (int c = 0; c < CHAINS; c++) {
        lanes64_d x;
        memcpy(&x, v + c * LANES64, sizeof x);
        /* The estimated quotient is off by at most one, and its product with width is exact. */
        lanes64_d upper = lanes64_floor(x * inverse);
        const lanes64_d rest = x - upper * width;
        upper += lanes64_masked((lanes64_i)(rest >= width), one) - lanes64_masked((lanes64_i)(rest < 0), one);
        s->prefix[c] = lanes64_floor((upper + 0.5) * part) * base;
        const lanes64_u digit = to_words(upper - s->prefix[c]);
        if (base == 3) { /* the order digit, digit + 1, digit + 2 modulo 3 */
            const lanes64_u two = chosen((lanes64_i)(digit == 1), lanes64_splat(0x021), lanes64_splat(0x102));
            s->order[c] = chosen((lanes64_i)(digit == 0), lanes64_splat(0x210), two);
        } else {
            s->order[c] = ((EVERY_DIGIT & ~(lanes64_splat(15) << 4 * digit)) & ~lanes64_splat(15)) | digit;
        }
    }
}

/* Writes relative number d of each stratum to v, where each number on entry has two random words for it. */
static inline __attribute__((always_inline)) void place(uint32_t base, uint32_t d, double width, strata *s, double *v)
{
    const double part = width * 0x1p-32;
    for (int c = 0; c < CHAINS; c++) {
        lanes64_u w, digit = s->order[c] >> 4 * d & 15;
        memcpy(&w, v + c * LANES64, sizeof w);
        if (base - d > 1) {
            const lanes64_u product =
                (lanes64_u)lanes64_product((lanes64)lanes64_even_words(w), (lanes64)lanes64_splat(base - d));
            const lanes64_u pick = ((product >> 32) + d) << 2, kept = digit;
            digit = s->order[c] >> pick & 15;
            s->order[c] ^= (digit ^ kept) << pick; /* entry d is not read again and stays */
        }
        const lanes64_d below = lanes64_floor(part * to_doubles(lanes64_odd_words(w)));
        const lanes64_d x = (s->prefix[c] + to_doubles(digit)) * width + below;
        memcpy(v + c * LANES64, &x, sizeof x);
    }
}

static inline __attribute__((always_inline)) void place_all(uint32_t base, uint32_t relatives, size_t count,
                                                            double width, const double *xs, double *const *v)
{
    for (size_t r = 0; r + LANES <= count; r += LANES) {
        strata s;
        look_at(base, width, xs + r, &s);
        for (uint32_t d = 1; d <= relatives; d++) {
            place(base, d, width, &s, v[d - 1] + r);
        }
    }
}

static double whole_part(double x)
{
    return (double)(int64_t)x;
}

static void place_one(uint32_t base, uint32_t relatives, size_t r, double width, double x, double *const *v)
{
    const double upper = whole_part(x / width), prefix = whole_part(upper / base) * base;
    const uint32_t digit0 = (uint32_t)(upper - prefix);
    uint64_t order = (EVERY_DIGIT & ~((uint64_t)15 << 4 * digit0) & ~(uint64_t)15) | digit0;
    if (base == 3) {
        order = digit0 == 0 ? 0x210 : digit0 == 1 ? 0x021 : 0x102;
    }
    for (uint32_t d = 1; d <= relatives; d++) {
        uint32_t word[2];
        memcpy(word, &v[d - 1][r], sizeof word);
        const uint32_t pick = d + koksma__below(word[0], base - d);
        const uint64_t digit = order >> 4 * pick & 15, kept = order >> 4 * d & 15;
        order ^= (digit ^ kept) << 4 * pick;
        v[d - 1][r] = (prefix + (double)(int32_t)digit) * width + whole_part(width * (word[1] * 0x1p-32));
    }
}

void KERNEL_NAME(nested_digits)(uint32_t base, uint32_t relatives, size_t count, double width, const double *xs,
                                double *const *v)
{
    if (base == 3 && relatives == 1) {
        place_all(3, 1, count, width, xs, v);
    } else if (base == 3) {
        place_all(3, 2, count, width, xs, v);
    } else {
        place_all(base, relatives, count, width, xs, v);
    }
    for (size_t r = count / LANES * LANES; r < count; r++) {
        place_one(base, relatives, r, width, xs[r], v);
    }
}
