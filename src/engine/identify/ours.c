/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The patterns of this library: those without random numbers, and the others with seeds from 0 on.
 *
 * A pattern that makes any point by itself is compared by its first point, of two coordinates where these don't depend on
 * the others, so that 2^16 seeds are tried in the time of as many points; of others as many seeds as make some 100,000
 * coordinates. If the points are known to be a map of some sequence or lattice, only its patterns are tried, also with
 * modifiers. Otherwise those are left out that would have been recognised.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/verify.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/points.h"
#include "core/status.h"
#include "identify/sample.h"

enum { SEEDS = 1 << 16, SLOW_SEEDS = 2, SLOW_COORDINATES = 2048, FIRSTS = 1 << 14, VARIANTS = 16, CANCEL = 256 };

#define COORDINATES (1 << 17) /* made for one spec at most, for patterns that make whole sets only */

typedef struct ours {
    koksma__sample *s;
    koksma_points made, one;
    bool blue;     /* the sample's points keep a distance */
    double *order; /* scratch: a set, sorted */
} ours;

static bool are_near(const double *a, const double *b, size_t count, double tolerance)
{
    for (size_t i = 0; i < count; i++) {
        if (!(fabs(a[i] - b[i]) <= tolerance)) {
            return false;
        }
    }
    return true;
}

static koksma_status say(ours *o, const koksma_spec *spec, uint64_t seed, const char *relation)
{
    double difference = 0;
    const size_t count = o->made.n * (size_t)o->made.dim;
    for (size_t i = 0; i < count; i++) {
        difference = fmax(difference, fabs(o->made.xs[i] - o->s->points.xs[i]));
    }
    char text[KOKSMA_MAX_SPEC];
    koksma_spec_text(spec, text);
    KOKSMA__TRY(strcmp(relation, "equal")
                    ? koksma__say(o->s, relation, spec->pattern->title, text, 0, "the same %zu points", o->made.n)
                    : koksma__say(o->s, relation, spec->pattern->title, text, 0,
                                  "largest difference %.3g in %zu points", difference, o->made.n));
    o->s->found->items[o->s->found->count - 1].seed = seed;
    return KOKSMA_OK;
}

/* A pattern that refuses this n, dim or parameter is no failure of the search. */
static koksma_status passable(koksma_status status)
{
    return status == KOKSMA_MEMORY || status == KOKSMA_INTERRUPTED ? status : KOKSMA_OK;
}

/* ---- Specs ---- */

static bool is_walked(const koksma_pattern *p, int dim)
{
    return !p->operand && !p->alias_of && !p->runs_code && dim >= p->min_dim && dim <= p->max_dim;
}

static size_t add_spec(koksma_spec *specs, size_t count, const char *format, const char *a, const char *b,
                       const char *c)
{
    char text[KOKSMA_MAX_SPEC];
    snprintf(text, sizeof text, format, a, b, c);
    return count < VARIANTS && koksma_pattern_spec(text, &specs[count]) == KOKSMA_OK ? count + 1 : count;
}

/* Lists the specs of a pattern: its default, each word of a parameter, switches; with `modified` also three
   modifiers. */
static size_t specs_of(const koksma_pattern *p, bool modified, koksma_spec specs[VARIANTS])
{
    size_t count = add_spec(specs, 0, "%s%s%s", p->name, "", "");
    for (const koksma_param *param = p->params; param && param->name; param++) {
        for (int c = 0; param->choices && param->choices[c]; c++) {
            if (c > (int)param->fallback || c < (int)param->fallback) {
                count = add_spec(specs, count, "%s:%s=%s", p->name, param->name, param->choices[c]);
            }
        }
        if (!strcmp(param->name, "shuffle") && !strcmp(p->name, "sobol")) {
            count = add_spec(specs, count, "%s:scramble=%s,%s=1", p->name, "hash-owen", param->name);
        } else if (!strcmp(param->name, "shuffle") || !strcmp(param->name, "torus")) {
            count = add_spec(specs, count, "%s:%s=1%s", p->name, param->name, "");
        } else if (!strcmp(param->name, "offset")) {
            count = add_spec(specs, count, "%s:%s=%s", p->name, param->name, "0.5");
        }
    }
    if (modified && p->claims & KOKSMA_CLAIM_DETERMINISTIC) {
        count = add_spec(specs, count, "%s:%s=1%s", p->name, "shift", "");
        count = add_spec(specs, count, "%s:%s=1%s", p->name, "digital-shift", "");
        count = add_spec(specs, count, "%s:%s=1%s", p->name, "owen", "");
    }
    return count;
}

/* ---- Without random numbers ---- */

static _Thread_local size_t row_size; /* for qsort, which passes no context */

