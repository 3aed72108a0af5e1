/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Answers how fast measures and errors fall with n: by average slopes in log-log over the larger half of the sizes, with
 * intervals, and with the known lower bound of a measure for comparison, the steepest first. A bound that contains a
 * logarithm is not a power law; its row has the average slope of the bound over the same sizes.
 *
 * The sentence names the pattern whose values fall fastest. A pattern surely falls faster than another if the interval
 * of the difference of their slopes excludes 0. A pattern is a candidate if no other surely falls faster. If there are
 * several candidates, the sentence names those whose slopes have the narrowest intervals, so that a pattern with a wide
 * interval hides no order among patterns with narrow ones. It also gives the number of patterns that fall faster than
 * random points (or the power of theory). Means of 0 have no logarithm: the table marks slopes without them. For
 * measures of quality or distance, for which a fast fall is not better, it does not compare the patterns.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/elementary.h"
#include "measures/shared/shared.h"
#include "study/report/report.h"

enum { NAMED = 4 };

/* Whether a steeper slope means a better pattern. */
typedef enum sense {
    FALLS,  /* for errors and discrepancies: a faster fall is better */
    LARGER, /* for distances: larger values are better */
    NO_SIZE /* for a measure of quality, which is 0 for good points and rises with n for others */
} sense;

/* The slopes of a subject's patterns. */
typedef struct slopes {
    const koksma__subject *of;
    sense sense;
    const koksma__summary *means; /* [pattern * sizes + size] */
    koksma__trend *trends;
    double random; /* the slope of independent random points, for comparison if no pattern is one; NaN: unknown */
    size_t counted, best, tied, faster; /* numbers of patterns; tied: those that may fall fastest */
    size_t is_random;                   /* index of a pattern of random points; patterns->n: none */
} slopes;

/* The trend over the larger half of the sizes, and over at least three sizes if there are that many. */
static koksma__trend trend_of(const koksma__curve *c)
{
    const size_t half = c->n - c->n / 2, least = c->n < 3 ? c->n : 3, n = half < least ? least : half;
    return koksma__trend_of(c->x + (c->n - n), c->y + (c->n - n), n);
}

static sense sense_of(const koksma__subject *s)
{
    koksma_spec spec;
    if (s->images || koksma_measure_spec(s->measure, &spec)) {
        return FALLS;
    }
    return spec.measure->larger_is_better ? LARGER : spec.measure->family == KOKSMA_FAMILY_NONE ? NO_SIZE : FALLS;
}

/* The slope of independent random points: standard deviations fall as N^-1/2, and a metric as a power of them. */
static double random_slope(const koksma__subject *s)
{
    koksma_metric_spec spec;
    if (!s->images) {
        return -0.5;
    }
    return koksma_metric_parse(s->metric, &spec) || !spec.metric->order ? (double)NAN : -0.5 * spec.metric->order;
}

/* ---- Which pattern falls fastest --------------------------------------------------------------------------- */

static double half(const koksma__estimate *e)
{
    return e->high - e->value;
}

/* Whether two slopes are tied: the interval of the difference of the slopes, taken as independent, contains 0, or
   the slopes are equal, or one of them has no interval. */
static bool are_tied(const koksma__estimate *a, const koksma__estimate *b)
{
    return !koksma__compare(a->value, b->value) || !(fabs(a->value - b->value) > koksma__hypot(half(a), half(b)));
}

/* Whether pattern i may be the one that falls fastest: it has a slope, and none surely falls faster. */
static bool may_be_fastest(const slopes *s, size_t i)
{
    const koksma__estimate *e = &s->trends[i].slope;
    bool may = !isnan(e->value);
    for (size_t j = 0; may && j < s->of->patterns->n; j++) {
        const koksma__estimate *other = &s->trends[j].slope;
        may = isnan(other->value) || other->value >= e->value || are_tied(e, other);
    }
    return may;
}

/* Whether a pattern consists of independent points without strata. */
static bool is_random(const char *pattern)
{
    koksma_spec spec;
    const unsigned both = KOKSMA_CLAIM_INDEPENDENT | KOKSMA_CLAIM_STRATIFIED;
    return !koksma_pattern_spec(pattern, &spec) && (spec.pattern->claims & both) == KOKSMA_CLAIM_INDEPENDENT;
}

