/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Where points come from as far as their structure tells, if no source that is known here makes them:
 *
 *     a digital sequence in base 2 whose matrices are in no table here, in natural order or that of Gray's code;
 *     some points of a rank-1 lattice; some points of a grid;
 *     a sequence in base 2 behind nested scrambling and perhaps a shuffle of its indices;
 *     a Latin hypercube, or one point in each cell of a grid.
 *
 * In a digital sequence the exclusive or of points i and i + 1 depends only on the number c of zeros at the end of i + 1:
 * it is column c of the matrix in Gray's order, and the sum of columns 0 to c in natural order. So every second difference
 * is the same one, every second of the others, and so on, which also gives the first index modulo 2^c.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/points.h"
#include "core/status.h"
#include "identify/identify.h"

enum { LEAST_POINTS = 32, LEVELS = 32, BITS = 52, SHOWN = 4, NUMBERS = 5 };

static double x_at(const koksma__sample *s, size_t i, size_t k)
{
    return s->points.xs[i * (size_t)s->points.dim + k];
}

static koksma_status name(koksma__sample *s, const char *relation, const char *what, const char *detail,
                          uint64_t first)
{
    koksma_identity *said = koksma__identity(s, relation, "%s", detail);
    KOKSMA__REQUIRE_MEMORY(said, sizeof *said);
    snprintf(said->what, sizeof said->what, "%s", what);
    said->first = first;
    s->named = true;
    return KOKSMA_OK;
}

/* ---- Digital sequences ---- */

typedef struct digital {
    uint64_t *xs;                     /* the points, in units of 2^-bits */
    int bits;                         /* fewer if the numbers are rounded; carries then spoil a few */
    size_t n, dim, at[LEVELS], start; /* at[c]: a point i that differs from point i + 1 by difference c */
    int levels;
} digital;

static bool alike(const digital *d, size_t i, size_t j)
{
    bool same = true;
    for (size_t k = 0; k < d->dim; k++) {
        same = same && (d->xs[i * d->dim + k] ^ d->xs[(i + 1) * d->dim + k]) ==
                           (d->xs[j * d->dim + k] ^ d->xs[(j + 1) * d->dim + k]);
    }
    return same;
}

static bool all_alike(const digital *d, size_t first, size_t step)
{
    size_t count = 0, wrong = 0;
    for (size_t i = first + step; i + 1 < d->n; i += step, count++) {
        wrong += !alike(d, first, i);
        if (wrong && d->bits == BITS) {
            return false;
        }
    }
    return wrong <= count / 16;
}

/* Finds the differences, from that of every second pair on. Returns whether there are such. */
static bool find_differences(digital *d)
{
    size_t first = 0;
    for (size_t step = 1; d->levels < LEVELS && first + 2 * step + 1 < d->n; step *= 2) {
        const bool even = all_alike(d, first, 2 * step), odd = all_alike(d, first + step, 2 * step);
        if (!even && !odd) {
            return false;
        }
        if (even && odd && first + 3 * step + 1 < d->n) { /* all are alike, which no sequence's are */
            return false;
        }
        d->at[d->levels++] = even ? first : first + step;
        first += even ? step : 0;
        d->start = (2 * step - (first + 1) % (2 * step)) % (2 * step);
    }
    return d->levels >= 4;
}

static uint64_t difference(const digital *d, int c, size_t k)
{
    return d->xs[d->at[c] * d->dim + k] ^ d->xs[(d->at[c] + 1) * d->dim + k];
}

/* Whether digit 0, or digit c, is the first of all differences of coordinate 0. */
static bool leads(const digital *d, bool gray)
{
    for (int c = 0; c < d->levels && c < d->bits; c++) {
        const uint64_t v = difference(d, c, 0);
        if (!v || v >> (d->bits - 1 - (gray ? c : 0)) != 1) {
            return false;
        }
    }
    return true;
}

