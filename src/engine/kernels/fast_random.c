/* SPDX-License-Identifier: Apache-2.0 */
/* The random generator Philox4x32-10 (for the kernel `draws` with 7 rounds) on vectors of counters, with each word in
   the lower half of a 64-bit lane. It gives the same bits as the Random123 library (Salmon et al. 2011), which the
   reference calls. */
#include <string.h>

#include "core/random.h"
#include "kernels/kernels.h"
#include "kernels/lanes64.h"

/* CHAINS independent vectors are computed together to hide the latency of multiplication. About this number of
   vectors fits into the registers. The last few numbers use fewer vectors. */
enum {
    CHAINS = LANES64 == 8   ? 4
             : LANES64 == 4 ? 3
                            : 2,
    LANES = CHAINS * LANES64,
    ROUNDS = 8 /* the rounds after the first two */,
    DRAW_ROUNDS = 5
};

/* The four words of LANES counters. Lanes are in the order of lanes64_count_pairs unless a comment names another
   order. Their upper halves are meaningless. */
typedef struct block {
    lanes64_u w[4][CHAINS];
} block;

/* The parts of the first two rounds that are equal for all counters that differ only in their lowest word: w2_of_0 is
   xored into w[2] in round 0, w0_of_1 into w[0] and w2_of_1 into w[2] in round 1, and w3_of_1 is w[3] after round 1.
   keys: the keys of the other rounds, as memory operands that need no load instruction. */
typedef struct stream {
    lanes64_u w2_of_0, w0_of_1, w2_of_1, w3_of_1, keys[ROUNDS][2];
} stream;

static const uint32_t multiplier[2] = {0xD2511F53u, 0xCD9E8D57u}, weyl[2] = {0x9E3779B9u, 0xBB67AE85u};

/* Makes the stream of the counters whose second word is `high`. Not inlined, because compilers would otherwise build
   its vectors again in each round. */
static __attribute__((noinline)) void make_stream(uint64_t seed, uint32_t purpose, uint32_t high, uint32_t lane,
                                                  int rounds, stream *out)
{
    uint32_t k0 = (uint32_t)seed, k1 = (uint32_t)(seed >> 32);
    const uint64_t p1 = (uint64_t)lane * multiplier[1];
    const uint32_t w0 = (uint32_t)(p1 >> 32) ^ high ^ k0, w1 = (uint32_t)p1;
    out->w2_of_0 = lanes64_splat(purpose ^ k1);
    k0 += weyl[0];
    k1 += weyl[1];
    const uint64_t p0 = (uint64_t)w0 * multiplier[0];
    out->w0_of_1 = lanes64_splat(w1 ^ k0);
    out->w2_of_1 = lanes64_splat((uint32_t)(p0 >> 32) ^ k1);
    out->w3_of_1 = lanes64_splat((uint32_t)p0);
    for (int round = 0; round < rounds; round++) {
        out->keys[round][0] = lanes64_splat(k0 += weyl[0]);
        out->keys[round][1] = lanes64_splat(k1 += weyl[1]);
    }
}

#define INLINE                                                                                                       \
    static inline __attribute__((always_inline)) /* inlined, so that there is one copy for each number of
                                                               chains */

/* The function begin does the first two rounds, and go_on does one of the others. */
INLINE block begin(const stream *s, lanes64_u order, uint64_t first, int chains)
{
    const lanes64 m0 = (lanes64)lanes64_splat(multiplier[0]), m1 = (lanes64)lanes64_splat(multiplier[1]);
    block b;
    for (int c = 0; c < chains; c++) {
        const lanes64_u counter = order + lanes64_splat(first + (uint64_t)(c * LANES64));
        const lanes64_u p0 = (lanes64_u)lanes64_product((lanes64)counter, m0);
        const lanes64_u p1 = (lanes64_u)lanes64_product((lanes64)((p0 >> 32) ^ s->w2_of_0), m1);
        b.w[0][c] = (p1 >> 32) ^ s->w0_of_1;
        b.w[1][c] = p1;
        b.w[2][c] = p0 ^ s->w2_of_1;
        b.w[3][c] = s->w3_of_1;
    }
    return b;
}

