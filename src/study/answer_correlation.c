/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Does a measure order the patterns as the error of images does? For every scene, variant and number of samples the
 * rank correlation, over patterns, of the mean of a measure of n points with the mean error of images of n samples a
 * pixel; its interval is a bootstrap over the patterns.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "study/answers.h"

enum { MAX_PATTERNS = KOKSMA__CHART_POINTS, MAX_MEASURES = 64, MAX_VARIANTS = 16, SAMPLES = 1000 };

typedef struct pairs {
    size_t n;
    double x[MAX_PATTERNS], y[MAX_PATTERNS], low[MAX_PATTERNS], high[MAX_PATTERNS];
    const char *patterns[MAX_PATTERNS];
} pairs;

typedef struct point {
    const koksma__image_block *image;
    const char *scene, *variant;
    long long spp;
    const koksma__discrepancy_block *discrepancy;
    const char *measure;
} point;

/* Sums of rho by measure and variant. */
typedef struct sums {
    size_t n_measures, n_variants;
    const char *measures[MAX_MEASURES], *variants[MAX_VARIANTS];
    double rho[MAX_MEASURES][MAX_VARIANTS];
    size_t cases[MAX_MEASURES][MAX_VARIANTS], sure[MAX_MEASURES];
} sums;

static bool has(const koksma__wholes *wholes, long long n)
{
    for (size_t i = 0; i < wholes->n; i++) {
        if (wholes->at[i] == n) {
            return true;
        }
    }
    return false;
}

static size_t index_of(const char **list, size_t *n, size_t max, const char *text)
{
    for (size_t i = 0; i < *n; i++) {
        if (!strcmp(list[i], text)) {
            return i;
        }
    }
    if (*n == max) {
        return max - 1;
    }
    list[*n] = text;
    return (*n)++;
}

/* The patterns that both blocks have rows of. */
static koksma_status collect(koksma_study *study, const point *p, pairs *out)
{
    koksma_status status = KOKSMA_OK;
    out->n = 0;
    for (size_t i = 0; !status && i < p->image->patterns.n && out->n < MAX_PATTERNS; i++) {
        const char *pattern = p->image->patterns.at[i];
        koksma__summary x, y;
        status = koksma__discrepancy_mean(study, p->discrepancy, "", pattern, p->spp, p->measure, NULL, &x);
        status =
            status ? status : koksma__image_mean(study, p->image, p->scene, p->variant, pattern, p->spp, NULL, &y);
        if (!status && x.n && y.n) {
            out->x[out->n] = x.mean;
            out->y[out->n] = y.mean;
            out->low[out->n] = y.low;
            out->high[out->n] = y.high;
            out->patterns[out->n++] = pattern;
        }
    }
    return status;
}

typedef koksma_status (*visitor)(koksma_study *study, void *context, const point *p);

static koksma_status visit_measures(koksma_study *study, const koksma__topic *topic, point *p, visitor visit,
                                    void *context)
{
    koksma_status status = KOKSMA_OK;
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        p->discrepancy = topic->discrepancies[b];
        if (!p->discrepancy->warps.n && has(&p->discrepancy->n, p->spp)) {
            for (size_t m = 0; !status && m < p->discrepancy->measures.n; m++) {
                p->measure = p->discrepancy->measures.at[m];
                status = visit(study, context, p);
            }
        }
    }
    return status;
}

/* Every scene, variant, number of samples and measure. */
static koksma_status visit_all(koksma_study *study, const koksma__topic *topic, visitor visit, void *context)
{
    koksma_status status = KOKSMA_OK;
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *i = topic->images[b];
        for (size_t k = 0; !status && k < i->scenes.n * i->variants.n * i->spp.n; k++) {
            point p = {.image = i,
                       .scene = i->scenes.at[k / (i->variants.n * i->spp.n)],
                       .variant = i->variants.at[k / i->spp.n % i->variants.n],
                       .spp = i->spp.at[k % i->spp.n]};
            status = visit_measures(study, topic, &p, visit, context);
        }
    }
    return status;
}