static koksma_status look_at_digits(koksma__sample *s)
{
    digital d = {.n = s->points.n, .dim = (size_t)s->points.dim, .bits = BITS};
    while (s->tolerance > 0x1p-46 && d.bits > 10 && ldexp(s->tolerance, d.bits) > .002) {
        d.bits--;
    }
    const size_t count = d.n * d.dim;
    d.xs = malloc(count * sizeof *d.xs);
    KOKSMA__REQUIRE_MEMORY(d.xs, count * sizeof *d.xs);
    for (size_t i = 0; i < count; i++) {
        d.xs[i] = (uint64_t)fmin(floor(ldexp(s->points.xs[i], d.bits)), ldexp(1, d.bits) - 1);
    }
    bool found = find_differences(&d), triangular = found;
    const bool natural = found && leads(&d, false);
    char detail[400] = "point i + 1 differs from point i by a number for each count of zeros of i + 1";
    for (size_t k = 0; k < d.dim && found; k++) {
        found = difference(&d, 0, k) != 0;
        for (int c = 0; c < NUMBERS && c < d.levels && c < d.bits && k < SHOWN && natural + leads(&d, true) > 0;
             c++) {
            const uint64_t v = difference(&d, c, k) ^ (natural && c ? difference(&d, c - 1, k) : 0),
                           unit = (uint64_t)1 << (d.bits - 1 - c);
            koksma__append(detail, 330,
                           c   ? " %llu"
                           : k ? "; %llu"
                               : "; initial numbers %llu",
                           (unsigned long long)(v / unit));
        }
    }
    triangular = found && (natural || leads(&d, true));
    koksma__append(detail, sizeof detail, "; first is known modulo 2^%d", d.levels);
    free(d.xs);
    return !found ? KOKSMA_OK
                  : name(s, "digital",
                         natural      ? "digital sequence in base 2 of other matrices"
                         : triangular ? "digital sequence in base 2 of other matrices, Gray order"
                                      : "digital sequence in base 2 of other, not triangular matrices",
                         detail, d.start);
}

/* ---- Sequences behind scrambling and a shuffle ---- */

/* Whether in each coordinate no two points of an aligned block of 2^level are in one interval of length 2^-level, where
   blocks begin at `offset`, modulo their size. */
static bool is_stratified(const koksma__sample *s, int level, size_t offset, size_t *seen)
{
    const size_t block = (size_t)1 << level;
    memset(seen, 0, block * sizeof *seen);
    for (size_t k = 0; k < (size_t)s->points.dim; k++) {
        for (size_t i = 0; i < s->points.n; i++) {
            const size_t id = (k * s->points.n + i + block - offset) / block + k + 1;
            size_t *cell = &seen[koksma__stratum(x_at(s, i, k), block)];
            if (*cell == id) {
                return false;
            }
            *cell = id;
        }
    }
    return true;
}

static koksma_status look_at_blocks(koksma__sample *s)
{
    size_t *seen = malloc(s->points.n * sizeof *seen), offset = 0;
    KOKSMA__REQUIRE_MEMORY(seen, s->points.n * sizeof *seen);
    bool holds = true;
    int level = 1;
    for (; holds && (size_t)1 << level <= s->points.n; level++) {
        const size_t half = (size_t)1 << (level - 1);
        holds = is_stratified(s, level, offset, seen);
        if (!holds && is_stratified(s, level, offset + half, seen)) {
            offset += half;
            holds = true;
        }
    }
    free(seen);
    char detail[200];
    snprintf(
        detail, sizeof detail,
        "each aligned block of 2^k points has one in each of 2^k intervals of every coordinate; the first block of "
        "%zu points begins at point %zu",
        (size_t)1 << (level - 1), offset);
    return holds ? name(s, "sequence", "scrambled sequence in base 2, perhaps with shuffled indices", detail, 0)
                 : KOKSMA_OK;
}

/* ---- Some points of lattices and grids ---- */

static int by_value(const void *a, const void *b)
{
    const double *u = a, *v = b;
    return (*u > *v) - (*u < *v);
}

/* Returns the smallest distance of values of coordinate k that differ by more than the slack, 0 if there is one value only;
   sorted: scratch for n numbers, which then has the values. */
