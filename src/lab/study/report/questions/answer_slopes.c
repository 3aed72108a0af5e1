/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Answers how fast measures and errors fall with n: by average slopes in log-log over the larger half of the sizes,
 * with intervals, and with the known lower bound of a measure for comparison. The page sorts the patterns by the
 * widths of the intervals, the narrowest first. A bound that contains a logarithm is not a power law; its row has the
 * average slope of the bound over the same sizes.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "measures/shared/shared.h"
#include "stats/stats.h"
#include "study/report/means.h"
#include "study/report/questions/topic.h"
#include "study/report/slope_words.h"

/* The means of one pattern over the sizes: x and y hold the n sizes whose mean is above 0; `all` holds all sizes. */
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

/* The subject of a curve: a measure (with a warp) of points, or the error of images of a scene and variant. */
typedef struct subject {
    const koksma__discrepancy_block *discrepancy;
    const koksma__image_block *image;
    const char *measure, *warp, *scene, *variant;
    const char *metric; /* metric of the image errors */
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
        const koksma__image_mean of = {s->image, s->scene, s->variant, pattern, n->at[i]};
        status = s->image ? koksma__image_mean_by(study, &of, s->metric, NULL, &mean)
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

/* The trend over the larger half of the sizes, and over at least three sizes if there are that many. */
static koksma__trend trend_of(const curve *c)
{
    const size_t half = c->n - c->n / 2, least = c->n < 3 ? c->n : 3, n = half < least ? least : half;
    return koksma__trend_of(c->x + (c->n - n), c->y + (c->n - n), n);
}

/* Computes the lower bound of a measure over the sizes of a curve. Returns the bound's source; NULL if no bound is
   known. */
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

static void draw_curve(koksma__document *chart, const curve *c, const char *label)
{
    koksma__doc_series_begin(chart, label, KOKSMA__SERIES_LINE);
    for (size_t i = 0; i < c->n; i++) {
        koksma__doc_point(chart, c->x[i], c->y[i].mean, c->y[i].low, c->y[i].high);
    }
    koksma__doc_end(chart);
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

/* The slope of independent random points: standard deviations fall as N^-1/2, and a metric as a power of them. */
static double random_slope(const subject *s)
{
    koksma_metric_spec spec;
    if (!s->image) {
        return -0.5;
    }
    return koksma_metric_parse(s->metric, &spec) || !spec.metric->order ? (double)NAN : -0.5 * spec.metric->order;
}

static void name_subject(const subject *s, char *text, size_t size)
{
    if (s->image) {
        koksma__case_name(s->scene, s->variant, text, size);
    } else {
        snprintf(text, size, "%s%s%s", s->measure, s->warp[0] ? " through " : "", s->warp);
    }
}

static void add_heads(koksma__document *d, const subject *s)
{
    char text[64];
    koksma__doc_head(d, "pattern");
    koksma__doc_column(
        d, &(koksma__column){
               .name = "slope", .group = s->image ? s->metric : NULL, .type = KOKSMA__COLUMN_INTERVAL, .digits = 3});
    koksma__doc_head(d, "power law?");
    for (size_t i = 0; i < sizes(s)->n; i++) {
        snprintf(text, sizeof text, "N = %lld", sizes(s)->at[i]);
        koksma__doc_column(
            d, &(koksma__column){.name = text, .type = KOKSMA__COLUMN_INTERVAL, .digits = 3, .hidden = true});
    }
}

static void add_row(koksma__document *d, const subject *s, const char *pattern, const koksma__trend *trend,
                    const curve *c)
{
    koksma__doc_row(d);
    koksma__doc_text(d, pattern);
    koksma__doc_interval(d, trend->slope);
    koksma__doc_text(d, trend->off_line ? "no" : "");
    for (size_t i = 0; i < sizes(s)->n; i++) {
        const koksma__estimate none = {NAN, NAN, NAN};
        koksma__doc_interval(d, c->all[i].n ? koksma__estimate_of(&c->all[i]) : none);
    }
}

/* Adds the row and the line of a bound. `scale` makes the line begin at a quarter of the first value of the first
   pattern's curve. */
static void add_bound(koksma__document *d, koksma__document *chart, const char *who, const curve *bound, double scale)
{
    char text[96];
    koksma__estimate slope = trend_of(bound).slope;
    slope.low = slope.high = slope.value;
    snprintf(text, sizeof text, "lower bound (%s), scaled", who);
    koksma__doc_series_begin(chart, text, KOKSMA__SERIES_THEORY);
    for (size_t i = 0; i < bound->n; i++) {
        koksma__doc_point(chart, bound->x[i], bound->y[i].mean * scale, NAN, NAN);
    }
    koksma__doc_end(chart);
    snprintf(text, sizeof text, "slope of the bound itself over these sizes (%s)", who);
    koksma__doc_row(d);
    koksma__doc_text(d, text);
    koksma__doc_interval(d, slope);
}

/* Adds the rows and curves of all patterns, and stores their slopes and their numbers of means that are 0. */
static koksma_status add_rows(koksma_study *study, koksma__document *d, const subject *s, koksma__document *chart,
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
        if (status) {
            break;
        }
        trends[p] = trend_of(&c);
        zeros[p] = c.zeros;
        if (p == 0 && (who = bound_of(s, &c, &bound))) {
            scale = c.y[0].mean / bound.y[0].mean / 4;
        }
        draw_curve(chart, &c, pattern);
        add_row(d, s, pattern, &trends[p], &c);
    }
    if (!status && who) {
        add_bound(d, chart, who, &bound, scale);
    }
    curve_fini(&c);
    curve_fini(&bound);
    return status;
}

static koksma_status add_subject(koksma_study *study, koksma__document *d, const char *id, size_t number,
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
    koksma__trend *trends = calloc(n, sizeof *trends);
    size_t *zeros = calloc(n, sizeof *zeros);
    koksma__document rows = {0}, chart = {0};
    koksma_status status = trends && zeros ? KOKSMA_OK : koksma__fail_memory(n * sizeof *trends);
    if (!status) {
        koksma__doc_chart_begin(&chart, &(koksma__chart){title, s->image ? "samples a pixel" : "points",
                                                         s->image ? s->metric : s->measure, true, true,
                                                         sense_of(s) == KOKSMA__LARGER ? 1 : -1});
        koksma__doc_sorted_table_begin(&rows, file, "slope", true, false);
        add_heads(&rows, s);
        status = add_rows(study, &rows, s, &chart, trends, zeros);
        koksma__doc_table_end(&rows);
        koksma__doc_end(&chart);
        const koksma__slopes slopes = {
            name, (const char *const *)patterns(s)->at, trends, zeros, n, sizes(s)->n, sense_of(s), random_slope(s)};
        if (!status) {
            koksma__slopes_sentence(d, &slopes);
        }
        koksma__doc_append(d, &rows);
        koksma__doc_append(d, &chart);
    }
    free(trends);
    free(zeros);
    return status;
}

koksma_status koksma__answer_slopes(koksma_study *study, koksma__document *d, const koksma__topic *topic)
{
    koksma_status status = KOKSMA_OK;
    size_t number = 0;
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *block = topic->discrepancies[b];
        const size_t warps = block->warps.n ? block->warps.n : 1;
        for (size_t i = 0; !status && i < block->measures.n * warps; i++) {
            const subject s = {.discrepancy = block,
                               .measure = block->measures.at[i / warps],
                               .warp = block->warps.n ? block->warps.at[i % warps] : ""};
            status = add_subject(study, d, topic->id, ++number, &s);
        }
    }
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *image = topic->images[b];
        for (size_t i = 0; !status && i < image->scenes.n * image->variants.n; i++) {
            const subject s = {.image = image,
                               .scene = image->scenes.at[i / image->variants.n],
                               .variant = image->variants.at[i % image->variants.n],
                               .metric = topic->metric};
            status = add_subject(study, d, topic->id, ++number, &s);
        }
    }
    return status;
}