INLINE void go_on(const stream *s, int round, int chains, block *b)
{
    const lanes64 m0 = (lanes64)lanes64_splat(multiplier[0]), m1 = (lanes64)lanes64_splat(multiplier[1]);
    for (int c = 0; c < chains; c++) {
        const lanes64_u p0 = (lanes64_u)lanes64_product((lanes64)b->w[0][c], m0);
        const lanes64_u p1 = (lanes64_u)lanes64_product((lanes64)b->w[2][c], m1);
        b->w[0][c] = (p1 >> 32) ^ (b->w[1][c] ^ s->keys[round][0]);
        b->w[1][c] = p1;
        b->w[2][c] = (p0 >> 32) ^ (b->w[3][c] ^ s->keys[round][1]);
        b->w[3][c] = p0;
    }
}

INLINE block philox_in(const stream *s, lanes64_u order, uint64_t first, int chains, int rounds)
{
    block b = begin(s, order, first, chains);
    for (int round = 0; round < rounds; round++) {
        go_on(s, round, chains, &b);
    }
    return b;
}

INLINE block philox(const stream *s, uint64_t first, int chains)
{
    return philox_in(s, lanes64_count_pairs(), first, chains, ROUNDS);
}

typedef uint32_t words_of_lanes __attribute__((vector_size(8 * LANES64)));

/* Does the same as koksma__unit in each lane: returns (high * 2^21 + low / 2^11) * 2^-53 as an exact sum of two
   doubles. The doubles 2^20 + high 2^-32 and 1/2 + (low / 2^11) 2^-53 have high and low / 2^11 as the low bits of
   their mantissas. */
static inline lanes64_d unit(lanes64_u high, lanes64_u low)
{
    const lanes64_u upper = lanes64_splat(0x4130000000000000u), lower = lanes64_splat(0x3fe0000000000000u);
    const lanes64_d h = (lanes64_d)lanes64_halves(high, upper) - 0x1p20;
    const lanes64_d l = (lanes64_d)lanes64_halves((lanes64_u)((words_of_lanes)low >> 11), lower) - 0x1p-1;
    return h + l;
}

/* Stores the pairs x[l], y[l], in the order of the counters. */
INLINE void store_pairs(lanes64_d x, lanes64_d y, void *out)
{
    lanes64_d low, high;
    lanes64_pairs(x, y, &low, &high);
    memcpy(out, &low, sizeof low);
    memcpy((char *)out + sizeof low, &high, sizeof high);
}

/* Stores the pairs of doubles of a block, in the order of the counters. */
INLINE void store_units(const block *b, int chains, double *out)
{
    for (int c = 0; c < chains; c++, out += 2 * LANES64) {
        store_pairs(unit(b->w[0][c], b->w[1][c]), unit(b->w[2][c], b->w[3][c]), out);
    }
}

/* Stores the words of a block, in the order of the counters; two words fill a lane. */
INLINE void store_words(const block *b, int chains, uint32_t *out)
{
    for (int c = 0; c < chains; c++, out += 4 * LANES64) {
        const lanes64_u x = lanes64_words(b->w[0][c], b->w[1][c]);
        const lanes64_u y = lanes64_words(b->w[2][c], b->w[3][c]);
        store_pairs((lanes64_d)x, (lanes64_d)y, out);
    }
}

/* Returns how many of the counters first .. first + count - 1 have the same second word as `first`. */
static size_t share(uint64_t first, size_t count)
{
    const uint64_t left = ((uint64_t)1 << 32) - (uint32_t)first;
    return count < left ? count : (size_t)left;
}

INLINE void units(const stream *s, uint64_t first, int chains, double *out)
{
    const block b = philox(s, first, chains);
    store_units(&b, chains, out);
}

static void uniform(const stream *s, uint64_t first, size_t count, double *out)
{
    size_t done = 0;
    for (; done + LANES <= count; done += LANES) {
        units(s, first + done, CHAINS, out + 2 * done);
    }
    if (CHAINS > 2 && done + 2 * LANES64 <= count) {
        units(s, first + done, 2, out + 2 * done);
        done += 2 * LANES64;
    }
    for (; done + LANES64 <= count; done += LANES64) {
        units(s, first + done, 1, out + 2 * done);
    }
    if (done < count) {
        double pairs[2 * LANES64];
        units(s, first + done, 1, pairs);
        memcpy(out + 2 * done, pairs, 2 * (count - done) * sizeof *out);
    }
}

void KERNEL_NAME(uniform)(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, double *out)
{
    while (count) {
        const size_t some = share(first, count);
        stream s;
        make_stream(seed, purpose, (uint32_t)(first >> 32), lane, ROUNDS, &s);
        uniform(&s, first, some, out);
        first += some;
        count -= some;
        out += 2 * some;
    }
}

INLINE void quads(const stream *s, uint64_t first, int chains, int rounds, uint32_t *out)
{
    const block b = philox_in(s, lanes64_count_pairs(), first, chains, rounds);
    store_words(&b, chains, out);
}