typedef struct listing {
    koksma__grid *grid;
    sums *sums;
} listing;

static koksma_status list_row(koksma_study *study, void *context, const point *p)
{
    listing *l = context;
    pairs found;
    koksma__estimate rho, tau;
    koksma_status status = collect(study, p, &found);
    if (status || found.n < 4) {
        return status;
    }
    const uint64_t seed = koksma__job_seed("correlation|%s|%s|%lld|%s", p->scene, p->variant, p->spp, p->measure);
    status = koksma__bootstrap_pairs(found.x, found.y, found.n, koksma__spearman, SAMPLES, seed, &rho);
    status =
        status ? status : koksma__bootstrap_pairs(found.x, found.y, found.n, koksma__kendall, SAMPLES, seed, &tau);
    if (status || isnan(rho.value)) {
        return status;
    }
    koksma__grid_row(l->grid);
    koksma__grid_text(l->grid, p->scene);
    koksma__grid_text(l->grid, p->variant[0] ? p->variant : "defaults");
    koksma__grid_number(l->grid, (double)p->spp, 7);
    koksma__grid_text(l->grid, p->measure);
    koksma__grid_number(l->grid, (double)found.n, 7);
    koksma__grid_interval(l->grid, rho, 3);
    koksma__grid_interval(l->grid, tau, 3);
    sums *s = l->sums;
    const size_t m = index_of(s->measures, &s->n_measures, MAX_MEASURES, p->measure);
    const size_t v = index_of(s->variants, &s->n_variants, MAX_VARIANTS, p->variant);
    s->rho[m][v] += rho.value;
    s->cases[m][v]++;
    s->sure[m] += rho.low > 0 || rho.high < 0;
    return KOKSMA_OK;
}

static double mean_rho(const sums *s, size_t m, size_t *cases)
{
    double total = 0;
    *cases = 0;
    for (size_t v = 0; v < s->n_variants; v++) {
        total += s->rho[m][v];
        *cases += s->cases[m][v];
    }
    return *cases ? total / (double)*cases : (double)NAN;
}

/* The measures, best first, as indices. */
static void order(const sums *s, size_t by[MAX_MEASURES])
{
    for (size_t m = 0; m < s->n_measures; m++) {
        size_t at = m, cases;
        const double value = fabs(mean_rho(s, m, &cases));
        for (; at > 0 && fabs(mean_rho(s, by[at - 1], &cases)) < value; at--) {
            by[at] = by[at - 1];
        }
        by[at] = m;
    }
}

static void add_summary(koksma__html *h, const char *id, const sums *s, const size_t *by)
{
    koksma__grid grid;
    char text[KOKSMA__VARIANT_TEXT + 64];
    size_t cases, worst_cases;
    const double best = mean_rho(s, by[0], &cases), worst = mean_rho(s, by[s->n_measures - 1], &worst_cases);
    koksma__html_add(h, "<p><strong>Answer.</strong> <code>");
    koksma__html_text(h, s->measures[by[0]]);
    koksma__html_add(h,
                     "</code> orders the patterns most as the error of the images does: mean rank correlation "
                     "(Spearman) %+.2f over %zu cases, in %zu of which its interval excludes 0; last is <code>",
                     best, cases, s->sure[by[0]]);
    koksma__html_text(h, s->measures[by[s->n_measures - 1]]);
    koksma__html_add(h, "</code> with %+.2f. A measure that is better when larger has negative numbers.</p>\n",
                     worst);
    snprintf(text, sizeof text, "correlation-%s", id);
    koksma__grid_open(&grid, h, text);
    koksma__grid_head(&grid, "measure");
    koksma__grid_head(&grid, "mean Spearman");
    koksma__grid_head(&grid, "cases");
    koksma__grid_head(&grid, "cases that exclude 0");
    for (size_t v = 0; v < s->n_variants; v++) {
        snprintf(text, sizeof text, "mean, %s", s->variants[v][0] ? s->variants[v] : "defaults");
        koksma__grid_head(&grid, text);
    }
    for (size_t i = 0; i < s->n_measures; i++) {
        const size_t m = by[i];
        koksma__grid_row(&grid);
        koksma__grid_text(&grid, s->measures[m]);
        koksma__grid_number(&grid, mean_rho(s, m, &cases), 3);
        koksma__grid_number(&grid, (double)cases, 7);
        koksma__grid_number(&grid, (double)s->sure[m], 7);
        for (size_t v = 0; v < s->n_variants; v++) {
            koksma__grid_number(&grid, s->cases[m][v] ? s->rho[m][v] / (double)s->cases[m][v] : (double)NAN, 3);
        }
    }
    koksma__grid_close(&grid);
}