static void count(slopes *s)
{
    const size_t n = s->is_random = s->of->patterns->n;
    for (size_t i = 0; i < n; i++) {
        const koksma__estimate *e = &s->trends[i].slope, *best = &s->trends[s->best].slope;
        if (!isnan(e->value)) {
            s->best = isnan(best->value) || e->value < best->value ? i : s->best;
            s->is_random = s->is_random == n && is_random(s->of->patterns->at[i]) ? i : s->is_random;
            s->counted++;
        }
    }
    const koksma__estimate power = {s->random, s->random, s->random};
    const koksma__estimate *random = s->is_random < n ? &s->trends[s->is_random].slope : &power;
    for (size_t i = 0; i < n; i++) {
        const koksma__estimate *e = &s->trends[i].slope;
        s->tied += may_be_fastest(s, i);
        s->faster += e->value < random->value && !are_tied(e, random);
    }
}

static void say_power(koksma__document *d, const koksma__estimate *e)
{
    koksma__doc_say(d, "N^%.3f^", e->value);
    if (!isnan(e->low) && e->low < e->high) {
        koksma__doc_say(d, " (%.3f to %.3f)", e->low, e->high);
    }
}

/* Writes the patterns that may fall fastest, narrow intervals first and those without one last; names at most NAMED. */
static void say_tied(koksma__report *r, koksma__document *d, const slopes *s)
{
    double *halves = koksma__report_memory(r, s->tied, sizeof *halves);
    size_t *tied = koksma__report_memory(r, 2 * s->tied, sizeof *tied), *by = tied + s->tied, n = 0, named = 0;
    for (size_t i = 0; !r->status && i < s->of->patterns->n; i++) {
        if (may_be_fastest(s, i)) {
            halves[n] = half(&s->trends[i].slope);
            tied[n++] = i;
        }
    }
    if (r->status) {
        return;
    }
    koksma__order_means(halves, 1, n, false, by);
    koksma__doc_say(d, "undecided between %zu of %zu patterns: ", s->tied, s->counted);
    for (; named < NAMED && named < n; named++) {
        const size_t at = tied[by[named]];
        koksma__doc_say(d, "%s%s%s as ", named ? ", " : "", s->of->patterns->at[at], named ? "" : " falls");
        say_power(d, &s->trends[at].slope);
    }
    if (n > named) {
        koksma__doc_say(d, ", and %zu more", n - named);
    }
}

static void say_fastest(koksma__report *r, koksma__document *d, const slopes *s)
{
    if (s->tied > 1) {
        say_tied(r, d, s);
    } else {
        koksma__doc_say(d, "%s falls %sas ", s->of->patterns->at[s->best], s->counted > 1 ? "fastest, " : "");
        say_power(d, &s->trends[s->best].slope);
    }
    if (s->is_random == s->of->patterns->n && !isnan(s->random)) {
        koksma__doc_say(d, "; %zu of %zu patterns surely fall faster than N^%.1f^", s->faster, s->counted, s->random);
    } else if (s->is_random < s->of->patterns->n && s->counted > 1) {
        koksma__doc_say(d, "; %zu of %zu other patterns surely fall faster than %s, which falls as ", s->faster,
                        s->counted - 1, s->of->patterns->at[s->is_random]);
        say_power(d, &s->trends[s->is_random].slope);
    }
}

static void say_slopes(koksma__report *r, koksma__document *d, slopes *s)
{
    count(s);
    if (!s->counted) {
        return;
    }
    if (s->sense == FALLS) {
        koksma__doc_answer(d, s->tied == 1, "*%s:* ", s->of->name);
        say_fastest(r, d, s);
    } else {
        koksma__doc_paragraph(d, "*%s:* %s", s->of->name,
                              s->sense == LARGER
                                  ? "larger values are better, so patterns are not compared by how fast values fall"
                                  : "values follow no power law in N, so patterns are not compared by their slopes");
    }
    koksma__doc_say(d, ".");
}

/* ---- The table and the chart ------------------------------------------------------------------------------- */

/* Computes the lower bound of a measure over the sizes of a curve. Returns the bound's source; NULL if no bound is
   known. */
