/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Coordinates that are linear in an index, modulo 1: x_k(i) = d_k + a_k f(i).
 *
 *     f(i) = i                          a rank-1 lattice where all a_k are multiples of 1/N, else an additive recurrence
 *     f(i) = the radical inverse of i, or of its Gray code, in base 2: a lattice sequence, a_k a whole number
 *
 * The increments a_k come from two points and are refined by points twice as far each time, so that they are known to
 * about 2^-50 / n; all points are compared then. Points of a lattice in another order are first sorted by a
 * coordinate that has n equidistant values. Grids are the products of equidistant values.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "identify/sample.h"
#include "patterns/nets/nets.h"

enum { LEAST_POINTS = 5, FIRSTS = 1 << 16, SHOWN = 12 };

typedef struct keyed {
    double x;
    size_t i;
} keyed;

typedef struct progression {
    koksma__sample *s;
    size_t n, dim;
    const double *xs;
    double *increments, *scratch;
    keyed *keys; /* the points, sorted by a coordinate */
    bool sorted;
} progression;

static double x_at(const progression *p, size_t i, size_t k)
{
    return p->xs[i * p->dim + k];
}

/* How much point i may differ from a sum or product of terms, each rounded; the index of the first point may be 2^14. */
static double slack_at(const progression *p, size_t i)
{
    return 2 * p->s->tolerance + ((double)i + 0x1p14) * 0x1p-52;
}

static bool find_increment(const progression *p, size_t k, double *increment)
{
    double a = koksma__turn(x_at(p, 1, k) - x_at(p, 0, k));
    for (size_t i = 2; i < p->n; i *= 2) {
        const double error = koksma__turn(x_at(p, i, k) - x_at(p, 0, k) - koksma__turn((double)i * a));
        if (fabs(error) > 4 * slack_at(p, i)) {
            return false;
        }
        a += error / (double)i;
    }
    for (size_t i = 1; i < p->n; i++) {
        if (fabs(koksma__turn(x_at(p, i, k) - x_at(p, 0, k) - koksma__turn((double)i * a))) > 2 * slack_at(p, i)) {
            return false;
        }
    }
    *increment = a - floor(a);
    return true;
}

/* ---- Lattices ---- */

/* Returns the number of points of which all increments are multiples, or 0. */
static uint64_t denominator(const progression *p)
{
    uint64_t power = 1;
    while (power < p->n) {
        power *= 2;
    }
    const uint64_t n = p->n, candidates[] = {n, n + 1, n - 1, power, 2 * power};
    for (size_t c = 0; c < sizeof candidates / sizeof *candidates; c++) {
        bool all = true;
        for (size_t k = 0; k < p->dim && all; k++) {
            const double z = p->increments[k] * (double)candidates[c];
            all = fabs(z - nearbyint(z)) < 1e-6 + (double)candidates[c] * slack_at(p, p->n) / (double)p->n;
        }
        if (all) {
            return candidates[c];
        }
    }
    return 0;
}

static uint64_t multiplier(const progression *p, size_t k, uint64_t points)
{
    return (uint64_t)nearbyint(p->increments[k] * (double)points) % points;
}

/* Whether point 0 is point *first of the lattice without a shift. */
static bool find_first(const progression *p, uint64_t points, uint64_t *first)
{
    for (*first = 0; *first < points; ++*first) {
        bool all = true;
        for (size_t k = 0; k < p->dim && all; k++) {
            const double there = (double)(*first * multiplier(p, k, points) % points) / (double)points;
            all = fabs(koksma__turn(x_at(p, 0, k) - there)) <= slack_at(p, 1);
        }
        if (all) {
            return true;
        }
    }
    return false;
}

static void append_multipliers(const progression *p, uint64_t points, char *text, size_t size, const char *comma)
{
    for (size_t k = 0; k < p->dim; k++) {
        koksma__append(text, size, "%s%llu", k ? comma : "", (unsigned long long)multiplier(p, k, points));
    }
}

static void append_shift(const progression *p, char *text, size_t size)
{
    for (size_t k = 0; k < p->dim && k < SHOWN; k++) {
        koksma__append(text, size, "%s%.12g", k ? ", " : "; shift ", x_at(p, 0, k));
    }
}

static bool is_korobov(const progression *p, uint64_t points)
{
    uint64_t power = 1;
    for (size_t k = 0; k < p->dim; k++) {
        if (multiplier(p, k, points) != power % points) {
            return false;
        }
        power = power * multiplier(p, 1, points) % points;
    }
    return true;
}

static koksma_status say_lattice(progression *p, uint64_t points)
{
    uint64_t first;
    char detail[400] = "generating vector ";
    const bool plain = find_first(p, points, &first), whole = points == p->n;
    append_multipliers(p, points, detail, 330, ", ");
    if (p->dim > 1 && points < (uint64_t)1 << 31 && is_korobov(p, points)) {
        koksma__append(detail, sizeof detail, " (Korobov)");
    }
    if (!plain) {
        append_shift(p, detail, sizeof detail);
    }
    const char *relation = !plain ? "lattice" : p->sorted || first ? "reordered" : whole ? "equal" : "part";
    char what[160], spec[KOKSMA_MAX_SPEC] = "";
    snprintf(what, sizeof what, "rank-1 lattice of %llu points%s", (unsigned long long)points,
             p->sorted ? ", in another order" : "");
    if (plain && whole && p->dim <= 256) {
        snprintf(spec, sizeof spec, "lattice-vector:");
        append_multipliers(p, points, spec, sizeof spec, ":");
    }
    return koksma__say(p->s, relation, what, strstr(spec, "...") ? "" : spec, plain ? first : 0, "%s", detail);
}

