/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How measures and errors fall with n: average slopes in log-log over the larger half of the sizes, with intervals,
 * beside what theory says is possible. A bound with a logarithm has no slope; the slope of the bound itself over the
 * same sizes stands in its place.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/answers.h"

/* No pattern falls faster than n^power (log n)^logs in the plane. */
static const struct {
    const char *measure, *who;
    double power, logs;
} bounds[] = {
    {"star", "Schmidt 1972", -1, 1},      {"l2-star", "Roth 1954", -1, 0.5},       {"extreme", "Schmidt 1972", -1, 1},
    {"edge", "Alexander 1990", -0.75, 0}, {"l2-edge", "Alexander 1990", -0.75, 0}, {"disk", "Beck 1987", -0.75, 0},
    {"l2-disk", "Beck 1987", -0.75, 0},
};

/* The means of one pattern over the sizes, with room for all of them. */
typedef struct curve {
    size_t n;
    double *x;
    koksma__summary *y;
} curve;

static koksma_status curve_init(curve *c, size_t room)
{
    *c = (curve){.x = calloc(room, sizeof *c->x), .y = calloc(room, sizeof *c->y)};
    return c->x && c->y ? KOKSMA_OK : koksma__fail_memory(room * (sizeof *c->x + sizeof *c->y));
}

static void curve_fini(curve *c)
{
    free(c->x);
    free(c->y);
}

/* What a curve is of. */
typedef struct subject {
    const koksma__discrepancy_block *discrepancy;
    const koksma__image_block *image;
    const char *measure, *warp, *scene, *variant;
} subject;

static const koksma__wholes *sizes(const subject *s)
{
    return s->image ? &s->image->spp : &s->discrepancy->n;
}

static const koksma__texts *patterns(const subject *s)
{
    return s->image ? &s->image->patterns : &s->discrepancy->patterns;
}

static koksma_status collect(koksma_study *study, const subject *s, const char *pattern, curve *out)
{
    koksma_status status = KOKSMA_OK;
    const koksma__wholes *n = sizes(s);
    out->n = 0;
    for (size_t i = 0; !status && i < n->n; i++) {
        koksma__summary mean;
        status = s->image ? koksma__image_mean(study, s->image, s->scene, s->variant, pattern, n->at[i], NULL, &mean)
                          : koksma__discrepancy_mean(study, s->discrepancy, s->warp, pattern, n->at[i], s->measure,
                                                     NULL, &mean);
        if (!status && mean.n && mean.mean > 0) {
            out->x[out->n] = (double)n->at[i];
            out->y[out->n++] = mean;
        }
    }
    return status;
}

/* Over the larger half, at least three sizes where there are as many. */
static koksma__trend trend_of(const curve *c)
{
    const size_t half = c->n - c->n / 2, least = c->n < 3 ? c->n : 3, n = half < least ? least : half;
    return koksma__trend_of(c->x + (c->n - n), c->y + (c->n - n), n);
}

/* The bound over the sizes of a curve; NULL: none is known, else whose it is. */
static const char *bound_of(const subject *s, const curve *like, curve *out)
{
    char measure[64];
    snprintf(measure, sizeof measure, "%.*s", (int)strcspn(s->measure ? s->measure : "", ":"),
             s->measure ? s->measure : "");
    for (size_t b = 0; b < sizeof bounds / sizeof *bounds; b++) {
        if (!s->image && !s->warp[0] && s->discrepancy->dim == 2 && !strcmp(bounds[b].measure, measure) && like->n) {
            out->n = like->n;
            for (size_t i = 0; i < like->n; i++) {
                const double n = out->x[i] = like->x[i];
                out->y[i] = koksma__exactly(pow(n, bounds[b].power) * pow(log(n), bounds[b].logs));
            }
            return bounds[b].who;
        }
    }
    return NULL;
}

/* Where there are more points than a chart has, some evenly among them. */
static void plot_curve(koksma__chart_series *to, const curve *c, const char *label, bool theory, double scale)
{
    to->line = true;
    to->theory = theory;
    to->n = c->n < KOKSMA__CHART_POINTS ? c->n : KOKSMA__CHART_POINTS;
    snprintf(to->label, sizeof to->label, "%.95s", label);
    for (size_t i = 0; i < to->n; i++) {
        const size_t k = to->n < c->n ? i * (c->n - 1) / (to->n - 1) : i;
        to->x[i] = c->x[k];
        to->y[i] = c->y[k].mean * scale;
        to->low[i] = theory ? to->y[i] : c->y[k].low;
        to->high[i] = theory ? to->y[i] : c->y[k].high;
    }
}

static void name_subject(const subject *s, char *text, size_t size)
{
    if (s->image) {
        koksma__case_name(s->scene, s->variant, text, size);
    } else {
        snprintf(text, size, "%s%s%s", s->measure, s->warp[0] ? " through " : "", s->warp);
    }
}