static const char *bound_of(const koksma__subject *s, const koksma__curve *like, koksma__curve *out)
{
    koksma_spec spec;
    koksma__bound bound;
    if (s->images || s->warp[0] || !like->n || koksma_measure_spec(s->measure, &spec) ||
        !koksma__lower_bound(spec.measure, s->points->dim, &bound)) {
        return NULL;
    }
    out->n = like->n;
    for (size_t i = 0; i < like->n; i++) {
        const double n = out->x[i] = like->x[i];
        out->y[i] = koksma__exactly(koksma__pow(n, -bound.power) * koksma__pow(koksma__log(n), bound.logs));
    }
    return bound.source;
}

/* Adds the row and the line of a bound. `scale` makes the line begin at a quarter of the first value of the first
   pattern's curve. */
static void add_bound(koksma__document *d, koksma__document *chart, const char *who, const koksma__curve *bound,
                      double scale)
{
    char text[96];
    koksma__estimate slope = trend_of(bound).slope;
    slope.low = slope.high = slope.value;
    snprintf(text, sizeof text, "lower bound (%s), scaled", who);
    koksma__doc_series(chart, text, NULL, KOKSMA__SERIES_THEORY);
    for (size_t i = 0; i < bound->n; i++) {
        koksma__doc_point(chart, bound->x[i], bound->y[i].mean * scale, NAN, NAN);
    }
    snprintf(text, sizeof text, "slope of the bound itself over these sizes (%s)", who);
    koksma__doc_row(d, "ti", text, slope);
}

/* Adds the rows and lines of all patterns, of the sizes at which their means are above 0, and of the bound. */
static void add_rows(koksma__report *r, koksma__document *d, koksma__document *chart, slopes *s)
{
    const koksma__subject *of = s->of;
    const size_t sizes = of->n->n;
    koksma__curve c = koksma__curve_of(r, sizes), bound = koksma__curve_of(r, sizes);
    const char *who = NULL;
    double scale = 1;
    for (size_t p = 0; !r->status && p < of->patterns->n; p++) {
        koksma__doc_series(chart, of->patterns->at[p], NULL, KOKSMA__SERIES_LINE);
        c.n = 0;
        for (size_t k = 0; k < sizes; k++) {
            koksma__curve_add(&c, of->n->at[k], s->means[p * sizes + k]);
        }
        for (size_t i = 0; i < c.n; i++) {
            koksma__doc_point(chart, c.x[i], c.y[i].mean, c.y[i].low, c.y[i].high);
        }
        s->trends[p] = trend_of(&c);
        koksma__doc_row(d, "tit", of->patterns->at[p], s->trends[p].slope,
                        s->trends[p].off_line ? "no"
                        : c.n < sizes         ? "of fewer sizes"
                                              : "");
        if (p == 0 && (who = bound_of(of, &c, &bound))) {
            scale = c.y[0].mean / bound.y[0].mean / 4;
        }
    }
    if (!r->status && who) {
        add_bound(d, chart, who, &bound, scale);
    }
}

static void add_subject(koksma__report *r, koksma__document *d, const char *id, size_t number,
                        const koksma__subject *of)
{
    char title[256];
    const size_t n = of->patterns->n;
    slopes s = {.of = of,
                .sense = sense_of(of),
                .means = koksma__read_means(r, of),
                .trends = koksma__report_memory(r, n, sizeof *s.trends),
                .random = random_slope(of)};
    koksma__document rows = {0}, chart = {0};
    if (r->status) {
        return;
    }
    snprintf(title, sizeof title, "%.200s against N", of->name);
    koksma__doc_chart(&chart, &(koksma__chart){title, of->images ? "samples a pixel" : "points",
                                               of->images ? of->metric : of->measure, true, true,
                                               s.sense == LARGER ? 1 : -1});
    koksma__doc_table(&rows, "slopes-%.32s-%zu", id, number);
    koksma__doc_sort(&rows, "slope", false);
    koksma__doc_columns(&rows, "t pattern;i3 slope##%s;t power law?", of->metric);
    add_rows(r, &rows, &chart, &s);
    say_slopes(r, d, &s);
    koksma__doc_append(d, &rows);
    koksma__doc_append(d, &chart);
}

void koksma__answer_slopes(koksma__report *r, koksma__document *d, const koksma__topic *topic)
{
    koksma__subject s;
    for (size_t i = 0; !r->status && koksma__topic_subject(topic, i, true, &s); i++) {
        if (s.n->n > 1) {
            add_subject(r, d, topic->id, i + 1, &s);
        }
    }
}
