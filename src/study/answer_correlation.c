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
#include "core/room.h"
#include "core/status.h"
#include "study/cases.h"

/* Combinations of options beyond have no column of their own in the summary. */
enum { MAX_VARIANTS = 24, SAMPLES = 1000 };

/* Sums of rho of one measure, by variant. */
typedef struct measure_sums {
    const koksma__measured *of;
    double total, rho[MAX_VARIANTS];
    size_t all, cases[MAX_VARIANTS];
    size_t sure, few; /* cases whose interval excludes 0; that have too few patterns for one */
} measure_sums;

typedef struct sums {
    size_t n, room, n_variants, room_of_variants;
    size_t most_patterns; /* of a case */
    measure_sums *of;
    const char **variants;
} sums;

/* The sums of a measure; NULL: no memory. */
static measure_sums *sums_of(sums *s, const koksma__measured *measured)
{
    for (size_t m = 0; m < s->n; m++) {
        if (s->of[m].of == measured) {
            return &s->of[m];
        }
    }
    measure_sums *of = koksma__room_for_one(s->of, s->n, &s->room, 16, sizeof *of);
    if (!of) {
        return NULL;
    }
    s->of = of;
    of[s->n] = (measure_sums){.of = measured};
    return &of[s->n++];
}

static koksma_status index_of_variant(sums *s, const char *variant, size_t *index)
{
    for (*index = 0; *index < s->n_variants; ++*index) {
        if (!strcmp(s->variants[*index], variant)) {
            return KOKSMA_OK;
        }
    }
    const char **variants =
        koksma__room_for_one(s->variants, s->n_variants, &s->room_of_variants, 16, sizeof *variants);
    if (!variants) {
        return KOKSMA_MEMORY;
    }
    s->variants = variants;
    variants[s->n_variants++] = variant;
    return KOKSMA_OK;
}

static koksma_status add_case(sums *s, const koksma__case *p, const koksma__estimate *rho, size_t n_patterns)
{
    size_t v;
    measure_sums *of = sums_of(s, p->of);
    const koksma_status status = of ? index_of_variant(s, p->variant, &v) : KOKSMA_MEMORY;
    if (status) {
        return status;
    }
    of->total += rho->value;
    of->all++;
    of->sure += rho->low > 0 || rho->high < 0;
    of->few += n_patterns < KOKSMA__LEAST_PAIRS;
    if (v < MAX_VARIANTS) {
        of->rho[v] += rho->value;
        of->cases[v]++;
    }
    return KOKSMA_OK;
}

typedef struct listing {
    koksma__grid *grid;
    sums *sums;
} listing;

static koksma_status list_row(const koksma__cases *cases, void *context, const koksma__case *p)
{
    listing *l = context;
    koksma__pairs found;
    koksma__estimate rho, tau;
    koksma_status status = koksma__case_pairs(cases, p, &found);
    l->sums->most_patterns =
        found.patterns_in_all > l->sums->most_patterns ? found.patterns_in_all : l->sums->most_patterns;
    if (status || found.n < 4) {
        return status;
    }
    const uint64_t seed = koksma__job_seed("correlation|%s|%s|%lld|%s", p->scene, p->variant, p->spp, p->of->label);
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
    koksma__grid_text(l->grid, p->of->label);
    koksma__grid_number(l->grid, (double)found.n, 7);
    koksma__grid_interval(l->grid, rho, 3);
    koksma__grid_interval(l->grid, tau, 3);
    return add_case(l->sums, p, &rho, found.n);
}

static double mean_rho(const measure_sums *m)
{
    return m->all ? m->total / (double)m->all : (double)NAN;
}

/* The measures, best first: insertion sort, ties by place. */
static void order(sums *s)
{
    for (size_t m = 1; m < s->n; m++) {
        const measure_sums of = s->of[m];
        size_t at = m;
        for (; at > 0 && fabs(mean_rho(&s->of[at - 1])) < fabs(mean_rho(&of)); at--) {
            s->of[at] = s->of[at - 1];
        }
        s->of[at] = of;
    }
}

/* What the answer leaves out. */
static void add_limits(koksma__html *h, const sums *s)
{
    if (s->most_patterns > KOKSMA__CASE_PATTERNS) {
        koksma__html_add(h,
                         "<p>Of up to %zu patterns the first %d are correlated; the others are in the export.</p>\n",
                         s->most_patterns, KOKSMA__CASE_PATTERNS);
    }
    if (s->n_variants > MAX_VARIANTS) {
        koksma__html_add(h,
                         "<p>%zu more combinations of options have no column here; the means are over them, too, and "
                         "all are in the list of cases.</p>\n",
                         s->n_variants - MAX_VARIANTS);
    }
}

