/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How the digits of one coordinate arise from those of a digital sequence.
 *
 * A nested permutation (Owen 1995) exists if and only if any two points share as many leading digits after it as
 * before. So for each level l the map from the first l digits of the sequence to those of the points is looked up,
 * both ways, for all levels with base^l <= 4 n; further levels of a (0,1)-sequence have no two points to compare.
 * Within the nested permutations the strongest form is sought: one number added to each digit; one permutation for
 * each digit; a linear map, which Gaussian elimination over the digits of the indices gives. All of these predict
 * every digit of every point from a few, and are compared with the points within the tolerance.
 *
 * Rounding may carry into the leading digits of a point. Where the tolerance is more than that of double arithmetic,
 * points near the bound of an interval are first taken to be on it, as those of few digits are; if that fails, they say
 * nothing about that level.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "identify/sample.h"

#define EXACT 0x1p-49 /* tolerances below this one are those of arithmetic in double */

typedef struct relating {
    const koksma__sample *s;
    const koksma__coordinate *c;
    const uint64_t *indices;
    int k, levels; /* levels: digits that the tolerance leaves known */
    size_t n;
    uint64_t *theirs; /* the numerators of the sequence */
    double slack;     /* how far below its first digits a number may be, in units of the last level */
    bool ends;        /* numbers within the tolerance below the bound of an interval are taken to be on it */
    char *text;
} relating;

static double x_of(const relating *r, size_t i)
{
    return koksma__x(r->s, i, (size_t)r->k);
}

/* Returns the first `level` digits of point i as a whole number; *open: whether the tolerance leaves them open. */
static uint64_t digits_of(const relating *r, size_t i, int level, bool *open)
{
    const double scale = (double)r->c->powers[level], x = x_of(r, i) * scale, tolerance = r->s->tolerance;
    if (tolerance < EXACT) {
        const double v = floor(r->c->base == 2 ? x : x + scale * EXACT);
        *open = false;
        return v < scale ? (uint64_t)v : r->c->powers[level] - 1;
    }
    const double v = floor(r->ends ? x + tolerance * scale : x), rest = x - v;
    *open = !r->ends && (rest < tolerance * scale || 1 - rest < tolerance * scale);
    return v < scale ? (uint64_t)v : r->c->powers[level] - 1;
}

/* Whether the map of the first `level` digits is one to one. */
static koksma_status is_nested(const relating *r, int level, bool *nested)
{
    const size_t cells = (size_t)r->c->powers[level];
    uint64_t *maps = malloc(2 * cells * sizeof *maps);
    KOKSMA__REQUIRE_MEMORY(maps, 2 * cells * sizeof *maps);
    memset(maps, 0xff, 2 * cells * sizeof *maps);
    const uint64_t below = r->c->powers[r->c->digits - level];
    size_t n_open = 0;
    *nested = true;
    for (size_t i = 0; i < r->n && *nested; i++) {
        bool open;
        const uint64_t ours = digits_of(r, i, level, &open), theirs = r->theirs[i] / below;
        if (open) {
            n_open++;
            continue;
        }
        uint64_t *there = &maps[theirs], *back = &maps[cells + ours];
        *nested = (*there == UINT64_MAX || *there == ours) && (*back == UINT64_MAX || *back == theirs);
        *there = ours;
        *back = theirs;
    }
    *nested = *nested && n_open <= r->n / 4;
    free(maps);
    return KOKSMA_OK;
}

/* Whether point i has the digits of `numerator`, of r->levels digits, within the tolerance. */
static bool has_digits(const relating *r, size_t i, uint64_t numerator)
{
    const double rest = x_of(r, i) * (double)r->c->powers[r->levels] - (double)numerator;
    return rest >= -r->slack && rest <= 1 + r->slack;
}

