/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Owen's nested uniform scrambling of a digital sequence in base b, by stochastic generation (Helmer, Christensen &
 * Kensler 2021). If each coordinate is a (0,1)-sequence, each of its strata of width b^-l contains one of the first
 * b^l points, called r, and for each d with 0 < d < b one of the points d b^l .. (d + 1) b^l - 1, called d b^l + r'.
 * Digit l of r is known from its value. The points d b^l + r', which are called the relatives of r, get the other b - 1
 * digits, drawn without replacement, and uniform digits below. The groups of relatives of level l are disjoint, and
 * every number is computed once: O(n) for each coordinate.
 *
 * r' is r plus d times a vector, digit by digit modulo b, without carries. Tables of about sqrt(b^l) entries for each
 * d give the sums for the lower and the upper half of the digits of r.
 *
 * Coordinates are multiples of b^-M, where b^M is the largest power of b up to 2^53, and are stored as whole numbers
 * in doubles. For each coordinate of a point 64 random bits are drawn, as a fraction in [0,1). The fraction is
 * multiplied by the number of remaining digits: the whole part of the product chooses one of these digits, and the
 * fractional part gives the digits below.
 */
#include "patterns/nets/nets.h"

#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { MANY = 4096, PACKED = 16 };

typedef struct job {
    uint64_t seed;
    uint32_t base;
    koksma__owen_relatives relatives;
    const void *context;
    koksma_points *out;
} job;

/* The tables of one level: relative d of r = y * size[0] + x is point low[x * base + d] + high[y * base + d]. */
typedef struct level {
    size_t step, size[2];
    double width; /* width of the strata of the next level, in units of b^-M */
    size_t *low, *high;
} level;

typedef struct column {
    const job *job;
    double *v; /* the column; before a number is computed, its memory contains its random bits */
    uint16_t *order, *picked;
} column;

/* Returns floor(x) for 0 <= x < 2^53. Without SSE 4.1 the library function floor would be a function call. */
static inline double whole_part(double x)
{
    return (double)(int64_t)x;
}

/* Turns 64 random bits into a choice below `count`, which is returned, and a whole number below `width`. */
static inline uint32_t choose(const double *bits, uint32_t count, double width, double *below)
{
    uint32_t word[2];
    memcpy(word, bits, sizeof word);
    const uint64_t product = (uint64_t)word[0] * count;
    const uint64_t fraction = product << 32 | word[1];
    *below = (double)(int64_t)koksma__upper_half(fraction, (uint64_t)width);
    return (uint32_t)(product >> 32);
}

/* Returns the digit of v whose place value is `width`. *prefix receives the number formed by the higher digits, times
   base. */
static inline uint32_t digit_of(double v, double width, uint32_t base, double *prefix)
{
    const double upper = whole_part(v / width);
    *prefix = whole_part(upper / base) * base;
    return (uint32_t)(upper - *prefix);
}

/* Computes the relatives of r (see the top of the file) in bases up to 16. The digits that are not drawn yet are stored
   as 4-bit parts of one word. low, high: the rows of r in the tables of the level. */
static inline void place_packed(const column *c, const level *l, size_t r, const size_t *low, const size_t *high)
{
    const uint32_t base = c->job->base;
    const size_t n = c->job->out->n;
    double prefix;
    const uint32_t own = digit_of(c->v[r], l->width, base, &prefix);
    uint64_t order = (0xfedcba9876543210u & ~((uint64_t)15 << 4 * own) & ~(uint64_t)15) | own;
    for (uint32_t d = 1; d < base; d++) {
        const size_t i = low[d] + high[d];
        if (i >= n) {
            break; /* relatives with larger d have larger indices */
        }
        double below;
        const uint32_t pick = d + choose(&c->v[i], base - d, l->width, &below);
        const uint64_t digit = order >> 4 * pick & 15, kept = order >> 4 * d & 15;
        order ^= (digit ^ kept) << 4 * pick;
        c->v[i] = (prefix + (double)(int64_t)digit) * l->width + below;
    }
}