/* The patterns that have a slope. */
typedef struct standing {
    size_t counted, best, tied, faster, off_line; /* tied: the best and those that are not told apart from it */
} standing;

static double half(const koksma__estimate *e)
{
    return e->high - e->value;
}

/* Not told apart: the interval of the difference of two slopes, as independent as their trials, has 0; or they are
   equal; or one has no interval. */
static bool are_tied(const koksma__estimate *a, const koksma__estimate *b)
{
    return !koksma__compare(a->value, b->value) || !(fabs(a->value - b->value) > hypot(half(a), half(b)));
}

static standing stand(const koksma__trend *trends, size_t n)
{
    standing s = {0};
    for (size_t i = 0; i < n; i++) {
        const koksma__estimate *e = &trends[i].slope, *best = &trends[s.best].slope;
        if (!isnan(e->value)) {
            s.best = isnan(best->value) || e->value < best->value ? i : s.best;
            s.counted++;
            s.faster += e->high < -0.5;
            s.off_line += trends[i].off_line;
        }
    }
    for (size_t i = 0; i < n; i++) {
        s.tied += !isnan(trends[i].slope.value) && are_tied(&trends[i].slope, &trends[s.best].slope);
    }
    return s;
}

static void add_power(koksma__html *h, const koksma__estimate *e)
{
    koksma__html_add(h, "N<sup>%.3f</sup>", e->value);
    if (!isnan(e->low) && e->low < e->high) {
        koksma__html_add(h, " (%.3f to %.3f)", e->low, e->high);
    }
}

/* The best and the others of its rank in their order, no more than 4 by name. */
static void add_tied(koksma__html *h, const char *const *labels, const koksma__trend *trends, size_t n,
                     const standing *s)
{
    enum { NAMED = 4 };
    koksma__html_text(h, labels[s->best]);
    koksma__html_add(h, " falls as ");
    add_power(h, &trends[s->best].slope);
    koksma__html_add(h, "; not told apart from it: ");
    size_t named = 0;
    for (size_t i = 0; i < n && named < NAMED; i++) {
        const koksma__estimate *e = &trends[i].slope;
        if (i != s->best && !isnan(e->value) && are_tied(e, &trends[s->best].slope)) {
            koksma__html_add(h, named++ ? ", " : "");
            koksma__html_text(h, labels[i]);
            koksma__html_add(h, " as ");
            add_power(h, e);
        }
    }
    if (s->tied - 1 > named) {
        koksma__html_add(h, ", and %zu more", s->tied - 1 - named);
    }
}

/* The sentence: who falls fastest, who is better than random's n^-1/2. */
static void add_sentence(koksma__html *h, const char *name, const char *const *labels, const koksma__trend *trends,
                         size_t n)
{
    const standing s = stand(trends, n);
    if (!s.counted) {
        return;
    }
    koksma__html_add(h, "<p><strong>");
    koksma__html_text(h, name);
    koksma__html_add(h, ":</strong> ");
    if (s.tied > 1) {
        add_tied(h, labels, trends, n, &s);
    } else {
        koksma__html_text(h, labels[s.best]);
        koksma__html_add(h, s.counted > 1 ? " falls fastest, as " : " falls as ");
        add_power(h, &trends[s.best].slope);
    }
    koksma__html_add(h, "; %zu of %zu patterns are surely faster than the N<sup>&#8722;1/2</sup> of random samples",
                     s.faster, s.counted);
    if (s.off_line) {
        koksma__html_add(h, "; in %zu of %zu the means lie on no line, and the slope is an average one", s.off_line,
                         s.counted);
    }
    koksma__html_add(h, ".</p>\n");
}

static void add_heads(koksma__grid *g, const subject *s)
{
    char text[64];
    koksma__grid_head(g, "pattern");
    koksma__grid_head_interval(g, "slope");
    koksma__grid_head(g, "on a line?");
    for (size_t i = 0; i < sizes(s)->n; i++) {
        snprintf(text, sizeof text, "N = %lld", sizes(s)->at[i]);
        koksma__grid_head_interval(g, text);
    }
}

static void add_row(koksma__grid *g, const subject *s, const char *pattern, const koksma__trend *trend,
                    const curve *c)
{
    koksma__grid_row(g);
    koksma__grid_text(g, pattern);
    koksma__grid_interval(g, trend->slope, 3);
    koksma__grid_text(g, trend->off_line ? "no" : "");
    for (size_t i = 0, k = 0; i < sizes(s)->n; i++) {
        const bool has = k < c->n && c->x[k] == (double)sizes(s)->at[i];
        const koksma__estimate none = {NAN, NAN, NAN};
        koksma__grid_interval(g, has ? koksma__estimate_of(&c->y[k++]) : none, 3);
    }
}