static double smallest_step(const koksma__sample *s, size_t k, double slack, double *sorted)
{
    double step = 0;
    for (size_t i = 0; i < s->points.n; i++) {
        sorted[i] = x_at(s, i, k);
    }
    qsort(sorted, s->points.n, sizeof *sorted, by_value);
    for (size_t i = 1; i < s->points.n; i++) {
        const double gap = sorted[i] - sorted[i - 1];
        step = gap > slack && (step <= 0 || gap < step) ? gap : step;
    }
    return step;
}

/* Returns the inverse of a modulo n, or 0. */
static uint64_t inverse(uint64_t a, uint64_t n)
{
    int64_t r = (int64_t)n, next = (int64_t)a, t = 0, t_next = 1;
    while (next) {
        const int64_t quotient = r / next, rest = r % next, t_rest = t - quotient * t_next;
        r = next;
        next = rest;
        t = t_next;
        t_next = t_rest;
    }
    return r > 1 ? 0 : (uint64_t)(t < 0 ? t + (int64_t)n : t);
}

/* The difference of points i and 0 in coordinate k, in units of 1/points, or UINT64_MAX if it is not a whole number. */
static uint64_t steps_at(const koksma__sample *s, size_t i, size_t k, uint64_t points)
{
    const double turn = koksma__turn(x_at(s, i, k) - x_at(s, 0, k)) * (double)points, whole = nearbyint(turn);
    const double slack = (double)points * (2 * s->tolerance + 0x1p-48);
    return fabs(turn - whole) > slack ? UINT64_MAX : (uint64_t)((int64_t)whole + (int64_t)points) % points;
}

static koksma_status look_at_lattice(koksma__sample *s, double *scratch)
{
    const double step = smallest_step(s, 0, 4 * s->tolerance + 0x1p-46, scratch);
    if (s->points.dim < 2 || step <= 0 || step * (double)s->points.n * 8 < 1) {
        return KOKSMA_OK;
    }
    const uint64_t points = (uint64_t)nearbyint(1 / step);
    uint64_t pivot = 0;
    size_t at = 0;
    for (size_t i = 1; i < s->points.n && !pivot; i++) {
        const uint64_t steps = steps_at(s, i, 0, points);
        pivot = steps < UINT64_MAX ? inverse(steps, points) : 0;
        at = i;
    }
    bool all = pivot > 0 && points > 2;
    char detail[400] = "generating vector 1", what[160];
    for (size_t k = 1; k < (size_t)s->points.dim && all; k++) {
        const uint64_t there = steps_at(s, at, k, points), a = there * pivot % points;
        all = there < UINT64_MAX;
        for (size_t i = 1; i < s->points.n && all; i++) {
            const uint64_t first = steps_at(s, i, 0, points);
            all = first < UINT64_MAX && steps_at(s, i, k, points) == first * a % points;
        }
        koksma__append(detail, 330, ", %llu", (unsigned long long)a);
    }
    snprintf(what, sizeof what, "rank-1 lattice of %llu points, %zu of them in some order",
             (unsigned long long)points, s->points.n);
    for (size_t k = 0; k < (size_t)s->points.dim && k < SHOWN; k++) {
        koksma__append(detail, sizeof detail, k ? ", %.12g" : "; a point: %.12g", x_at(s, 0, k));
    }
    return all ? name(s, "lattice", what, detail, 0) : KOKSMA_OK;
}

static koksma_status look_at_grid(koksma__sample *s, double *scratch)
{
    char what[160] = "part of a grid of", detail[400] = "";
    const size_t n = s->points.n;
    const double slack = 4 * s->tolerance + 0x1p-46;
    for (size_t k = 0; k < (size_t)s->points.dim; k++) {
        const double step = smallest_step(s, k, slack, scratch), width = scratch[n - 1] - scratch[0];
        if (step <= 0 || width > step * (double)(n / 4)) {
            return KOKSMA_OK;
        }
        for (size_t i = 0; i < n; i++) {
            const double at = (scratch[i] - scratch[0]) / step;
            if (fabs(at - nearbyint(at)) > slack / step * (1 + width / step)) {
                return KOKSMA_OK;
            }
        }
        koksma__append(what, sizeof what, k ? " x %.0f" : " %.0f", nearbyint(width / step) + 1);
        koksma__append(detail, sizeof detail, "%sfrom %.6g in steps of %.6g", k ? "; " : "", scratch[0], step);
    }
    return name(s, "grid", what, detail, 0);
}

