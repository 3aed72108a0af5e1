/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of modifiers: maps of the cube to itself that any pattern takes after its own parameters. Each row lists
 * the claims of a pattern (claims.def) and the measures that the modifier preserves; patterns/modify.c has the
 * maps, in the same order. tests/core/test_modifiers.c tests every entry for every pattern.
 */
#include "core/spec.h"

#include <stdbool.h>
#include <string.h>

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

static const koksma_modifier rows[] = {
    {"owen", "nested uniform scrambling of binary digits (1), or none (0)", "owen1995", 1, 1, true,
     OF_DIGITS | OF_GROUPS, OF_CELLS, KOKSMA_CLAIM_UNBIASED, "t-value",
     "the number of points in each elementary interval in base 2: nets, their t-value, and strata if n is a power "
     "of 2"},
    {"digital-shift", "xor of the binary digits with those of one random point (1), or none (0)", "lecuyer2002", 1, 1,
     true, OF_DIGITS | OF_GROUPS, OF_CELLS, KOKSMA_CLAIM_UNBIASED, "t-value",
     "the number of points in each elementary interval in base 2: nets, their t-value, and strata if n is a power "
     "of 2"},
    {"axes", "a random order of the coordinates (1), or none (0)", "-", 1, 1, true, OF_CUBE, 0, 0, "*",
     "the values of all measures, and all strata that are the same for every order of the coordinates"},
    {"mirror", "each coordinate reflected about 1/2 or not, at random (1), or none (0)", "-", 1, 1, true,
     OF_CUBE | OF_GROUPS, 0, 0, MIRROR_MEASURES,
     "strata, distances, and all measures except star, l2-star and l2-modified, which depend on the corner 0"},
    {"phase", "shifted on the torus by the random vector of this seed (1 or more), or not (0)", "cranley1976", 1,
     UINT32_MAX, false, ON_TORUS | KOKSMA_CLAIM_DETERMINISTIC, 0, 0, TORUS_MEASURES,
     "distances and measures on the torus (l2-periodic, diaphony, disk), and lattices; the shift is the same for "
     "every seed of the pattern"},
    {"shift", "shifted on the torus by one random vector (1), or not (0)", "cranley1976", 1, 1, true, ON_TORUS, 0,
     KOKSMA_CLAIM_UNBIASED, TORUS_MEASURES,
     "distances and measures on the torus (l2-periodic, diaphony, disk), and lattices"},
    {"owen-base", "nested uniform scrambling of the digits in this base (2 to 64), or none (0)", "owen1995", 2,
     KOKSMA__MOST_BASE, true,
     KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_UNBIASED | KOKSMA_CLAIM_EXCHANGEABLE, 0,
     KOKSMA_CLAIM_UNBIASED, "",
     "the number of points in each elementary interval in that base: nets in that base and their t-value"},
    {"tent", "the tent (baker's) transform 1 - |2 x - 1| of each coordinate (1), or none (0)", "hickernell2002", 1, 1,
     false,
     KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_UNBIASED | KOKSMA_CLAIM_EXCHANGEABLE |
         KOKSMA_CLAIM_DETERMINISTIC,
     0, 0, "", "the uniform distribution of each random point; the map does not depend on the seed"},
};

enum { COUNT = sizeof rows / sizeof *rows };

_Static_assert((int)COUNT == (int)KOKSMA__MODIFIERS, "every modifier has a row");

_Static_assert((int)COUNT <= (int)KOKSMA_MAX_MODIFIERS, "koksma_spec has capacity for all modifiers");

const koksma_modifier *koksma_modifier_at(size_t i)
{
    return i < COUNT ? &rows[i] : NULL;
}

bool koksma__modifiers_are_random(const double *values)
{
    bool random = false;
    for (size_t i = 0; i < COUNT; i++) {
        random = random || (values[i] > 0 && rows[i].random);
    }
    return random;
}

bool koksma__modifiers_of_digits(const double *values)
{
    bool digits = false;
    for (size_t i = 0; i < COUNT; i++) {
        digits = digits || (values[i] > 0 && rows[i].claims_binary);
    }
    return digits;
}

unsigned koksma__claims_left(const koksma_spec *spec, size_t n)
{
    unsigned claims = spec->pattern->claims;
    for (size_t i = 0; i < COUNT; i++) {
        if (spec->modifiers[i] > 0) {
            claims &= rows[i].claims | (n & (n - 1) ? 0 : rows[i].claims_binary);
            claims |= rows[i].gives;
        }
    }
    return claims;
}

/* A value of 0 means that the modifier is not applied; the ranges of most modifiers begin at 1. */
koksma_param koksma__modifier_param(size_t i)
{
    const koksma_modifier *m = &rows[i];
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
            const size_t length = strlen(rows[i].name);
            found = found || (!strncmp(key, rows[i].name, length) && key[length] == '=');
        }
        if (*at == ',' && !found) {
            break;
        }
        end = found ? at : end;
    }
    return end;
}