/* Adds the digits of a and sign * b in the base, without carry. */
static uint64_t add_digits(const relating *r, uint64_t a, uint64_t b, bool subtract)
{
    if (r->c->base == 2) {
        return a ^ b;
    }
    uint64_t sum = 0;
    const uint64_t base = r->c->base;
    for (int level = 0; level < r->levels; level++, a /= base, b /= base) {
        const uint64_t y = subtract ? base - b % base : b % base;
        sum += (a % base + y) % base * r->c->powers[level];
    }
    return sum;
}

static bool is_digital_shift(const relating *r)
{
    const uint64_t below = r->c->powers[r->c->digits - r->levels];
    for (size_t anchor = 0; anchor < r->n && anchor < 8; anchor++) {
        bool open, all = true;
        const uint64_t shift = add_digits(r, digits_of(r, anchor, r->levels, &open), r->theirs[anchor] / below, true);
        for (size_t i = 0; i < r->n && all; i++) {
            all = has_digits(r, i, add_digits(r, r->theirs[i] / below, shift, false));
        }
        if (all) {
            koksma__snprintf(r->text, 120, "%.12g", (double)shift / (double)r->c->powers[r->levels]);
            return true;
        }
    }
    return false;
}

/* Whether each digit of the points depends only on that digit of the sequence, by a permutation; describes the first.
   */
static koksma_status is_digit_permutation(const relating *r, bool *holds)
{
    const size_t base = r->c->base, bytes = (size_t)r->levels * base * sizeof(uint32_t);
    uint32_t *maps = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(maps, bytes);
    memset(maps, 0xff, bytes);
    const uint64_t below = r->c->powers[r->c->digits - r->levels];
    *holds = true;
    for (size_t i = 0; i < r->n && *holds; i++) {
        bool open;
        uint64_t ours = digits_of(r, i, r->levels, &open), theirs = r->theirs[i] / below;
        for (int level = r->levels - 1; level >= 0 && *holds; level--, ours /= base, theirs /= base) {
            uint32_t *map = &maps[(size_t)level * base + theirs % base];
            *holds = *map == UINT32_MAX || *map == ours % base;
            *map = (uint32_t)(ours % base);
        }
    }
    bool same = true;
    size_t entries = 0; /* what is seen beyond one number for each entry is evidence */
    for (size_t d = 0; d < (size_t)r->levels * base && *holds; d++) {
        same = same && (maps[d] == UINT32_MAX || maps[d % base] == UINT32_MAX || maps[d] == maps[d % base]);
        entries += maps[d] != UINT32_MAX;
    }
    *holds = *holds && base <= r->n && r->n * (size_t)r->levels >= entries + 2 * r->n;
    if (*holds) {
        snprintf(r->text, 120, "%s", same ? "one for all digits, " : "");
        for (size_t d = 0; d < base && d < 12; d++) {
            koksma__append(r->text, 120, maps[d] == UINT32_MAX ? "%s?" : "%s%u", d ? " " : "(", maps[d]);
        }
        koksma__append(r->text, 120, base > 12 ? " ...)" : ")");
    }
    free(maps);
    return KOKSMA_OK;
}

/* ---- Linear maps ---- */

enum { MOST_DIGITS = 64 };

/* Row t belongs to digit t of the indices: the `digits` digits of an index, of which digit t is 1 and those of other rows
   are 0, then the digits of its image. */
typedef struct linear {
    uint32_t rows[MOST_DIGITS][2 * MOST_DIGITS];
    bool has[MOST_DIGITS];
    uint32_t anchor[2 * MOST_DIGITS]; /* the digits of the anchor's index and of its coordinate */
    int digits, width, rank;          /* of indices; of a row; the number of rows */
} linear;

static void split(uint64_t v, uint32_t base, int count, uint32_t *digits)
{
    for (int k = 0; k < count; k++, v /= base) {
        digits[k] = (uint32_t)(v % base);
    }
}

