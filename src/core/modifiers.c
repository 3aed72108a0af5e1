/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Modifiers: maps of the cube to itself that any pattern takes after its own parameters. Each is one row of the table
 * below, with the claims of a pattern that it preserves; tests/core/test_modifiers.c tests every entry for every
 * pattern.
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
 * The first 53 digits are scrambled. owen hashes the node of the tree of digits to its random bit: one call of the
 * generator gives the 127 bits of the seven levels below a node. mirror flips all 53 digits, so that half-open strata
 * map to half-open strata.
 */
#include "core/modifiers.h"

#include <stdbool.h>
#include <string.h>

#include "core/permutation.h"
#include "core/random.h"
#include "core/status.h"

enum { DIGITS = 53, LEVELS = 7, SPARE = 3, MOST_BASE = 64 }; /* DIGITS + SPARE is a multiple of LEVELS */

#define ON_TORUS                                                                                                     \
    (KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_UNBIASED | KOKSMA_CLAIM_EXCHANGEABLE |                \
     KOKSMA_CLAIM_FRACTION | KOKSMA_CLAIM_MAXIMAL | KOKSMA_CLAIM_LATTICE | KOKSMA_CLAIM_LATTICE_PREFIXES |           \
     KOKSMA_CLAIM_BLUE)
#define OF_DIGITS                                                                                                    \
    (KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_UNBIASED | KOKSMA_CLAIM_EXCHANGEABLE |                \
     KOKSMA_CLAIM_NET2 | KOKSMA_CLAIM_NET2_PREFIXES | KOKSMA_CLAIM_CLASSES)
#define OF_GROUPS (KOKSMA_CLAIM_PAIRS | KOKSMA_CLAIM_QUADRUPLES)
#define OF_CELLS (KOKSMA_CLAIM_LATIN | KOKSMA_CLAIM_GRID | KOKSMA_CLAIM_OA2 | KOKSMA_CLAIM_OA3)
#define OF_CUBE (ON_TORUS | OF_DIGITS | OF_CELLS | KOKSMA_CLAIM_MIN_DISTANCE | KOKSMA_CLAIM_NET_PREFIXES)

#define TORUS_MEASURES "l2-periodic l2-wraparound diaphony min-distance relative-radius disk l2-disk"
#define MIRROR_MEASURES                                                                                              \
    TORUS_MEASURES " l2-extreme l2-centered l2-mixture l2-symmetric extreme edge l2-edge "                           \
                   "t-value"

static uint64_t digits_of(double x)
{
    return (uint64_t)(x * 0x1p53);
}

/* The random words of the node of `top` digits of x. */
static koksma__words words_of_node(uint64_t seed, uint64_t x, int top, uint32_t k)
{
    return koksma__random(seed, KOKSMA__PURPOSE_NESTED, (uint64_t)1 << top | x >> (DIGITS - top), k);
}

/* The random bits of the nodes on the path of LEVELS = 7 digits, the lowest of `path`, below a node with these words:
   bit 2^j + (the first j digits) of the words belongs to level j. */
static uint64_t flips_of(koksma__words r, uint64_t path)
{
    const uint64_t low = r.w[0] | (uint64_t)r.w[1] << 32, high = r.w[2] | (uint64_t)r.w[3] << 32;
    const uint64_t p = path & 127;
    return (low >> 1 & 1) << 6 | (low >> (2 | p >> 6) & 1) << 5 | (low >> (4 | p >> 5) & 1) << 4 |
           (low >> (8 | p >> 4) & 1) << 3 | (low >> (16 | p >> 3) & 1) << 2 | (low >> (32 | p >> 2) & 1) << 1 |
           (high >> (p >> 1) & 1);
}

