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
#include "measures/shared/lower_bounds.h"
#include "stats/slopes.h"
#include "study/report/answers.h"
#include "study/report/slope_words.h"

/* The means of one pattern over the sizes, with room for all of them: those above 0, and all. */
typedef struct curve {
    size_t n, zeros;
    double *x;
    koksma__summary *y, *all;
} curve;

static koksma_status curve_init(curve *c, size_t room)
{
    *c = (curve){.x = calloc(room, sizeof *c->x), .y = calloc(2 * room, sizeof *c->y)};
    c->all = c->y ? c->y + room : NULL;
    return c->x && c->y ? KOKSMA_OK : koksma__fail_memory(room * (sizeof *c->x + 2 * sizeof *c->y));
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
    out->n = out->zeros = 0;
    for (size_t i = 0; !status && i < n->n; i++) {
        koksma__summary mean = {0};
        status = s->image ? koksma__image_mean(study, s->image, s->scene, s->variant, pattern, n->at[i], NULL, &mean)
                          : koksma__discrepancy_mean(study, s->discrepancy, s->warp, pattern, n->at[i], s->measure,
                                                     NULL, &mean);
        out->all[i] = mean;
        out->zeros += !status && mean.n && mean.mean <= 0;
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
    koksma_spec spec;
    koksma__bound bound;
    if (s->image || s->warp[0] || !like->n || koksma_measure_spec(s->measure, &spec) ||
        !koksma__lower_bound(spec.measure, s->discrepancy->dim, &bound)) {
        return NULL;
    }
    out->n = like->n;
    for (size_t i = 0; i < like->n; i++) {
        const double n = out->x[i] = like->x[i];
        out->y[i] = koksma__exactly(pow(n, -bound.power) * pow(log(n), bound.logs));
    }
    return bound.source;
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

static koksma__slope_sense sense_of(const subject *s)
{
    koksma_spec spec;
    if (s->image || koksma_measure_spec(s->measure, &spec)) {
        return KOKSMA__FALLS;
    }
    return spec.measure->larger_is_better               ? KOKSMA__LARGER
           : spec.measure->family == KOKSMA_FAMILY_NONE ? KOKSMA__NO_SIZE
                                                        : KOKSMA__FALLS;
}

static void name_subject(const subject *s, char *text, size_t size)
{
    if (s->image) {
        koksma__case_name(s->scene, s->variant, text, size);
    } else {
        snprintf(text, size, "%s%s%s", s->measure, s->warp[0] ? " through " : "", s->warp);
    }
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
    for (size_t i = 0; i < sizes(s)->n; i++) {
        const koksma__estimate none = {NAN, NAN, NAN};
        koksma__grid_interval(g, c->all[i].n ? koksma__estimate_of(&c->all[i]) : none, 3);
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

/* All patterns' rows, slopes and curves, and how many means are 0. */
static koksma_status add_rows(koksma_study *study, koksma__grid *g, const subject *s, koksma__chart *chart,
                              koksma__trend *trends, size_t *zeros)
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
        zeros[p] = c.zeros;
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
    size_t *zeros = calloc(n, sizeof *zeros);
    koksma_status status = chart.series && trends && zeros
                               ? KOKSMA_OK
                               : koksma__fail_memory(sizeof *chart.series * KOKSMA__CHART_SERIES);
    if (!status) {
        koksma__html rows = {0};
        koksma__grid grid;
        koksma__grid_open(&grid, &rows, file);
        add_heads(&grid, s);
        status = add_rows(study, &grid, s, &chart, trends, zeros);
        koksma__grid_close(&grid);
        if (!status) {
            const koksma__slopes slopes = {
                name, (const char *const *)patterns(s)->at, trends, zeros, n, sizes(s)->n, sense_of(s)};
            koksma__slopes_sentence(h, &slopes);
            koksma__html_add(h, "%s", rows.text ? rows.text : "");
            koksma__html_chart(h, &chart);
        }
        h->failed |= rows.failed;
        free(rows.text);
    }
    free(chart.series);
    free(trends);
    free(zeros);
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