/* ---- Recurrences ---- */

typedef enum family { PLASTIC, ROOTS, POWERS, FAMILIES } family;

static const char *const families[] = {
    "additive recurrence of the generalised golden ratio (R sequence, Roberts 2018)",
    "additive recurrence of the square roots of primes (Richtmyer)",
    "additive recurrence of powers of 2^(1/(dim+1)) (Niederreiter)",
};

static double increment_of(family f, int dim, int k)
{
    if (f == PLASTIC) {
        double g = 2;
        for (int i = 0; i < 200; i++) {
            g = koksma__pow(1 + g, 1. / (dim + 1));
        }
        return koksma__pow(1 / g, k + 1);
    }
    if (f == ROOTS) {
        const double root = sqrt(koksma__prime(k));
        return root - floor(root);
    }
    const double a = koksma__pow(2, (k + 1.) / (dim + 1));
    return a - floor(a);
}

/* Finds point 0 as {offset + first a_k}. */
static bool find_offset(const progression *p, double *offset, uint64_t *first)
{
    static const double offsets[] = {0, .5};
    for (size_t o = 0; o < 2; o++) {
        for (*first = 0; *first < FIRSTS; ++*first) {
            bool all = true;
            for (size_t k = 0; k < p->dim && all; k++) {
                const double there = offsets[o] + (double)*first * p->increments[k];
                all = fabs(koksma__turn(x_at(p, 0, k) - there)) <=
                      slack_at(p, *first) + (double)*first * slack_at(p, p->n) / (double)p->n;
            }
            if (all) {
                *offset = offsets[o];
                return true;
            }
        }
    }
    return false;
}

static koksma_status say_recurrence(progression *p)
{
    const double slack = slack_at(p, p->n) / (double)p->n * 8 + 0x1p-48;
    const int dim = (int)p->dim;
    bool known = false;
    family f = PLASTIC;
    for (; f < FAMILIES && !known; f += !known) {
        known = true;
        for (int k = 0; k < dim; k++) {
            known = known && fabs(koksma__turn(increment_of(f, dim, k) - p->increments[k])) <= slack;
        }
    }
    char detail[400] = "increments ";
    double offset = 0;
    uint64_t first = 0;
    for (int k = 0; k < dim; k++) {
        p->increments[k] = known ? increment_of(f, dim, k) : p->increments[k]; /* it has more digits */
        koksma__append(detail, 250, "%s%.12g", k ? ", " : "", p->increments[k]);
    }
    if (find_offset(p, &offset, &first)) {
        koksma__append(detail, sizeof detail, "; point i is the fraction of %g + (i + %llu) times these", offset,
                       (unsigned long long)first);
    } else {
        first = 0;
        append_shift(p, detail, sizeof detail);
    }
    const bool ours = known && f == PLASTIC && first > 0 && offset >= .5;
    return koksma__say(p->s, ours ? "equal" : "recurrence", known ? families[f] : "additive recurrence",
                       ours ? "r-sequence" : "", ours ? first - 1 : first, "%s", detail);
}

static koksma_status look_in_order(progression *p)
{
    for (size_t k = 0; k < p->dim; k++) {
        if (!find_increment(p, k, &p->increments[k])) {
            return KOKSMA_OK;
        }
    }
    const uint64_t points = denominator(p);
    if (points) {
        return say_lattice(p, points);
    }
    return p->sorted ? KOKSMA_OK : say_recurrence(p);
}

/* ---- Another order ---- */

static int by_x(const void *a, const void *b)
{
    const keyed *u = a, *v = b;
    return (u->x > v->x) - (u->x < v->x);
}

static void sort_by(progression *p, size_t k)
{
    for (size_t i = 0; i < p->n; i++) {
        p->keys[i] = (keyed){x_at(p, i, k), i};
    }
    qsort(p->keys, p->n, sizeof *p->keys, by_x);
}

/* Sorts the points by the first coordinate that has n equidistant values, and looks again. */
static koksma_status look_sorted(progression *p)
{
    bool even = false;
    for (size_t k = 0; k < p->dim && !even; k++) {
        sort_by(p, k);
        even = true;
        for (size_t i = 1; i < p->n && even; i++) {
            even = fabs(p->keys[i].x - p->keys[0].x - (double)i / (double)p->n) <= slack_at(p, 1);
        }
    }
    for (size_t i = 0; i < p->n && even; i++) {
        memcpy(p->scratch + i * p->dim, p->xs + p->keys[i].i * p->dim, p->dim * sizeof *p->scratch);
    }
    p->sorted = true;
    p->xs = p->scratch;
    return even ? look_in_order(p) : KOKSMA_OK;
}

