/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sequences behind a shift or a scrambling, in natural order or that of Gray's code, from any first point up to 2^16.
 *
 * What a shift modulo 1 leaves alone are differences of points, and what every nested permutation leaves alone is the
 * number of leading digits that two points share. So for each first point p the differences between point p and the
 * points 1 to 12 and some further ones after it are compared with those of the sample, in up to three coordinates;
 * nearly all p fail at the first.
 * Those that pass are compared in full (scramble.c).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "identify/sample.h"

enum { FIRSTS = 1 << 16, PAIRS = 24, NEAR = 12, SCANNED = 3, ATTEMPTS = 8, SHOWN = 5 };

typedef struct scan {
    koksma__sample *s;
    const koksma__source *source;
    bool gray, digits;               /* digits: test for nested permutations, else for a shift */
    bool digitwise;                  /* with digits: each digit by itself */
    koksma__coordinate *coordinates; /* of the sequence, as many as the sample has */
    uint64_t *indices;
} scan;

static uint64_t index_at(const scan *c, uint64_t position)
{
    return c->gray ? koksma__gray(position) : position;
}

/* The number of leading digits that a and b have in common, of `known` ones. */
static int common_digits(const koksma__coordinate *c, uint64_t a, uint64_t b, int known)
{
    if (c->base == 2) {
        const int common = a ^ b ? __builtin_clzll(a ^ b) - (64 - c->digits) : c->digits;
        return common < known ? common : known;
    }
    for (int l = 0; l < known; l++) {
        const uint64_t unit = c->powers[c->digits - 1 - l];
        if (a / unit != b / unit) {
            return l;
        }
    }
    return known;
}

/* Whether points 0 and i of the sample differ in coordinate k as do a and b, coordinates of the sequence. */
static bool alike(const scan *c, const koksma__coordinate *coordinate, int k, size_t i, uint64_t a, uint64_t b)
{
    const double x = koksma__x(c->s, 0, (size_t)k), y = koksma__x(c->s, i, (size_t)k), tolerance = c->s->tolerance;
    if (!c->digits) {
        const double theirs = ((double)b - (double)a) / coordinate->whole;
        return fabs(koksma__turn(y - x - theirs)) <= 2 * tolerance + 0x1p-50;
    }
    for (int level = 1; level <= coordinate->digits; level++) {
        const double scale = (double)coordinate->powers[level], margin = 2 * tolerance * scale;
        if (margin > .01 || scale > 4. * (double)c->s->points.n) {
            return true;
        }
        const double u = floor(x * scale + margin), v = floor(y * scale + margin);
        const bool same = u <= v && u >= v, same_there = common_digits(coordinate, a, b, level) == level;
        if (same != same_there) {
            const double rest_x = fabs(x * scale - nearbyint(x * scale)),
                         rest_y = fabs(y * scale - nearbyint(y * scale));
            return tolerance > 0x1p-49 && (rest_x < margin || rest_y < margin); /* left open by rounding */
        }
        if (!same) {
            return true;
        }
    }
    return true;
}

/* Whether each digit of the first points of coordinate k depends only on that digit of the sequence. */
static bool is_digitwise(const scan *c, const koksma__coordinate *coordinate, int k, uint64_t first)
{
    enum { BASES = 32, LEVELS = 8 };
    signed char maps[LEVELS][BASES];
    memset(maps, -1, sizeof maps);
    const size_t n = c->s->points.n < 2 * PAIRS ? c->s->points.n : 2 * PAIRS;
    for (size_t i = 0; i < n && coordinate->base <= BASES; i++) {
        uint64_t theirs = koksma__numerator(coordinate, index_at(c, first + i));
        for (int l = 0; l < LEVELS && l < coordinate->digits; l++) {
            const double scale = (double)coordinate->powers[l + 1], margin = 2 * c->s->tolerance * scale;
            if (margin > .01) {
                break;
            }
            const uint64_t unit = coordinate->powers[coordinate->digits - 1 - l], digit = theirs / unit;
            const signed char ours =
                (signed char)((uint64_t)(koksma__x(c->s, i, (size_t)k) * scale + margin) % coordinate->base);
            theirs %= unit;
            if (maps[l][digit] >= 0 && maps[l][digit] != ours) {
                return false;
            }
            maps[l][digit] = ours;
        }
    }
    return true;
}

/* Returns the index of the other point of a pair: 1 to NEAR, then about twice the last each time. */
static size_t partner(const scan *c, size_t pair)
{
    const size_t n = c->s->points.n, far = pair > NEAR ? ((size_t)NEAR << (pair - NEAR)) + pair % 3 : pair;
    return pair < PAIRS && far < n ? far : n - 1;
}