/* room: `out` has capacity for whole vectors beyond the last number. */
INLINE void some_words(const stream *s, uint64_t first, size_t count, int rounds, bool room, uint32_t *out)
{
    size_t done = 0;
    for (; done + LANES <= count; done += LANES) {
        quads(s, first + done, CHAINS, rounds, out + 4 * done);
    }
    if (room && CHAINS > 2 && done + 2 * LANES64 < count &&
        count <= done + 3 * LANES64) { /* all remaining numbers at once */
        quads(s, first + done, 3, rounds, out + 4 * done);
        return;
    }
    if (CHAINS > 2 && done + 2 * LANES64 <= count) {
        quads(s, first + done, 2, rounds, out + 4 * done);
        done += 2 * LANES64;
    }
    for (; done + LANES64 <= count; done += LANES64) {
        quads(s, first + done, 1, rounds, out + 4 * done);
    }
    if (done < count && room) {
        quads(s, first + done, 1, rounds, out + 4 * done);
    } else if (done < count) {
        uint32_t last[4 * LANES64];
        quads(s, first + done, 1, rounds, last);
        memcpy(out + 4 * done, last, 4 * (count - done) * sizeof *out);
    }
}

INLINE void all_words(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, int rounds,
                      uint32_t *out)
{
    while (count) {
        const size_t some = share(first, count);
        stream s;
        make_stream(seed, purpose, (uint32_t)(first >> 32), lane, rounds, &s);
        some_words(&s, first, some, rounds, rounds == DRAW_ROUNDS, out);
        first += some;
        count -= some;
        out += 4 * some;
    }
}

void KERNEL_NAME(words)(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, uint32_t *out)
{
    all_words(seed, purpose, first, lane, count, ROUNDS, out);
}

void KERNEL_NAME(draws)(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, uint32_t *out)
{
    all_words(seed, purpose, first, lane, count, DRAW_ROUNDS, out);
}

/* Stores koksma__below(word, first + i + 1) for word number i of a block, in order: the upper half of the product. */
INLINE void store_below(const block *b, uint32_t first, int chains, uint32_t *out)
{
    lanes64_u bound = 4 * lanes64_count_pairs() + lanes64_splat(first + 1);
    for (int c = 0; c < chains; c++, out += 4 * LANES64, bound += lanes64_splat(4 * LANES64)) {
        lanes64_u product[4];
        for (int k = 0; k < 4; k++) {
            product[k] =
                (lanes64_u)lanes64_product((lanes64)b->w[k][c], (lanes64)(bound + lanes64_splat((uint64_t)k)));
        }
        const lanes64_u x = lanes64_upper_words(product[0], product[1]);
        const lanes64_u y = lanes64_upper_words(product[2], product[3]);
        store_pairs((lanes64_d)x, (lanes64_d)y, out);
    }
}

/* Adds the numbers first .. first + count - 1 to a random permutation by the inside-out Fisher-Yates shuffle. */
INLINE void insert(const uint32_t *at, uint32_t first, uint32_t count, uint32_t *out)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t j = at[i];
        out[first + i] = out[j];
        out[j] = first + i;
    }
}

/* The time to compute random numbers is limited by the latency of multiplications, the time to insert them into the
   permutation by the caches. To overlap the two, each round of one block's random numbers is followed by inserting a
   part of the previous block. */
void KERNEL_NAME(permutation)(uint64_t seed, uint32_t lane, uint32_t n, uint32_t *out)
{
    enum { WORDS = 4 * LANES, SHARE = WORDS / ROUNDS };
    uint32_t at[WORDS];
    stream s;
    make_stream(seed, KOKSMA__PURPOSE_SHUFFLE, 0, lane, ROUNDS, &s);
    block b = philox(&s, 0, CHAINS);
    uint32_t first = 0;
    for (; n - first > WORDS; first += WORDS) {
        store_below(&b, first, CHAINS, at);
        b = begin(&s, lanes64_count_pairs(), (first + WORDS) / 4, CHAINS);
#pragma GCC unroll 8
        for (int round = 0; round < ROUNDS; round++) {
            go_on(&s, round, CHAINS, &b);
            insert(at + round * SHARE, first + (uint32_t)round * SHARE, SHARE, out);
        }
    }
    store_below(&b, first, CHAINS, at);
    insert(at, first, n - first, out);
}