/* ---- Lattice sequences ---- */

static double radical(uint64_t i)
{
    double sum = 0, unit = .5;
    for (; i; i >>= 1, unit /= 2) {
        sum += i & 1 ? unit : 0;
    }
    return sum;
}

static koksma_status look_radical(progression *p, bool gray)
{
    const int m = koksma__levels_of(p->n);
    char detail[400] = "generating vector modulo ";
    const uint64_t half = (uint64_t)1 << (m - 1), at = gray ? koksma__from_gray(half) : half;
    if (at >= p->n || m < 3) {
        return KOKSMA_OK;
    }
    koksma__append(detail, sizeof detail, "%llu: ", 2 * (unsigned long long)half);
    bool shifted = false;
    for (size_t k = 0; k < p->dim; k++) {
        const double a = koksma__turn(x_at(p, at, k) - x_at(p, 0, k)), z = nearbyint(ldexp(a - floor(a), m));
        for (size_t i = 0; i < p->n; i++) {
            const double there = z * radical(gray ? koksma__gray(i) : i);
            if (fabs(koksma__turn(x_at(p, i, k) - x_at(p, 0, k) - (there - floor(there)))) > slack_at(p, 1)) {
                return KOKSMA_OK;
            }
        }
        shifted = shifted || fabs(koksma__turn(x_at(p, 0, k))) > slack_at(p, 1);
        koksma__append(detail, 300, "%s%.0f", k ? ", " : "", fmod(z, 2 * (double)half));
    }
    if (shifted) {
        append_shift(p, detail, sizeof detail);
    }
    char what[160];
    snprintf(what, sizeof what, "lattice sequence in base 2%s%s", gray ? ", Gray order" : "",
             shifted ? ", shifted modulo 1" : "");
    return koksma__say(p->s, "lattice", what, "", 0, "%s", detail);
}

/* ---- Grids ---- */

/* Finds the equidistant values of a coordinate: their number, the first and the distance. */
static bool find_values(progression *p, size_t k, size_t *count, double *first, double *step)
{
    sort_by(p, k);
    *count = 1;
    for (size_t i = 1; i < p->n; i++) {
        *count += p->keys[i].x - p->keys[i - 1].x > slack_at(p, 1);
    }
    *first = p->keys[0].x;
    *step = *count > 1 ? (p->keys[p->n - 1].x - *first) / (double)(*count - 1) : 1;
    bool even = p->n % *count == 0;
    for (size_t i = 0; i < p->n && even; i++) {
        even = fabs(p->keys[i].x - *first - *step * (double)(i / (p->n / *count))) <= 2 * slack_at(p, 1);
    }
    return even;
}

static koksma_status look_grid(progression *p)
{
    char detail[400] = "", what[160] = "grid of";
    size_t product = 1;
    uint32_t *cells = calloc(p->n, 2 * sizeof *cells), *seen = cells + p->n;
    KOKSMA__REQUIRE_MEMORY(cells, p->n * 2 * sizeof *cells);
    bool grid = true;
    for (size_t k = 0; k < p->dim && grid; k++) {
        size_t count = 1;
        double first = 0, step = 1;
        grid = find_values(p, k, &count, &first, &step) && product <= p->n / count;
        for (size_t i = 0; i < p->n && grid; i++) {
            cells[i] = (uint32_t)(cells[i] * count + (size_t)nearbyint((x_at(p, i, k) - first) / step));
        }
        product *= count;
        koksma__append(detail, sizeof detail, "%sfrom %.6g in steps of %.6g", k ? "; " : "", first, step);
        koksma__append(what, sizeof what, k ? " x %zu" : " %zu", count);
    }
    grid = grid && product == p->n;
    for (size_t i = 0; i < p->n && grid; i++) {
        grid = cells[i] < p->n && !seen[cells[i]]++;
    }
    free(cells);
    return grid ? koksma__say(p->s, "grid", what, "", 0, "%s", detail) : KOKSMA_OK;
}

koksma_status koksma__identify_progression(koksma__sample *s)
{
    progression p = {.s = s, .n = s->points.n, .dim = (size_t)s->points.dim, .xs = s->points.xs};
    if (p.n < LEAST_POINTS) {
        return KOKSMA_OK;
    }
    p.increments = malloc(p.dim * sizeof *p.increments);
    p.scratch = malloc(p.n * p.dim * sizeof *p.scratch);
    p.keys = malloc(p.n * sizeof *p.keys);
    koksma_status status = p.increments && p.scratch && p.keys ? koksma__ask(s->run)
                                                               : koksma__fail_memory(p.n * p.dim * sizeof *p.scratch);
    status = status ? status : look_in_order(&p);
    for (int gray = 0; gray < 2 && !status && !s->named; gray++) {
        status = look_radical(&p, gray);
    }
    if (!status && !s->named && p.dim > 1) {
        status = look_grid(&p);
    }
    if (!status && !s->named && p.dim > 1) {
        status = look_sorted(&p);
    }
    free(p.increments);
    free(p.scratch);
    free(p.keys);
    return status;
}