static void add_sentence(koksma__html *h, const sums *s)
{
    const measure_sums *best = &s->of[0], *worst = &s->of[s->n - 1];
    koksma__html_add(h, "<p><strong>Answer.</strong> <code>");
    koksma__html_text(h, best->of->label);
    koksma__html_add(h,
                     "</code> orders the patterns most as the error of the images does: mean rank correlation "
                     "(Spearman) %+.2f over %zu cases, in %zu of which its interval excludes 0",
                     mean_rho(best), best->all, best->sure);
    if (best->few) {
        koksma__html_add(h, " (%zu have fewer than %d patterns, too few for an interval)", best->few,
                         KOKSMA__LEAST_PAIRS);
    }
    koksma__html_add(h, "; last is <code>");
    koksma__html_text(h, worst->of->label);
    koksma__html_add(h, "</code> with %+.2f. A measure that is better when larger has negative numbers.</p>\n",
                     mean_rho(worst));
}

static void add_summary(koksma__html *h, const koksma__topic *topic, const sums *s)
{
    const size_t n_variants = s->n_variants < MAX_VARIANTS ? s->n_variants : MAX_VARIANTS;
    koksma__grid grid;
    char text[KOKSMA__VARIANT_TEXT + 64];
    add_sentence(h, s);
    add_limits(h, s);
    snprintf(text, sizeof text, "correlation-%.40s", topic->id);
    koksma__grid_open(&grid, h, text);
    koksma__grid_head(&grid, "measure");
    koksma__grid_head(&grid, "mean Spearman");
    koksma__grid_head(&grid, "cases");
    koksma__grid_head(&grid, "cases that exclude 0");
    for (size_t v = 0; v < n_variants; v++) {
        snprintf(text, sizeof text, "mean, %s", s->variants[v][0] ? s->variants[v] : "defaults");
        koksma__grid_head(&grid, text);
    }
    for (size_t i = 0; i < s->n; i++) {
        const measure_sums *m = &s->of[i];
        koksma__grid_row(&grid);
        koksma__grid_text(&grid, m->of->label);
        koksma__grid_number(&grid, mean_rho(m), 3);
        koksma__grid_number(&grid, (double)m->all, 7);
        koksma__grid_number(&grid, (double)m->sure, 7);
        for (size_t v = 0; v < n_variants; v++) {
            koksma__grid_number(&grid, m->cases[v] ? m->rho[v] / (double)m->cases[v] : (double)NAN, 3);
        }
    }
    koksma__grid_close(&grid);
}

typedef struct plots {
    koksma__html *html;
    const koksma__measured *of;
    size_t left;
} plots;

/* A scatter plot of the best measure in the middle number of samples of a block. */
static koksma_status add_scatter(const koksma__cases *cases, void *context, const koksma__case *p)
{
    plots *to = context;
    koksma__pairs found;
    if (!to->left || p->of != to->of || p->spp != p->image->spp.at[p->image->spp.n / 2]) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__case_pairs(cases, p, &found);
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
                     p->of->label, koksma__spearman(found.x, found.y, found.n));
    const koksma__chart chart = {title, p->of->label, "mean absolute error", true, true, n, series, found.n - n};
    koksma__html_chart(to->html, &chart);
    free(series);
    to->left--;
    return KOKSMA_OK;
}

koksma_status koksma__answer_correlation(koksma_study *study, koksma__html *h, const koksma__topic *topic)
{
    koksma__grid grid;
    koksma__html list = {0};
    sums s = {0};
    koksma__cases cases;
    char name[64];
    snprintf(name, sizeof name, "correlations-%.40s", topic->id);
    koksma__grid_open(&grid, &list, name);
    static const char *const heads[] = {"scene", "options", "samples", "measure", "patterns"};
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) {
        koksma__grid_head(&grid, heads[i]);
    }
    koksma__grid_head_interval(&grid, "Spearman");
    koksma__grid_head_interval(&grid, "Kendall");
    listing l = {&grid, &s};
    koksma_status status = koksma__cases_open(study, topic, &cases);
    status = status ? status : koksma__cases_visit(&cases, list_row, &l);
    koksma__grid_close(&grid);
    if (!status && s.n) {
        order(&s);
        add_summary(h, topic, &s);
        koksma__html_add(h, "<details><summary>Every case, with intervals</summary>\n%s</details>\n",
                         list.text ? list.text : "");
        koksma__html_add(h, "<div class=\"figures\">\n");
        plots to = {h, s.of[0].of, 6};
        status = koksma__cases_visit(&cases, add_scatter, &to);
        koksma__html_add(h, "</div>\n");
    }
    h->failed |= list.failed;
    koksma__cases_close(&cases);
    free(list.text);
    free(s.of);
    free(s.variants);
    return status;
}
