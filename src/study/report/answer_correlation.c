/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Does a measure order the patterns as the error of images does? For every scene, variant and number of samples the
 * rank correlation, over patterns, of the mean of a measure of n points with the mean error of images of n samples a
 * pixel; its interval is a bootstrap over the patterns that redraws the means. All cases and measures are resampled
 * together, so that the mean correlations of two measures can be compared. The mean over all cases comes first, then
 * the means by scene, by group of scenes and by number of samples, then combinations of measures.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "stats/bootstrap.h"
#include "stats/correlation.h"
#include "study/report/cases.h"
#include "study/report/combinations.h"
#include "study/report/rho_words.h"

typedef struct listing {
    koksma__grid *grid;
    koksma__rho_means *means;
    koksma__combinations *combinations;
    size_t most_patterns; /* of a case */
} listing;

/* A correlation of a measure that is better when larger, turned. */
static koksma__estimate turned(const koksma__estimate *of)
{
    return (koksma__estimate){-of->value, -of->high, -of->low};
}

/* rho, with its resamples, and tau. Kendall's is only shown: a quarter of the resamples will do. */
static koksma_status correlate(const koksma__case *p, const koksma__pairs *found, double draws[KOKSMA__RHO_SAMPLES],
                               koksma__estimate *rho, koksma__estimate *tau)
{
    const koksma__means x = {found->x, found->x_error, koksma__job_seed("means|%s|%lld", p->of->label, p->spp)};
    const koksma__means y = {found->y, found->y_error,
                             koksma__job_seed("means|%s|%s|%lld", p->scene, p->variant, p->spp)};
    const uint64_t seed = koksma__job_seed("correlation");
    memset(draws, 0, KOKSMA__RHO_SAMPLES * sizeof *draws);
    koksma_status status =
        koksma__bootstrap_pairs(&x, &y, found->n, koksma__spearman, KOKSMA__RHO_SAMPLES, seed, draws, rho);
    if (!status) {
        status = koksma__bootstrap_pairs(&x, &y, found->n, koksma__kendall, KOKSMA__RHO_SAMPLES / 4, seed, NULL, tau);
    }
    if (p->of->larger) {
        *rho = turned(rho);
        *tau = turned(tau);
        for (size_t i = 0; i < KOKSMA__RHO_SAMPLES; i++) {
            draws[i] = -draws[i];
        }
    }
    return status;
}

static koksma_status list_row(const koksma__cases *cases, void *context, const koksma__case *p)
{
    listing *l = context;
    koksma__pairs found;
    double draws[KOKSMA__RHO_SAMPLES];
    koksma__estimate rho, tau;
    koksma_status status = koksma__case_pairs(cases, p, &found);
    l->most_patterns = found.patterns_in_all > l->most_patterns ? found.patterns_in_all : l->most_patterns;
    if (status || found.n < 4) {
        return status;
    }
    status = koksma__combinations_add(l->combinations, p, &found);
    status = status ? status : correlate(p, &found, draws, &rho, &tau);
    if (status || isnan(rho.value)) {
        return status;
    }
    koksma__grid_row(l->grid);
    koksma__grid_text(l->grid, p->scene);
    koksma__grid_text(l->grid, p->variant[0] ? p->variant : "defaults");
    koksma__grid_number(l->grid, (double)p->spp, 7);
    koksma__grid_text(l->grid, p->of->label);
    koksma__grid_number(l->grid, (double)found.n, 7);
    rho = koksma__rho_shown(&rho, found.n);
    koksma__grid_interval(l->grid, rho, 3);
    koksma__grid_interval(l->grid, koksma__rho_shown(&tau, found.n), 3);
    const koksma__rho_source source = {p->of->label, p->scene, p->variant, p->spp, found.n};
    return koksma__rho_add(l->means, &source, &rho, draws);
}

/* What the answer leaves out. */
static void add_limits(koksma__html *h, const listing *l)
{
    const koksma__rho_means *s = l->means;
    if (l->most_patterns > KOKSMA__CASE_PATTERNS) {
        koksma__html_add(h,
                         "<p>Of up to %zu patterns the first %d are correlated; the others are in the export.</p>\n",
                         l->most_patterns, KOKSMA__CASE_PATTERNS);
    }
    if (s->n_variants > KOKSMA__RHO_VARIANTS) {
        koksma__html_add(h,
                         "<p>%zu more combinations of options have no column here; the means are over them, too, and "
                         "all are in the list of cases.</p>\n",
                         s->n_variants - KOKSMA__RHO_VARIANTS);
    }
}

typedef struct plots {
    koksma__html *html;
    const char *measure;
    size_t left;
} plots;

/* A scatter plot of the best measure in the middle number of samples of a block. */
static koksma_status add_scatter(const koksma__cases *cases, void *context, const koksma__case *p)
{
    plots *to = context;
    koksma__pairs found;
    if (!to->left || strcmp(p->of->label, to->measure) != 0 || p->spp != p->image->spp.at[p->image->spp.n / 2]) {
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

/* Sentence, tables and charts of the correlations, of which there are some; list: the table of every case. */
static koksma_status report(koksma__html *h, const koksma__cases *cases, const listing *l, const char *list)
{
    const koksma__topic *topic = cases->topic;
    koksma__rho_jackknife jackknife;
    koksma__rho_order(l->means);
    koksma_status status = koksma__rho_leave_out(l->means, &jackknife);
    if (status) {
        return status;
    }
    koksma__rho_sentence(h, l->means, &jackknife);
    add_limits(h, l);
    koksma__rho_table(h, topic->id, l->means, &jackknife);
    koksma__rho_jackknife_fini(&jackknife);
    status = koksma__rho_breakdowns(h, topic, l->means);
    status = status ? status : koksma__combinations_report(h, topic->id, l->combinations);
    koksma__html_add(h, "<details><summary>Every case, with intervals</summary>\n%s</details>\n", list);
    koksma__html_add(h, "<div class=\"figures\">\n");
    plots to = {h, l->means->of[0].measure, 6};
    status = status ? status : koksma__cases_visit(cases, add_scatter, &to);
    koksma__html_add(h, "</div>\n");
    return status;
}

koksma_status koksma__answer_correlation(koksma_study *study, koksma__html *h, const koksma__topic *topic)
{
    koksma__grid grid;
    koksma__html list = {0};
    koksma__rho_means s = {0};
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
    koksma_status status = koksma__cases_open(study, topic, &cases);
    koksma__combinations combinations = {.cases = &cases};
    listing l = {&grid, &s, &combinations, 0};
    status = status ? status : koksma__cases_visit(&cases, list_row, &l);
    koksma__grid_close(&grid);
    if (!status && s.n) {
        status = report(h, &cases, &l, list.text ? list.text : "");
    }
    h->failed |= list.failed;
    free(list.text);
    koksma__rho_fini(&s);
    koksma__combinations_fini(&combinations);
    koksma__cases_close(&cases);
    return status;
}