static inline void place_many(const column *c, const level *l, size_t r, const size_t *low, const size_t *high)
{
    const uint32_t base = c->job->base;
    const size_t n = c->job->out->n;
    double prefix;
    const uint32_t own = digit_of(c->v[r], l->width, base, &prefix);
    uint32_t d = 1;
    c->order[own] = 0;
    c->order[0] = (uint16_t)own;
    for (; d < base && low[d] + high[d] < n; d++) {
        double below, *v = &c->v[low[d] + high[d]];
        const uint32_t pick = d + choose(v, base - d, l->width, &below);
        const uint16_t digit = c->order[pick];
        c->order[pick] = c->order[d];
        c->order[d] = digit;
        c->picked[d] = (uint16_t)pick;
        *v = (prefix + digit) * l->width + below;
    }
    while (--d) { /* restores the identity permutation */
        const uint16_t digit = c->order[d];
        c->order[d] = c->order[c->picked[d]];
        c->order[c->picked[d]] = digit;
    }
    c->order[0] = 0;
    c->order[own] = (uint16_t)own;
}

static void place_level(const column *c, const level *l)
{
    const size_t base = c->job->base;
    for (size_t r = 0; r < l->step; r++) {
        const size_t *low = l->low + r % l->size[0] * base, *high = l->high + r / l->size[0] * base;
        if (base <= PACKED) {
            place_packed(c, l, r, low, high);
        } else {
            place_many(c, l, r, low, high);
        }
    }
}

/* Fills one table of a level: map[a * base + d] = d * last + unit * a', for each a of `count` digits, where digit c
   of a' is that of a plus d * digits[c] modulo base. */
static void fill_map(uint32_t base, const uint32_t *digits, int count, size_t unit, size_t last, size_t *map)
{
    for (uint32_t d = 0; d < base; d++) {
        size_t done = 1, place = unit;
        map[d] = d * last;
        for (int c = 0; c < count; c++, place *= base) {
            const uint32_t add = d * digits[c] % base;
            for (uint32_t a = base; a-- > 0;) {
                for (size_t i = done; i-- > 0;) {
                    map[(a * done + i) * base + d] = map[i * base + d] + (a + add) % base * place;
                }
            }
            done *= base;
        }
    }
}

static koksma_status place_all_levels(const column *c, int k, double whole)
{
    const job *j = c->job;
    level l = {.step = 1, .width = whole};
    uint32_t digits[KOKSMA__OWEN_DIGITS];
    for (int count = 0; l.step < j->out->n; count++, l.step *= j->base) {
        l.width /= j->base;
        l.size[0] = l.size[1] = 1;
        for (int h = 0; h < count; h++) {
            l.size[h % 2] *= j->base;
        }
        const size_t entries = (l.size[0] + l.size[1]) * j->base;
        l.low = malloc(entries * sizeof *l.low);
        KOKSMA__REQUIRE_MEMORY(l.low, entries * sizeof *l.low);
        l.high = l.low + l.size[0] * j->base;
        j->relatives(j->context, k, count, digits);
        fill_map(j->base, digits, (count + 1) / 2, 1, l.step, l.low);
        fill_map(j->base, digits + (count + 1) / 2, count / 2, l.size[0], 0, l.high);
        place_level(c, &l);
        free(l.low);
    }
    return KOKSMA_OK;
}

static koksma_status fill(void *context, size_t k)
{
    const job *j = context;
    const size_t n = j->out->n, dim = (size_t)j->out->dim;
    uint16_t order[KOKSMA_MAX_DIM + 1], picked[KOKSMA_MAX_DIM + 1];
    double whole = j->base, *v = malloc((n + 1) * sizeof *v);
    KOKSMA__REQUIRE_MEMORY(v, (n + 1) * sizeof *v);
    while (whole * j->base <= 0x1p53) {
        whole *= j->base;
    }
    for (uint32_t a = 0; a < j->base; a++) {
        order[a] = (uint16_t)a;
    }
    koksma__kernels()->words(j->seed, KOKSMA__PURPOSE_SCRAMBLE, 0, (uint32_t)k, (n + 1) / 2, (uint32_t *)v);
    choose(&v[0], 1, whole, &v[0]);
    const column c = {j, v, order, picked};
    const koksma_status status = place_all_levels(&c, (int)k, whole);
    for (size_t i = 0; i < n && !status; i++) {
        j->out->xs[i * dim + k] = v[i] / whole;
    }
    free(v);
    return status;
}

koksma_status koksma__owen_sequence(uint64_t seed, uint32_t base, koksma__owen_relatives relatives,
                                    const void *context, const koksma_run *run, koksma_points *out)
{
    job j = {seed, base, relatives, context, out};
    if (out->n >= MANY) {
        return koksma__parallel(run, (size_t)out->dim, fill, &j);
    }
    koksma_status status = KOKSMA_OK;
    for (size_t k = 0; k < (size_t)out->dim && !status; k++) {
        status = fill(&j, k);
    }
    return status;
}