static void subtract(uint32_t *a, const uint32_t *b, uint32_t times, uint32_t base, int count)
{
    for (int k = 0; k < count; k++) {
        a[k] = (uint32_t)((a[k] + (uint64_t)(base - b[k]) * times) % base);
    }
}

static uint32_t inverse_of(uint32_t a, uint32_t base)
{
    uint32_t inverse = 1;
    while ((uint64_t)inverse * a % base != 1) {
        inverse++;
    }
    return inverse;
}

/* Adds point i to the basis if its index is no sum of those before. */
static void extend(const relating *r, linear *l, size_t i)
{
    const uint32_t base = r->c->base;
    uint32_t v[2 * MOST_DIGITS];
    bool open;
    int pivot = 0;
    split(r->indices[i], base, l->digits, v);
    split(digits_of(r, i, r->levels, &open), base, r->levels, v + l->digits);
    subtract(v, l->anchor, 1, base, l->width);
    for (int t = 0; t < l->digits; t++) {
        if (l->has[t] && v[t]) {
            subtract(v, l->rows[t], v[t], base, l->width);
        }
    }
    while (pivot < l->digits && !v[pivot]) {
        pivot++;
    }
    if (pivot == l->digits) {
        return;
    }
    memset(l->rows[pivot], 0, sizeof l->rows[pivot]);
    subtract(l->rows[pivot], v, base - inverse_of(v[pivot], base), base, l->width); /* v / v[pivot] */
    l->has[pivot] = true;
    l->rank++;
    for (int t = 0; t < l->digits; t++) {
        if (l->has[t] && t != pivot && l->rows[t][pivot]) {
            subtract(l->rows[t], l->rows[pivot], l->rows[t][pivot], base, l->width);
        }
    }
}

static bool predicts(const relating *r, const linear *l, size_t i)
{
    const uint32_t base = r->c->base;
    uint32_t index[MOST_DIGITS];
    uint64_t image[MOST_DIGITS] = {0}, numerator = 0;
    split(r->indices[i], base, l->digits, index);
    subtract(index, l->anchor, 1, base, l->digits);
    for (int t = 0; t < l->digits; t++) {
        for (int k = 0; index[t] && l->has[t] && k < r->levels; k++) {
            image[k] += (uint64_t)index[t] * l->rows[t][l->digits + k];
        }
    }
    for (int k = r->levels - 1; k >= 0; k--) {
        numerator = numerator * base + (image[k] + l->anchor[l->digits + k]) % base;
    }
    return has_digits(r, i, numerator);
}

static koksma_status is_linear(const relating *r, bool *holds)
{
    uint64_t most = 0;
    for (size_t i = 0; i < r->n; i++) {
        most = r->indices[i] > most ? r->indices[i] : most;
    }
    linear *l = malloc(sizeof *l);
    KOKSMA__REQUIRE_MEMORY(l, sizeof *l);
    *holds = false;
    for (size_t anchor = 0; anchor < r->n && anchor < 4 && !*holds; anchor++) {
        bool open;
        *l = (linear){.digits = 1};
        for (uint64_t v = most / r->c->base; v; v /= r->c->base) {
            l->digits++;
        }
        split(r->indices[anchor], r->c->base, l->digits, l->anchor);
        split(digits_of(r, anchor, r->levels, &open), r->c->base, r->levels, l->anchor + l->digits);
        l->width = l->digits + r->levels;
        for (size_t i = 0; i < r->n && l->rank < l->digits; i++) {
            extend(r, l, (anchor + i) % r->n);
        }
        size_t wrong = 0, at = 0;
        for (size_t i = 0; i < r->n && wrong <= r->n / 64; i++) {
            const bool right = predicts(r, l, i);
            wrong += !right;
            at = right ? at : i;
        }
        *holds = wrong <= r->n / 64;
        r->text[0] = 0;
        if (*holds && wrong) {
            snprintf(r->text, 120, "not point %zu%s", at, wrong > 1 ? " and some others" : "");
        }
    }
    free(l);
    return KOKSMA_OK;
}