typedef struct plots {
    koksma__html *html;
    const char *measure;
    size_t left;
} plots;

/* A scatter plot of the best measure in the middle number of samples of a block. */
static koksma_status add_scatter(koksma_study *study, void *context, const point *p)
{
    plots *to = context;
    pairs found;
    if (!to->left || strcmp(p->measure, to->measure) != 0 || p->spp != p->image->spp.at[p->image->spp.n / 2]) {
        return KOKSMA_OK;
    }
    const koksma_status status = collect(study, p, &found);
    koksma__chart_series *series = calloc(KOKSMA__CHART_SERIES, sizeof *series);
    if (status || !series) {
        free(series);
        return status ? status : koksma__fail_memory(KOKSMA__CHART_SERIES * sizeof *series);
    }
    size_t n = 0;
    for (; n < found.n && n < KOKSMA__CHART_SERIES; n++) {
        series[n] = (koksma__chart_series){
            .n = 1, .x = {found.x[n]}, .y = {found.y[n]}, .low = {found.low[n]}, .high = {found.high[n]}};
        snprintf(series[n].label, sizeof series[n].label, "%.95s", found.patterns[n]);
    }
    char title[256], name[KOKSMA__VARIANT_TEXT + 64];
    koksma__case_name(p->scene, p->variant, name, sizeof name);
    koksma__snprintf(title, sizeof title, "%.120s, %lld samples: error against %.60s, Spearman %.2f", name, p->spp,
                     p->measure, koksma__spearman(found.x, found.y, found.n));
    const koksma__chart chart = {title, p->measure, "mean absolute error", true, true, n, series};
    koksma__html_chart(to->html, &chart);
    free(series);
    to->left--;
    return KOKSMA_OK;
}

koksma_status koksma__answer_correlation(koksma_study *study, koksma__html *h, const koksma__topic *topic)
{
    koksma__grid grid;
    koksma__html list = {0};
    sums *s = calloc(1, sizeof *s);
    size_t by[MAX_MEASURES];
    char name[64];
    if (!s) {
        return koksma__fail_memory(sizeof *s);
    }
    snprintf(name, sizeof name, "correlations-%.40s", topic->id);
    koksma__grid_open(&grid, &list, name);
    static const char *const heads[] = {"scene", "options", "samples", "measure", "patterns"};
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) {
        koksma__grid_head(&grid, heads[i]);
    }
    koksma__grid_head_interval(&grid, "Spearman");
    koksma__grid_head_interval(&grid, "Kendall");
    listing l = {&grid, s};
    koksma_status status = visit_all(study, topic, list_row, &l);
    koksma__grid_close(&grid);
    if (!status && s->n_measures) {
        order(s, by);
        add_summary(h, topic->id, s, by);
        koksma__html_add(h, "<details><summary>Every case, with intervals</summary>\n%s</details>\n",
                         list.text ? list.text : "");
        koksma__html_add(h, "<div class=\"figures\">\n");
        plots to = {h, s->measures[by[0]], 6};
        status = visit_all(study, topic, add_scatter, &to);
        koksma__html_add(h, "</div>\n");
    }
    h->failed |= list.failed;
    free(list.text);
    free(s);
    return status;
}