static void add_bound(koksma__grid *g, koksma__chart *chart, const char *who, const curve *bound, double scale)
{
    char text[96];
    snprintf(text, sizeof text, "lower bound (%s), scaled", who);
    plot_curve(&chart->series[chart->n++], bound, text, true, scale);
    koksma__estimate slope = trend_of(bound).slope;
    slope.low = slope.high = slope.value;
    snprintf(text, sizeof text, "slope of the bound itself over these sizes (%s)", who);
    koksma__grid_row(g);
    koksma__grid_text(g, text);
    koksma__grid_interval(g, slope, 3);
}

/* All patterns' rows, slopes and curves. */
static koksma_status add_rows(koksma_study *study, koksma__grid *g, const subject *s, koksma__chart *chart,
                              koksma__trend *trends)
{
    curve c = {0}, bound = {0};
    const char *who = NULL;
    double scale = 1;
    koksma_status status = curve_init(&c, sizes(s)->n);
    status = status ? status : curve_init(&bound, sizes(s)->n);
    for (size_t p = 0; !status && p < patterns(s)->n; p++) {
        const char *pattern = patterns(s)->at[p];
        status = collect(study, s, pattern, &c);
        trends[p] = status ? (koksma__trend){{NAN, NAN, NAN}, false} : trend_of(&c);
        if (!status && p == 0 && (who = bound_of(s, &c, &bound))) {
            scale = c.y[0].mean / bound.y[0].mean / 4;
        }
        if (!status && p + 1 < KOKSMA__CHART_SERIES) {
            plot_curve(&chart->series[chart->n++], &c, pattern, false, 1);
        }
        add_row(g, s, pattern, &trends[p], &c);
    }
    if (!status && who) {
        add_bound(g, chart, who, &bound, scale);
    }
    curve_fini(&c);
    curve_fini(&bound);
    return status;
}

static koksma_status add_subject(koksma_study *study, koksma__html *h, const char *id, size_t number,
                                 const subject *s)
{
    char name[KOKSMA__VARIANT_TEXT + 64], file[64], title[256];
    const size_t n = patterns(s)->n;
    if (sizes(s)->n < 2) {
        return KOKSMA_OK;
    }
    name_subject(s, name, sizeof name);
    snprintf(file, sizeof file, "slopes-%.32s-%zu", id, number);
    snprintf(title, sizeof title, "%.200s against N", name);
    koksma__chart chart = {.title = title,
                           .x_title = s->image ? "samples a pixel" : "points",
                           .y_title = s->image ? "mean absolute error" : s->measure,
                           .log_x = true,
                           .log_y = true,
                           .series = calloc(KOKSMA__CHART_SERIES, sizeof *chart.series),
                           .left_out = n < KOKSMA__CHART_SERIES ? 0 : n - (KOKSMA__CHART_SERIES - 1)};
    koksma__trend *trends = calloc(n, sizeof *trends);
    koksma_status status =
        chart.series && trends ? KOKSMA_OK : koksma__fail_memory(sizeof *chart.series * KOKSMA__CHART_SERIES);
    if (!status) {
        koksma__html rows = {0};
        koksma__grid grid;
        koksma__grid_open(&grid, &rows, file);
        add_heads(&grid, s);
        status = add_rows(study, &grid, s, &chart, trends);
        koksma__grid_close(&grid);
        if (!status) {
            add_sentence(h, name, (const char *const *)patterns(s)->at, trends, n);
            koksma__html_add(h, "%s", rows.text ? rows.text : "");
            koksma__html_chart(h, &chart);
        }
        h->failed |= rows.failed;
        free(rows.text);
    }
    free(chart.series);
    free(trends);
    return status;
}

koksma_status koksma__answer_slopes(koksma_study *study, koksma__html *h, const koksma__topic *topic)
{
    koksma_status status = KOKSMA_OK;
    size_t number = 0;
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *d = topic->discrepancies[b];
        const size_t warps = d->warps.n ? d->warps.n : 1;
        for (size_t i = 0; !status && i < d->measures.n * warps; i++) {
            const subject s = {.discrepancy = d,
                               .measure = d->measures.at[i / warps],
                               .warp = d->warps.n ? d->warps.at[i % warps] : ""};
            status = add_subject(study, h, topic->id, ++number, &s);
        }
    }
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *image = topic->images[b];
        for (size_t i = 0; !status && i < image->scenes.n * image->variants.n; i++) {
            const subject s = {.image = image,
                               .scene = image->scenes.at[i / image->variants.n],
                               .variant = image->variants.at[i % image->variants.n]};
            status = add_subject(study, h, topic->id, ++number, &s);
        }
    }
    return status;
}