/* Whether the coordinates k < `most` pass the first comparisons with the sequence from `first` on. */
static bool may_begin(const scan *c, uint64_t first, int most)
{
    for (int k = most - 1; k >= 0; k--) {
        const koksma__coordinate *coordinate = &c->coordinates[k];
        const uint64_t a = koksma__numerator(coordinate, index_at(c, first));
        for (size_t pair = 1; pair <= PAIRS; pair++) {
            const size_t i = partner(c, pair);
            if (!alike(c, coordinate, k, i, a, koksma__numerator(coordinate, index_at(c, first + i)))) {
                return false;
            }
        }
        if (c->digitwise && !is_digitwise(c, coordinate, k, first)) {
            return false;
        }
    }
    return true;
}

static const char *const names[] = {"equal",           "shifted",        "digital-shift", "digit-permutation",
                                    "linear-scramble", "nested-scramble"};

/* Compares all points with the sequence from `first` on, and adds a statement if they are related, and more strongly
   than the one found before. */
static koksma_status compare(scan *c, uint64_t first, bool *related)
{
    koksma__relation weakest = KOKSMA__EQUAL;
    char details[400] = "", text[120];
    const int dim = c->s->points.dim;
    *related = false;
    for (size_t i = 0; i < c->s->points.n; i++) {
        c->indices[i] = index_at(c, first + i);
    }
    for (int k = 0; k < dim; k++) {
        koksma__relation relation;
        KOKSMA__TRY(koksma__ask(c->s->run));
        KOKSMA__TRY(koksma__relate(c->s, k, &c->coordinates[k], c->indices, c->digits, &relation, text));
        weakest = relation > weakest ? relation : weakest;
        if ((int)weakest >= c->s->scramble || weakest == KOKSMA__NO_RELATION) {
            return KOKSMA_OK;
        }
        if (k < SHOWN && *text && relation != KOKSMA__EQUAL && (relation != KOKSMA__LINEAR || !*details)) {
            koksma__append(details, sizeof details, "%s%s", *details ? "; " : ": ", text);
        }
    }
    *related = true;
    c->s->scramble = (int)weakest;
    c->s->found->count = c->s->before;
    static const char *const introductions[] = {[KOKSMA__SHIFTED] = "; shift",
                                                [KOKSMA__DIGITAL_SHIFT] = "; shift",
                                                [KOKSMA__DIGIT_PERMUTATION] = "; digits 0 1 .. become"};
    char what[160];
    snprintf(what, sizeof what, "%s%s", c->source->what, c->gray ? ", Gray order" : "");
    return koksma__say(
        c->s, names[weakest], what, c->gray ? "" : c->source->spec, first, "tested for all %zu points%s%s%s",
        c->s->points.n,
        weakest >= KOKSMA__SHIFTED && weakest <= KOKSMA__DIGIT_PERMUTATION ? introductions[weakest] : "",
        weakest <= KOKSMA__LINEAR ? details : "", weakest < KOKSMA__LINEAR && dim > SHOWN ? "; ..." : "");
}

/* Tries all first points with the coordinates in order. */
static koksma_status scan_firsts(scan *c)
{
    const int dim = c->s->points.dim, most = dim < SCANNED ? dim : SCANNED;
    int attempts = 0;
    for (uint64_t first = 0; first < FIRSTS && attempts < ATTEMPTS; first++) {
        if (first % 4096 == 0) {
            KOKSMA__TRY(koksma__ask(c->s->run));
        }
        if (may_begin(c, first, most)) {
            bool related;
            attempts++;
            KOKSMA__TRY(compare(c, first, &related));
            attempts = related ? ATTEMPTS : attempts;
        }
    }
    return KOKSMA_OK;
}

/* Compares with one source in all ways. */
static koksma_status compare_source(scan *c)
{
    koksma_status status = KOKSMA_OK;
    for (int way = 0; way < 6 && !status && c->s->scramble > KOKSMA__SHIFTED; way++) {
        c->digits = way % 3 > 0;
        c->digitwise = way % 3 == 1;
        c->gray = way / 3;
        if (!c->gray || c->coordinates[0].directions) {
            status = scan_firsts(c);
        }
    }
    return status;
}

koksma_status koksma__identify_scrambled(koksma__sample *s)
{
    const koksma__source *source;
    const int dim = s->points.dim;
    if (s->points.n < KOKSMA__LEAST_SCRAMBLED) {
        return KOKSMA_OK;
    }
    scan c = {.s = s, .indices = malloc(s->points.n * sizeof *c.indices)};
    KOKSMA__REQUIRE_MEMORY(c.indices, s->points.n * sizeof *c.indices);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; (source = koksma__source_at(i)) && !status; i++) {
        if (dim <= source->dims) {
            c.source = source;
            status = koksma__coordinates_init(source, dim, dim, &c.coordinates);
            status = status ? status : compare_source(&c);
            koksma__coordinates_fini(c.coordinates, dim);
        }
    }
    free(c.indices);
    return status;
}