/* Returns (cell + word 2^-32) / n, exactly if n is a power of two. The upper half of `upper` has the cell and the
   exponent of base = 2^20. With the word in the lower half it is therefore the double base + cell + word 2^-32. If n
   is a power of two, base is 2^20 / n instead, which divides the whole sum by n. */
INLINE lanes64_d place(lanes64_u word, lanes64_u upper, lanes64_d base, lanes64_d n, bool power_of_two)
{
    const lanes64_d x = (lanes64_d)lanes64_halves(word, upper) - base;
    return power_of_two ? x : x / n;
}

/* Makes the first points of rooks_2d, as many as fill whole blocks, and returns their number. Unlike in_cell it does
   not compare the quotient with the cell's end: for n <= 2^20 the quotient is below the end also after rounding,
   because the two are at least 2^-52 apart, and the double before 1 is 1 - 2^-53. Each counter gives two points,
   which are stored as a row of four numbers. */
INLINE size_t place_rooks(const stream *s, const uint32_t *rows, size_t first, size_t count, double n,
                          bool power_of_two, double *xs)
{
    const lanes64_d base = lanes64_splat_d(power_of_two ? 0x1p20 / n : 0x1p20), whole = lanes64_splat_d(n);
    const lanes64_u exponent = (lanes64_u)base, exponents = exponent | exponent >> 32;
    const lanes64_u one = lanes64_splat((uint64_t)1 << 32);
    lanes64_u column = (2 * lanes64_count() + lanes64_splat(first)) << 32 | exponent;
    size_t i = 0;
    while (i + 2 * LANES <= count) {
        const block b = philox_in(s, lanes64_count(), (first + i) / 2, CHAINS, ROUNDS);
        for (int c = 0; c < CHAINS; c++, i += 2 * LANES64, column += lanes64_splat((uint64_t)2 * LANES64 << 32)) {
            lanes64_u pair;
            memcpy(&pair, rows + i, sizeof pair);
            pair |= exponents;
            const lanes64_d points[4] = {place(b.w[0][c], column, base, whole, power_of_two),
                                         place(b.w[1][c], lanes64_even_upper(pair), base, whole, power_of_two),
                                         place(b.w[2][c], column + one, base, whole, power_of_two),
                                         place(b.w[3][c], lanes64_odd_upper(pair), base, whole, power_of_two)};
            lanes64_store_rows(points, 4, false, xs + 2 * i);
        }
    }
    return i;
}

/* Returns the same as koksma__in_cell of patterns/grids/grids.h. */
static double in_cell(double cell, uint32_t word, double n)
{
    const double x = (cell + word * 0x1p-32) / n, end = (cell + 1) / n;
    return x < end ? x : end * (1 - 0x1p-53);
}

void KERNEL_NAME(rooks_2d)(uint64_t seed, const uint32_t *rows, size_t first, size_t count, size_t n, double *xs)
{
    enum { SOME = 2 * LANES };
    stream s;
    make_stream(seed, KOKSMA__PURPOSE_POINT, 0, 0, ROUNDS, &s);
    size_t i = 0;
    if (n <= (size_t)1 << 20) {
        i = (n & (n - 1)) == 0 ? place_rooks(&s, rows, first, count, (double)n, true, xs)
                               : place_rooks(&s, rows, first, count, (double)n, false, xs);
    }
    for (; i < count; i += SOME) {
        const block b = philox(&s, (first + i) / 2, CHAINS);
        uint32_t word[4 * LANES];
        store_words(&b, CHAINS, word);
        for (size_t p = 0; p < SOME && i + p < count; p++) {
            xs[2 * (i + p)] = in_cell((double)(first + i + p), word[2 * p], (double)n);
            xs[2 * (i + p) + 1] = in_cell((double)rows[i + p], word[2 * p + 1], (double)n);
        }
    }
}

/* The same as a stream, for counters whose two lowest words both vary: w0_of_0 is xored into w[0] in round 0, and
   key_of_1 is the key of w[2] in round 1. w2_of_1 and w3_of_1 of the stream are not used, because they hold only for
   counters below 2^32. */
typedef struct tree {
    stream s;
    lanes64_u w0_of_0, key_of_1;
} tree;

/* Computes the random words of the nodes in `low`, which are the generator's counters: replaces them by words 0 and
   1, and writes words 2 and 3 to `high`. */