/* ---- Strata ---- */

/* Whether the points are n of m points of a Latin hypercube: in each coordinate no two in one of m intervals, which random
   points are with a probability below 1e-12. *m: the least number from n + 1 to 9/8 n; 0: there is none. */
static koksma_status find_latin_part(const koksma__sample *s, size_t *m)
{
    const size_t n = s->points.n, dim = (size_t)s->points.dim, most = n + n / 8;
    size_t *seen = calloc(most + 1, sizeof *seen), looks = 0;
    KOKSMA__REQUIRE_MEMORY(seen, (most + 1) * sizeof *seen);
    bool all = false;
    for (*m = n; !all && *m < most;) {
        double chance = 27.6; /* of 1e12; the logarithm of the probability is added */
        ++*m;
        all = true;
        for (size_t k = 0; k < dim && all; k++) {
            looks++;
            for (size_t i = 0; i < n && all; i++) {
                size_t *cell = &seen[koksma__stratum(x_at(s, i, k), *m)];
                all = *cell != looks;
                *cell = looks;
                chance += koksma__log1p(-(double)i / (double)*m);
            }
        }
        all = all && chance < 0;
    }
    free(seen);
    *m = all ? *m : 0;
    return KOKSMA_OK;
}

static koksma_status look_at_strata(koksma__sample *s)
{
    const size_t n = s->points.n, dim = (size_t)s->points.dim;
    bool latin, centred;
    KOKSMA__TRY(koksma__find_strata(&s->points, s->tolerance, &latin, &centred));
    if (latin) {
        return name(s, "stratified", centred ? "centred Latin hypercube (n-rooks)" : "Latin hypercube (n-rooks)",
                    "each of n intervals of every coordinate has one point", 0);
    }
    size_t whole = 0, columns = (size_t)nearbyint(koksma__pow((double)n, 1. / (double)dim)), cells = 1;
    char detail[120];
    KOKSMA__TRY(find_latin_part(s, &whole));
    if (whole) {
        snprintf(detail, sizeof detail, "each of %zu intervals of every coordinate has at most one point", whole);
        return name(s, "stratified", "Latin hypercube (n-rooks), points left out", detail, 0);
    }
    for (size_t k = 0; k < dim && cells <= n; k++) {
        cells *= columns;
    }
    if (cells != n || columns < 2) {
        return KOKSMA_OK;
    }
    unsigned char *seen = calloc(n, 1);
    KOKSMA__REQUIRE_MEMORY(seen, n);
    bool each = true;
    for (size_t i = 0; i < n && each; i++) {
        size_t cell = 0;
        for (size_t k = 0; k < dim; k++) {
            cell = cell * columns + koksma__stratum(x_at(s, i, k), columns);
        }
        each = !seen[cell];
        seen[cell] = 1;
    }
    free(seen);
    snprintf(detail, sizeof detail, "each of the %zu^%zu cells of a grid has one point", columns, dim);
    return each ? name(s, "stratified", "jittered points", detail, 0) : KOKSMA_OK;
}

koksma_status koksma__identify_structure(koksma__sample *s)
{
    if (s->points.n < LEAST_POINTS) {
        return KOKSMA_OK;
    }
    double *scratch = malloc(s->points.n * sizeof *scratch);
    KOKSMA__REQUIRE_MEMORY(scratch, s->points.n * sizeof *scratch);
    koksma_status status = look_at_digits(s);
    status = status || s->named ? status : look_at_lattice(s, scratch);
    status = status || s->named ? status : look_at_grid(s, scratch);
    free(scratch);
    status = status || s->named ? status : koksma__ask(s->run);
    status = status || s->named ? status : look_at_blocks(s);
    return status || s->named ? status : look_at_strata(s);
}