static int by_row(const void *a, const void *b)
{
    const double *u = a, *v = b;
    for (size_t k = 0; k < row_size; k++) {
        if (u[k] < v[k] || u[k] > v[k]) {
            return u[k] < v[k] ? -1 : 1;
        }
    }
    return 0;
}

/* Looks for the sample among the points of a sequence after the first. */
static koksma_status compare_later(ours *o, const koksma_spec *spec)
{
    const size_t n = o->made.n, dim = (size_t)o->made.dim;
    koksma_points all;
    if (!koksma_has_ranges(spec) || !koksma_is_sequence(spec)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma_points_init(&all, FIRSTS + n, o->made.dim));
    koksma_status status = koksma_generate_range(spec, 0, all.n, 0, o->s->run, &all);
    const size_t firsts = status ? 0 : FIRSTS;
    status = passable(status);
    for (size_t first = 1; first < firsts; first++) {
        if (are_near(&all.xs[first * dim], o->s->points.xs, n * dim, o->s->tolerance)) {
            memcpy(o->made.xs, &all.xs[first * dim], n * dim * sizeof *all.xs);
            status = say(o, spec, 0, "equal");
            o->s->found->items[o->s->found->count - 1].first = first;
            break;
        }
    }
    koksma_points_fini(&all);
    return status;
}

static koksma_status compare_fixed(ours *o, const koksma_spec *spec, double *sorted)
{
    const size_t n = o->made.n, dim = (size_t)o->made.dim;
    const koksma_status status = koksma_generate(spec, 0, o->s->run, &o->made);
    if (status) {
        return passable(status);
    }
    if (are_near(o->made.xs, o->s->points.xs, n * dim, o->s->tolerance)) {
        return say(o, spec, 0, "equal");
    }
    memcpy(sorted, o->made.xs, n * dim * sizeof *sorted);
    qsort(sorted, n, dim * sizeof *sorted, by_row);
    return are_near(sorted, o->order, n * dim, o->s->tolerance) ? say(o, spec, 0, "reordered")
                                                                : compare_later(o, spec);
}

/* ---- Seeds ---- */

static bool is_slow(const koksma_pattern *p)
{
    const unsigned quick = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_INDEPENDENT | KOKSMA_CLAIM_LATIN |
                           KOKSMA_CLAIM_STRATIFIED | KOKSMA_CLAIM_NET2_PREFIXES;
    return !(p->claims & quick) || p->claims & KOKSMA_CLAIM_CLASSES;
}

/* Sets whose points keep a distance are made only where the sample's do: twice that of independent points at least. */
static koksma_status could_be_blue(ours *o)
{
    double distance, ball = o->s->points.dim % 2 ? 2 : 1; /* the volume of the unit ball */
    const double n = (double)o->s->points.n;
    for (int k = o->s->points.dim; k > 1; k -= 2) {
        ball *= 2 * M_PI / k;
    }
    KOKSMA__TRY(koksma_smallest_distance(&o->s->points, true, o->s->run, &distance));
    o->blue = distance > 2 * koksma__pow(2 / (n * n * ball), 1. / o->s->points.dim);
    return KOKSMA_OK;
}

static koksma_status compare_seeds(ours *o, const koksma_spec *spec)
{
    const size_t dim = (size_t)o->made.dim, count = o->made.n * dim;
    const bool ranges = koksma_has_ranges(spec);
    o->one.dim = spec->pattern->claims & KOKSMA_CLAIM_DIMENSION_PREFIXES && dim > 2 ? 2 : (int)dim;
    uint64_t seeds = ranges ? SEEDS : COORDINATES / count;
    if (is_slow(spec->pattern)) {
        seeds =
            count <= SLOW_COORDINATES && (o->blue || !(spec->pattern->claims & KOKSMA_CLAIM_BLUE)) ? SLOW_SEEDS : 0;
    }
    for (uint64_t seed = 0; seed < seeds; seed++) {
        if (seed % CANCEL == 0) {
            KOKSMA__TRY(koksma__ask(o->s->run));
        }
        koksma_status status = ranges ? koksma_generate_range(spec, seed, o->made.n, 0, o->s->run, &o->one)
                                      : koksma_generate(spec, seed, o->s->run, &o->made);
        if (status) {
            return passable(status);
        }
        if (are_near(ranges ? o->one.xs : o->made.xs, o->s->points.xs, (size_t)o->one.dim, o->s->tolerance)) {
            status = ranges ? koksma_generate(spec, seed, o->s->run, &o->made) : KOKSMA_OK;
            if (status) {
                return passable(status);
            }
            if (are_near(o->made.xs, o->s->points.xs, count, o->s->tolerance)) {
                return say(o, spec, seed, "equal");
            }
        }
    }
    return KOKSMA_OK;
}