/* Scrambles one coordinate of all points. The nodes of 0 and of LEVELS digits, which many points share, are kept. */
static void scramble_column(uint64_t seed, uint32_t k, koksma_points *points)
{
    koksma__words first[1 << LEVELS];
    bool known[1 << LEVELS] = {false};
    const koksma__words root = words_of_node(seed, 0, 0, k);
    for (size_t i = 0; i < points->n; i++) {
        double *at = points->xs + i * (size_t)points->dim + k;
        const uint64_t x = digits_of(*at);
        const size_t node_of_first = (size_t)(x >> (DIGITS - LEVELS));
        if (!known[node_of_first]) {
            first[node_of_first] = words_of_node(seed, x, LEVELS, k);
            known[node_of_first] = true;
        }
        uint64_t flips = flips_of(root, x >> (DIGITS - LEVELS)) << LEVELS |
                         flips_of(first[node_of_first], x >> (DIGITS - 2 * LEVELS));
        for (int top = 2 * LEVELS; top < DIGITS; top += LEVELS) { /* the last LEVELS digits end in three zeros */
            flips = flips << LEVELS |
                    flips_of(words_of_node(seed, x, top, k), x << SPARE >> (DIGITS + SPARE - LEVELS - top));
        }
        flips >>= SPARE;
        *at = (double)(x ^ flips) * 0x1p-53;
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
    uint32_t order[MOST_BASE];
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

static const struct {
    koksma_modifier modifier;
    void (*apply)(uint64_t seed, double value, koksma_points *points);
} rows[] = {
    {{"owen", "nested uniform scrambling of binary digits (1), or none (0)", "owen1995", 1, 1, true,
      OF_DIGITS | OF_GROUPS, OF_CELLS, KOKSMA_CLAIM_UNBIASED, "t-value",
      "the number of points in each elementary interval in base 2: nets, their t-value, and strata if n is a power "
      "of 2"},
     scramble},
    {{"digital-shift", "xor of the binary digits with those of one random point (1), or none (0)", "lecuyer2002", 1,
      1, true, OF_DIGITS | OF_GROUPS, OF_CELLS, KOKSMA_CLAIM_UNBIASED, "t-value",
      "the number of points in each elementary interval in base 2: nets, their t-value, and strata if n is a power "
      "of 2"},
     flip_digits},
    {{"axes", "a random order of the coordinates (1), or none (0)", "-", 1, 1, true, OF_CUBE, 0, 0, "*",
      "the values of all measures, and all strata that are the same for every order of the coordinates"},
     permute_axes},
    {{"mirror", "each coordinate reflected about 1/2 or not, at random (1), or none (0)", "-", 1, 1, true,
      OF_CUBE | OF_GROUPS, 0, 0, MIRROR_MEASURES,
      "strata, distances, and all measures except star, l2-star and l2-modified, which depend on the corner 0"},
     mirror},
    {{"phase", "shifted on the torus by the random vector of this seed (1 or more), or not (0)", "cranley1976", 1,
      UINT32_MAX, false, ON_TORUS | KOKSMA_CLAIM_DETERMINISTIC, 0, 0, TORUS_MEASURES,
      "distances and measures on the torus (l2-periodic, diaphony, disk), and lattices; equal for every seed of the "
      "pattern"},
     shift_to_phase},
    {{"shift", "shifted on the torus by one random vector (1), or not (0)", "cranley1976", 1, 1, true, ON_TORUS, 0,
      KOKSMA_CLAIM_UNBIASED, TORUS_MEASURES,
      "distances and measures on the torus (l2-periodic, diaphony, disk), and lattices"},
     shift},
    {{"owen-base", "nested uniform scrambling of the digits in this base (2 to 64), or none (0)", "owen1995", 2,
      MOST_BASE, true, KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_UNBIASED | KOKSMA_CLAIM_EXCHANGEABLE,
      0, KOKSMA_CLAIM_UNBIASED, "",
      "the number of points in each elementary interval in that base: nets in that base and their t-value"},
     scramble_in_base},
    {{"tent", "the tent (baker's) transform 1 - |2 x - 1| of each coordinate (1), or none (0)", "hickernell2002", 1,
      1, false,
      KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_UNBIASED | KOKSMA_CLAIM_EXCHANGEABLE |
          KOKSMA_CLAIM_DETERMINISTIC,
      0, 0, "", "uniformity in the mean; the map does not depend on the seed"},
     fold},
};

enum { COUNT = sizeof rows / sizeof *rows };

_Static_assert((int)COUNT <= (int)KOKSMA_MAX_MODIFIERS, "koksma_spec has capacity for all modifiers");

const koksma_modifier *koksma_modifier_at(size_t i)
{
    return i < COUNT ? &rows[i].modifier : NULL;
}

void koksma__modify(const double *values, uint64_t seed, koksma_points *points)
{
    for (size_t i = 0; i < COUNT; i++) {
        if (values[i] > 0) {
            rows[i].apply(seed, values[i], points);
        }
    }
}

bool koksma__modifiers_are_random(const double *values)
{
    bool random = false;
    for (size_t i = 0; i < COUNT; i++) {
        random = random || (values[i] > 0 && rows[i].modifier.random);
    }
    return random;
}

bool koksma__modifiers_of_digits(const double *values)
{
    bool digits = false;
    for (size_t i = 0; i < COUNT; i++) {
        digits = digits || (values[i] > 0 && rows[i].modifier.claims_binary);
    }
    return digits;
}

unsigned koksma__claims_left(const koksma_spec *spec, size_t n)
{
    unsigned claims = spec->pattern->claims;
    for (size_t i = 0; i < COUNT; i++) {
        if (spec->modifiers[i] > 0) {
            claims &= rows[i].modifier.claims | (n & (n - 1) ? 0 : rows[i].modifier.claims_binary);
            claims |= rows[i].modifier.gives;
        }
    }
    return claims;
}

/* A value of 0 means that the modifier is not applied; the ranges of most modifiers begin at 1. */
koksma_param koksma__modifier_param(size_t i)
{
    const koksma_modifier *m = &rows[i].modifier;
    return (koksma_param){m->name, m->title, 0, m->min > 1 ? m->min : 0, m->max, NULL, true};
}

void koksma__all_params_init(koksma__all_params *all, const koksma_param *own)
{
    *all = (koksma__all_params){.own = 0};
    for (; own && own[all->own].name; all->own++) {
        all->params[all->own] = own[all->own];
    }
    for (size_t i = 0; i < COUNT; i++) {
        all->params[all->own + i] = koksma__modifier_param(i);
    }
}

const char *koksma__modifiers_of_path(const char *text)
{
    const char *end = text + strlen(text);
    for (const char *at = end; at > text; at--) {
        const char *key = at + 1;
        bool found = false;
        for (size_t i = 0; *at == ',' && i < COUNT && key + strcspn(key, "./") >= end; i++) {
            const size_t length = strlen(rows[i].modifier.name);
            found = found || (!strncmp(key, rows[i].modifier.name, length) && key[length] == '=');
        }
        if (*at == ',' && !found) {
            break;
        }
        end = found ? at : end;
    }
    return end;
}