INLINE void nested_words(const tree *t, int chains, lanes64_u *low, lanes64_u *high)
{
    const lanes64 m0 = (lanes64)lanes64_splat(multiplier[0]), m1 = (lanes64)lanes64_splat(multiplier[1]);
    block b;
    for (int c = 0; c < chains; c++) {
        const lanes64_u p = (lanes64_u)lanes64_product((lanes64)low[c], m0);
        const lanes64_u p0 = (lanes64_u)lanes64_product((lanes64)((low[c] >> 32) ^ t->w0_of_0), m0);
        const lanes64_u p1 = (lanes64_u)lanes64_product((lanes64)((p >> 32) ^ t->s.w2_of_0), m1);
        b.w[0][c] = (p1 >> 32) ^ t->s.w0_of_1;
        b.w[1][c] = p1;
        b.w[2][c] = (p0 >> 32) ^ (p ^ t->key_of_1);
        b.w[3][c] = p0;
    }
    for (int round = 0; round < ROUNDS; round++) {
        go_on(&t->s, round, chains, &b);
    }
    for (int c = 0; c < chains; c++) {
        low[c] = lanes64_halves(b.w[0][c], b.w[1][c] << 32);
        high[c] = lanes64_halves(b.w[2][c], b.w[3][c] << 32);
    }
}

/* Returns `flips`, the flips of the digits before the node, followed by the result of koksma__nested_flips, in each
   lane. */
INLINE lanes64_u nested_flips(lanes64_u low, lanes64_u high, lanes64_u path, lanes64_u flips)
{
    const lanes64_u one = lanes64_splat(1), leaf = (path & 127) | 128;
    flips = (flips + flips) | (low >> 1 & one);
    for (int level = 1; level < 6; level++) {
        flips = (flips + flips) | (lanes64_shifted(low, leaf >> (7 - level)) & one);
    }
    return (flips + flips) | (lanes64_shifted(high, (leaf >> 1) - 64) & one);
}

/* Flips the digits of `chains` vectors of points. */
INLINE void nested_points(const tree *t, const koksma__nested_node *first, int chains, uint64_t *x)
{
    enum { DIGITS = KOKSMA__NESTED_DIGITS + KOKSMA__NESTED_SPARE, LEVELS = KOKSMA__NESTED_LEVELS };
    lanes64_u digits[CHAINS], flips[CHAINS], low[CHAINS], high[CHAINS];
    for (int c = 0; c < chains; c++) {
        memcpy(&digits[c], x + c * LANES64, sizeof *digits);
        digits[c] <<= KOKSMA__NESTED_SPARE;
        const lanes64_u node = digits[c] >> (DIGITS - LEVELS);
        flips[c] = nested_flips(lanes64_of_triples(&first->low, node), lanes64_of_triples(&first->high, node),
                                digits[c] >> (DIGITS - 2 * LEVELS), lanes64_of_triples(&first->flips, node));
    }
    for (int left = DIGITS - 2 * LEVELS; left > 0; left -= LEVELS) { /* digits after the node */
        for (int c = 0; c < chains; c++) {
            low[c] = (digits[c] >> left) | lanes64_splat((uint64_t)1 << (DIGITS - left));
        }
        nested_words(t, chains, low, high);
        for (int c = 0; c < chains; c++) {
            flips[c] = nested_flips(low[c], high[c], digits[c] >> (left - LEVELS), flips[c]);
        }
    }
    for (int c = 0; c < chains; c++) {
        digits[c] = (digits[c] ^ flips[c]) >> KOKSMA__NESTED_SPARE;
        memcpy(x + c * LANES64, &digits[c], sizeof *digits);
    }
}

_Static_assert(sizeof(koksma__nested_node) == 3 * sizeof(uint64_t), "nodes are triples");

void KERNEL_NAME(nested_bits)(uint64_t seed, uint32_t lane, const koksma__nested_node *first, size_t count,
                              uint64_t *x)
{
    tree t;
    make_stream(seed, KOKSMA__PURPOSE_NESTED, 0, lane, ROUNDS, &t.s);
    t.w0_of_0 = lanes64_splat((uint32_t)((uint64_t)lane * multiplier[1] >> 32) ^ (uint32_t)seed);
    t.key_of_1 = lanes64_splat((uint32_t)(seed >> 32) + weyl[1]);
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        nested_points(&t, first, CHAINS, x + i);
    }
    for (; i + LANES64 <= count; i += LANES64) {
        nested_points(&t, first, 1, x + i);
    }
    if (i < count) {
        uint64_t last[LANES64];
        for (size_t l = 0; l < LANES64; l++) {
            last[l] = x[i + l < count ? i + l : i]; /* pads with x[i], whose node is in `first` */
        }
        nested_points(&t, first, 1, last);
        memcpy(x + i, last, (count - i) * sizeof *x);
    }
}
