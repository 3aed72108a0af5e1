/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The maps of the modifiers, whose names and properties core/modifiers.c has:
 *
 *     shift          x + u modulo 1, u uniform in [0,1)^dim                         (Cranley & Patterson 1976)
 *     phase=K        x + u modulo 1 with the u that shift has for seed K, independent of the pattern's seed
 *     digital-shift  the binary digits of x_k, xor those of u_k                     (L'Ecuyer & Lemieux 2002)
 *     owen           digit m of x_k is flipped by a random bit, a different one for each value of the digits before it:
 *                    nested uniform scrambling in base 2                            (Owen 1995)
 *     axes           x_k becomes x_p(k), p a random permutation
 *     mirror         x_k becomes 1 - 2^-53 - x_k or stays, with probability 1/2 each
 *     owen-base=B    owen's scrambling in base B: digit m goes through a random permutation, a different one for each
 *                    value of the digits before it
 *     tent           x_k becomes 1 - |2 x_k - 1| (the baker's or tent transform), but at most 1 - 2^-53. A lattice
 *                    with shift and then tent has errors near n^-2 for smooth functions, even if they are not
 *                    periodic (Hickernell 2002)
 *
 * The first 53 digits are scrambled. owen hashes each node of the tree of digits (a string of leading digits) to a
 * random bit: one call of the generator gives the 127 bits of the seven levels below a node. mirror flips all 53
 * digits, so that half-open strata map to half-open strata.
 */
#include "patterns/patterns.h"

#include <stdbool.h>
#include <string.h>

#include "core/random.h"
#include "core/spec.h"
#include "kernels/kernels.h"

enum { DIGITS = KOKSMA__NESTED_DIGITS };

static uint64_t digits_of(double x)
{
    return (uint64_t)(x * 0x1p53);
}

/* Sets first[d] for the nodes of 7 digits that the digits x[0] .. x[count - 1] pass, where `known` is not set yet. */
static void look_at_first(uint64_t seed, uint32_t k, koksma__words root, size_t count, const uint64_t *x, bool *known,
                          koksma__nested_node *first)
{
    for (size_t i = 0; i < count; i++) {
        const size_t d = (size_t)(x[i] >> (DIGITS - KOKSMA__NESTED_LEVELS));
        if (!known[d]) {
            first[d] = koksma__nested_node_of(koksma__nested_words(seed, x[i], KOKSMA__NESTED_LEVELS, k));
            first[d].flips = koksma__nested_flips(koksma__nested_node_of(root), d);
            known[d] = true;
        }
    }
}

/* Scrambles one coordinate of all points. The random bits of the nodes of 0 and of 7 digits, which many points share,
   are computed once and stored. */
static void scramble_column(uint64_t seed, uint32_t k, koksma_points *points)
{
    enum { BLOCK = 288 }; /* a multiple of the points that the kernel takes at once, for each instruction set */
    koksma__nested_node first[1 << KOKSMA__NESTED_LEVELS];
    bool known[1 << KOKSMA__NESTED_LEVELS] = {false};
    const koksma__words root = koksma__nested_words(seed, 0, 0, k);
    const size_t dim = (size_t)points->dim;
    uint64_t x[BLOCK];
    for (size_t done = 0; done < points->n; done += BLOCK) {
        double *xs = points->xs + done * dim + k;
        const size_t count = points->n - done < BLOCK ? points->n - done : BLOCK;
        for (size_t i = 0; i < count; i++) {
            x[i] = digits_of(xs[i * dim]);
        }
        look_at_first(seed, k, root, count, x, known, first);
        koksma__kernels()->nested_bits(seed, k, first, count, x);
        for (size_t i = 0; i < count; i++) {
            xs[i * dim] = (double)(int64_t)x[i] * 0x1p-53;
        }
    }
}

static void scramble(uint64_t seed, double value, koksma_points *points)
{
    (void)value;
    for (int k = 0; k < points->dim; k++) {
        scramble_column(seed, (uint32_t)k, points);
    }
}

/* Returns the digits of x in a base as an integer. x is the double nearest to, or just above, a multiple of
   base^-digits, as in nets. */
static uint64_t digits_in_base(double x, double scale)
{
    const uint64_t floor = (uint64_t)(x * scale);
    return floor + ((double)(floor + 1) / scale <= x) - ((double)floor / scale > x);
}

/* Returns the image of a digit under the permutation at a node of the tree of digits: a Fisher-Yates shuffle with one
   call of the generator for each position. */
static uint32_t permuted(uint64_t seed, uint32_t lane, uint64_t node, uint32_t base, uint32_t digit)
{
    uint32_t order[KOKSMA__MOST_BASE];
    koksma__words r = {{0}};
    for (uint32_t i = 0; i < base; i++) {
        order[i] = i;
    }
    for (uint32_t i = base - 1, draw = 0; i > 0; i--, draw++) {
        r = draw % 4 ? r : koksma__random(seed, KOKSMA__PURPOSE_BASE, node, lane << 8 | draw / 4);
        const uint32_t j = koksma__below(r.w[draw % 4], i + 1), moved = order[i];
        order[i] = order[j];
        order[j] = moved;
    }
    return order[digit];
}

static void scramble_in_base(uint64_t seed, double value, koksma_points *points)
{
    const uint32_t base = (uint32_t)value;
    const size_t dim = (size_t)points->dim;
    uint64_t powers[DIGITS + 1] = {1};
    int digits = 0;
    for (; base > 1 && powers[digits] <= (UINT64_C(1) << DIGITS) / base; digits++) {
        powers[digits + 1] = powers[digits] * base;
    }
    const double scale = (double)powers[digits];
    for (size_t c = 0; c < points->n * dim; c++) {
        const uint64_t x = digits_in_base(points->xs[c], scale);
        uint64_t y = 0;
        /* number of the node whose path is the preceding digits; nodes of shorter paths have lower numbers */
        for (int m = 0; m < digits; m++) {
            const uint64_t before = x / powers[digits - m], digit = x / powers[digits - m - 1] % base;
            y = y * base +
                permuted(seed, (uint32_t)(c % dim), before + (powers[m] - 1) / (base - 1), base, (uint32_t)digit);
        }
        points->xs[c] = (double)y / scale;
    }
}

static void flip_digits(uint64_t seed, double value, koksma_points *points)
{
    (void)value;
    for (int k = 0; k < points->dim; k++) {
        const koksma__words r = koksma__random(seed, KOKSMA__PURPOSE_DIGITS, 0, (uint32_t)k);
        const uint64_t u = digits_of(koksma__unit(r.w[0], r.w[1]));
        for (size_t i = 0; i < points->n; i++) {
            double *x = points->xs + i * (size_t)points->dim + k;
            *x = (double)(digits_of(*x) ^ u) * 0x1p-53;
        }
    }
}

static void permute_axes(uint64_t seed, double value, koksma_points *points)
{
    (void)value;
    uint32_t order[KOKSMA_MAX_DIM];
    double row[KOKSMA_MAX_DIM];
    const size_t dim = (size_t)points->dim;
    koksma__random_permutation(koksma__random_seed(seed, 0, KOKSMA__PURPOSE_AXES), 0, (uint32_t)dim, order);
    for (size_t i = 0; i < points->n; i++) {
        double *x = points->xs + i * dim;
        memcpy(row, x, dim * sizeof *row);
        for (size_t k = 0; k < dim; k++) {
            x[k] = row[order[k]];
        }
    }
}

static void mirror(uint64_t seed, double value, koksma_points *points)
{
    (void)value;
    for (int k = 0; k < points->dim; k++) {
        const bool turned = koksma__random(seed, KOKSMA__PURPOSE_MIRROR, 0, (uint32_t)k).w[0] & 1;
        for (size_t i = 0; turned && i < points->n; i++) {
            double *x = points->xs + i * (size_t)points->dim + k;
            *x = (double)(((uint64_t)1 << DIGITS) - 1 - digits_of(*x)) * 0x1p-53;
        }
    }
}

/* Shifts x by u on the torus; the result is never 1. */
static void shift_by(uint64_t seed, koksma_points *points)
{
    double u[KOKSMA_MAX_DIM + 1];
    for (int k = 0; k < points->dim; k += 2) {
        koksma__random_pair(seed, KOKSMA__PURPOSE_SHIFT, 0, (uint32_t)k, u + k);
    }
    double *x = points->xs;
    for (size_t i = 0; i < points->n; i++) {
        for (int k = 0; k < points->dim; k++, x++) {
            *x += u[k];
            *x -= *x >= 1;
        }
    }
}

static void shift(uint64_t seed, double value, koksma_points *points)
{
    (void)value;
    shift_by(seed, points);
}

static void shift_to_phase(uint64_t seed, double value, koksma_points *points)
{
    (void)seed;
    shift_by((uint64_t)value, points);
}

static void fold(uint64_t seed, double value, koksma_points *points)
{
    (void)seed, (void)value;
    for (size_t c = 0; c < points->n * (size_t)points->dim; c++) {
        const double x = points->xs[c], y = x < 0.5 ? 2 * x : 2 * (1 - x); /* without rounding */
        points->xs[c] = y < 1 ? y : 1 - 0x1p-53;
    }
}

static void (*const maps[KOKSMA__MODIFIERS])(uint64_t seed, double value, koksma_points *points) = {
    [KOKSMA__MODIFIER_OWEN] = scramble,
    [KOKSMA__MODIFIER_DIGITAL_SHIFT] = flip_digits,
    [KOKSMA__MODIFIER_AXES] = permute_axes,
    [KOKSMA__MODIFIER_MIRROR] = mirror,
    [KOKSMA__MODIFIER_PHASE] = shift_to_phase,
    [KOKSMA__MODIFIER_SHIFT] = shift,
    [KOKSMA__MODIFIER_OWEN_BASE] = scramble_in_base,
    [KOKSMA__MODIFIER_TENT] = fold,
};

void koksma__modify(const double *values, uint64_t seed, koksma_points *points)
{
    for (size_t i = 0; i < KOKSMA__MODIFIERS; i++) {
        if (values[i] > 0) {
            maps[i](seed, values[i], points);
        }
    }
}