/* ---- */

static bool is_equal(const relating *r, double shift, double tolerance)
{
    for (size_t i = 0; i < r->n; i++) {
        if (!(fabs(koksma__turn(x_of(r, i) - (double)r->theirs[i] / r->c->whole - shift)) <= tolerance)) {
            return false;
        }
    }
    return true;
}

/* Sets the number of digits that are compared: those that the tolerance leaves known, and some fewer if it is not
   that of double, so that few carries reach them. */
static void choose_levels(relating *r, int fewer)
{
    const double tolerance = fmax(r->s->tolerance, 0x1p-50);
    r->levels = r->c->digits;
    while (r->levels > 1 && (double)r->c->powers[r->levels] * tolerance > 1. / 16) {
        r->levels--;
    }
    r->levels -= r->s->tolerance < EXACT ? 0 : fewer < r->levels ? fewer : r->levels - 1;
    r->slack = r->s->tolerance < EXACT && r->c->base == 2 ? 0 : tolerance * 2 * (double)r->c->powers[r->levels];
}

static koksma_status relate_digits(relating *r, koksma__relation *relation)
{
    bool holds = true;
    int known;
    choose_levels(r, 0);
    known = r->levels;
    for (int level = 1; holds && level <= known && (double)r->c->powers[level] <= 4. * (double)r->n; level++) {
        KOKSMA__TRY(is_nested(r, level, &holds));
    }
    *relation = KOKSMA__NO_RELATION;
    if (!holds) {
        return KOKSMA_OK;
    }
    if (is_digital_shift(r)) {
        *relation = KOKSMA__DIGITAL_SHIFT;
        return KOKSMA_OK;
    }
    if (r->c->base > 2) {
        KOKSMA__TRY(is_digit_permutation(r, &holds));
        if (holds) {
            *relation = KOKSMA__DIGIT_PERMUTATION;
            return KOKSMA_OK;
        }
    }
    choose_levels(r, 4);
    r->text[0] = 0;
    KOKSMA__TRY(is_linear(r, &holds));
    *relation = holds ? KOKSMA__LINEAR : r->c->base <= r->n ? KOKSMA__NESTED : KOKSMA__NO_RELATION;
    return KOKSMA_OK;
}

koksma_status koksma__relate(const koksma__sample *s, int k, const koksma__coordinate *c, const uint64_t *indices,
                             bool digits, koksma__relation *relation, char text[120])
{
    relating r = {.s = s, .c = c, .indices = indices, .k = k, .n = s->points.n, .text = text};
    text[0] = 0;
    r.theirs = malloc(r.n * sizeof *r.theirs);
    KOKSMA__REQUIRE_MEMORY(r.theirs, r.n * sizeof *r.theirs);
    for (size_t i = 0; i < r.n; i++) {
        r.theirs[i] = koksma__numerator(c, indices[i]);
    }
    koksma_status status = KOKSMA_OK;
    const double shift = koksma__turn(x_of(&r, 0) - (double)r.theirs[0] / c->whole);
    *relation = KOKSMA__NO_RELATION;
    if (is_equal(&r, 0, s->tolerance)) {
        *relation = KOKSMA__EQUAL;
        snprintf(text, 120, "0");
    } else if (digits) {
        for (int way = 0; way < 2 && !status && *relation == KOKSMA__NO_RELATION; way++) {
            r.ends = way == 0;
            status = way == 0 || s->tolerance >= EXACT ? relate_digits(&r, relation) : KOKSMA_OK;
        }
    } else if (is_equal(&r, shift, 2 * s->tolerance + 0x1p-50)) {
        *relation = KOKSMA__SHIFTED;
        koksma__snprintf(text, 120, "%.12g", shift < 0 ? shift + 1 : shift);
    }
    free(r.theirs);
    return status;
}