/* The statement that names the points so far, or NULL. */
static const koksma_identity *name_of(const koksma__sample *s)
{
    for (size_t i = 0; i < s->found->count; i++) {
        if (koksma_identity_names(&s->found->items[i])) {
            return &s->found->items[i];
        }
    }
    return NULL;
}

/* Whether sets of a pattern may be the points, of which `known` says what they are a map of. */
static bool is_tried(const koksma__sample *s, const koksma_pattern *p, const koksma_identity *known)
{
    const koksma__source *source;
    if (!known) { /* the digits of these would have been recognised, where there are enough */
        for (size_t i = 0; (source = koksma__source_at(i)) && s->points.n >= KOKSMA__LEAST_SCRAMBLED; i++) {
            if (!strcmp(p->name, source->spec)) {
                return false;
            }
        }
        return true;
    }
    if (!strcmp(known->relation, "lattice")) {
        return p->claims & (KOKSMA_CLAIM_LATTICE | KOKSMA_CLAIM_LATTICE_PREFIXES);
    }
    if (!strncmp(known->what, "Hammersley", strlen("Hammersley"))) {
        return !strcmp(p->name, "hammersley") || !strcmp(p->name, "zaremba");
    }
    const size_t length = strlen(p->name);
    return (!strncmp(known->spec, p->name, length) && (!known->spec[length] || known->spec[length] == ':')) ||
           (s->points.dim == 2 && p->claims & KOKSMA_CLAIM_NET2);
}

/* Whether a spec makes maps of the kind that the statement says. */
static bool fits(const koksma_spec *spec, const koksma_identity *known)
{
    static const char *const words[][2] = {
        {"shifted", ":shift=1"},         {"lattice", ":shift=1"},     {"digital-shift", "digital-shift"},
        {"digit-permutation", "affine"}, {"linear-scramble", "=lms"}, {"nested-scramble", "owen"},
    };
    char text[KOKSMA_MAX_SPEC];
    koksma_spec_text(spec, text);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (!strcmp(known->relation, words[i][0])) {
            return strstr(text, words[i][1]) || !(spec->pattern->claims & KOKSMA_CLAIM_DETERMINISTIC);
        }
    }
    return true;
}

static bool is_settled(const koksma_identity *known)
{
    static const char *const settled[] = {"equal", "reordered", "part", "grid", "recurrence"};
    for (size_t i = 0; known && i < sizeof settled / sizeof *settled; i++) {
        if (!strcmp(known->relation, settled[i])) {
            return true;
        }
    }
    return false;
}

/* ---- */

static koksma_status walk(koksma__sample *s, bool seeded)
{
    const koksma_identity *name = seeded ? name_of(s) : NULL;
    koksma_identity known = name ? *name : (koksma_identity){0};
    if (is_settled(name)) {
        return KOKSMA_OK;
    }
    const size_t count = s->points.n * (size_t)s->points.dim;
    const koksma_pattern *p;
    koksma_spec specs[VARIANTS];
    ours o = {.s = s};
    double *sorted = malloc(count * sizeof *sorted);
    koksma_status status = koksma_points_init(&o.made, s->points.n, s->points.dim);
    status = status ? status : koksma_points_init(&o.one, 1, s->points.dim);
    o.order = malloc(count * sizeof *o.order);
    status = status ? status : o.order && sorted ? KOKSMA_OK : koksma__fail_memory(count * sizeof *sorted);
    if (!status) {
        memcpy(o.order, s->points.xs, count * sizeof *sorted);
        row_size = (size_t)s->points.dim;
        qsort(o.order, s->points.n, row_size * sizeof *sorted, by_row);
        status = !seeded || count > SLOW_COORDINATES || s->points.n < 2 ? KOKSMA_OK : could_be_blue(&o);
    }
    const size_t before = s->found->count;
    for (size_t i = 0; (p = koksma_pattern_at(i)) && !status && s->found->count == before; i++) {
        const bool tried = is_walked(p, s->points.dim) && (!seeded || is_tried(s, p, name ? &known : NULL));
        const size_t n_specs = tried ? specs_of(p, seeded && name, specs) : 0;
        for (size_t k = 0; k < n_specs && !status && s->found->count == before; k++) {
            if (koksma_has_one_set(&specs[k]) != seeded && (!name || fits(&specs[k], &known))) {
                status = koksma__ask(s->run);
                status = status   ? status
                         : seeded ? compare_seeds(&o, &specs[k])
                                  : compare_fixed(&o, &specs[k], sorted);
            }
        }
    }
    free(sorted);
    free(o.order);
    koksma_points_fini(&o.made);
    koksma_points_fini(&o.one);
    return status;
}

koksma_status koksma__identify_fixed(koksma__sample *s)
{
    return walk(s, false);
}

koksma_status koksma__identify_seeded(koksma__sample *s)
{
    return walk(s, true);
}
