/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Answers whether a measure orders the patterns as the error of images does. For every scene, variant and number of
 * samples it computes the rank correlation, over patterns, of the mean of a measure of n points with the mean error
 * of images of n samples per pixel. The interval of a correlation comes from a bootstrap over the patterns that also
 * redraws the means. All cases and measures are resampled together, so that the mean correlations of two measures
 * can be compared. The answer gives the means over all cases, then by group of scenes, by scene and by number of
 * samples, and then combinations of measures.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "stats/stats.h"
#include "study/report/cases.h"
#include "study/report/combinations.h"
#include "study/report/means.h"
#include "study/report/rho_breakdowns.h"
#include "study/report/rho_words.h"

typedef struct listing {
    koksma__document *list; /* the table of all cases */
    koksma__rho_means *means;
    koksma__combinations *combinations;
    size_t most_patterns; /* largest number of patterns in a case */
} listing;

/* Reverses the sign of a correlation and its interval, for a measure that is better when larger. */
static koksma__estimate turned(const koksma__estimate *of)
{
    return (koksma__estimate){-of->value, -of->high, -of->low};
}

/* Computes Spearman's rho with its resamples, and Kendall's tau. For tau a quarter of the resamples suffices,
   because its interval is only shown and enters no significance test. */
static koksma_status correlate(const koksma_run *run, const koksma__case *p, const koksma__pairs *found,
                               double draws[KOKSMA__RHO_SAMPLES], koksma__estimate *rho, koksma__estimate *tau)
{
    const koksma__means x = {found->x, found->x_error, koksma__job_seed("means|%s|%lld", p->of->label, p->spp)};
    const koksma__means y = {found->y, found->y_error,
                             koksma__job_seed("means|%s|%s|%lld", p->scene, p->variant, p->spp)};
    const uint64_t seed = koksma__job_seed("correlation");
    memset(draws, 0, KOKSMA__RHO_SAMPLES * sizeof *draws);
    koksma_status status =
        koksma__bootstrap_pairs(&x, &y, found->n, koksma__spearman, KOKSMA__RHO_SAMPLES, seed, run, draws, rho);
    if (!status) {
        status =
            koksma__bootstrap_pairs(&x, &y, found->n, koksma__kendall, KOKSMA__RHO_SAMPLES / 4, seed, run, NULL, tau);
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
    koksma__document *d = l->list;
    koksma__pairs found;
    double draws[KOKSMA__RHO_SAMPLES];
    koksma__estimate rho, tau;
    koksma_status status = koksma__case_pairs(cases, p, &found);
    l->most_patterns = found.patterns_in_all > l->most_patterns ? found.patterns_in_all : l->most_patterns;
    if (status || found.n < 4) {
        return status;
    }
    status = koksma__combinations_add(l->combinations, p, &found);
    status = status ? status : correlate(cases->study->report, p, &found, draws, &rho, &tau);
    if (status || isnan(rho.value)) {
        return status;
    }
    koksma__doc_row(d);
    koksma__doc_text(d, p->scene);
    koksma__doc_text(d, p->variant[0] ? p->variant : "defaults");
    koksma__doc_number(d, (double)p->spp);
    koksma__doc_text(d, p->of->label);
    koksma__doc_number(d, (double)found.n);
    rho = koksma__rho_shown(&rho, found.n);
    koksma__doc_interval(d, rho);
    koksma__doc_interval(d, koksma__rho_shown(&tau, found.n));
    const koksma__rho_source source = {p->of->label, p->scene, p->variant, p->spp, found.n};
    return koksma__rho_add(l->means, &source, &rho, draws);
}

/* Writes what the answer leaves out. */
static void say_limits(koksma__document *d, const listing *l)
{
    const koksma__rho_means *s = l->means;
    if (l->most_patterns > KOKSMA__CASE_PATTERNS) {
        koksma__doc_paragraph(d,
                              "A case has up to %zu patterns; correlations use only the first %d of them. "
                              "`koksma study export` has the results of all.",
                              l->most_patterns, KOKSMA__CASE_PATTERNS);
    }
    if (s->n_variants > KOKSMA__RHO_VARIANTS) {
        koksma__doc_paragraph(d,
                              "%zu more combinations of options have no column here; the means include them, and the "
                              "list of cases has them all.",
                              s->n_variants - KOKSMA__RHO_VARIANTS);
    }
}

typedef struct plots {
    koksma__document *document;
    const char *measure;
    size_t left;
} plots;

/* Adds a scatter plot of a case if its measure is the best one and its number of samples is the block's middle
   one. */
static koksma_status add_scatter(const koksma__cases *cases, void *context, const koksma__case *p)
{
    plots *to = context;
    koksma__document *d = to->document;
    koksma__pairs found;
    if (!to->left || strcmp(p->of->label, to->measure) != 0 || p->spp != p->image->spp.at[p->image->spp.n / 2]) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__case_pairs(cases, p, &found));
    char title[256], name[KOKSMA__VARIANT_TEXT + 64];
    koksma__case_name(p->scene, p->variant, name, sizeof name);
    koksma__snprintf(title, sizeof title, "%.120s, %lld sample%s: error against %.60s, Spearman %.2f", name, p->spp,
                     koksma__plural((double)p->spp), p->of->label, koksma__spearman(found.x, found.y, found.n));
    koksma__doc_chart_begin(d, &(koksma__chart){title, p->of->label, cases->topic->metric, true, true, 0});
    for (size_t i = 0; i < found.n; i++) {
        koksma__doc_series_begin(d, found.patterns[i], KOKSMA__SERIES_MARKS);
        koksma__doc_point(d, found.x[i], found.y[i], found.low[i], found.high[i]);
        koksma__doc_end(d);
    }
    koksma__doc_end(d);
    to->left--;
    return KOKSMA_OK;
}

/* Writes the sentence, tables and charts of the correlations, of which there must be at least one. Empties
   l->list. */
static koksma_status report(koksma__document *d, const koksma__cases *cases, const listing *l)
{
    const koksma__topic *topic = cases->topic;
    koksma__rho_jackknife jackknife;
    koksma__rho_order(l->means);
    koksma_status status = koksma__rho_leave_out(l->means, &jackknife);
    if (status) {
        return status;
    }
    koksma__rho_sentence(d, l->means, &jackknife);
    say_limits(d, l);
    koksma__rho_table(d, topic->id, l->means, &jackknife);
    koksma__rho_jackknife_fini(&jackknife);
    status = koksma__rho_breakdowns(d, topic, l->means);
    status = status ? status : koksma__combinations_report(d, topic->id, l->combinations);
    koksma__doc_section_begin(d, NULL, true);
    koksma__doc_say(d, "Every case, with intervals");
    koksma__doc_section_body(d);
    koksma__doc_append(d, l->list);
    koksma__doc_end(d);
    plots to = {d, l->means->of[0].measure, 6};
    return status ? status : koksma__cases_visit(cases, add_scatter, &to);
}

koksma_status koksma__answer_correlation(koksma_study *study, koksma__document *d, const koksma__topic *topic)
{
    koksma__document list = {0};
    koksma__rho_means s = {.run = study->report};
    koksma__cases cases;
    char name[64];
    snprintf(name, sizeof name, "correlations-%.40s", topic->id);
    koksma__doc_table_begin(&list, name);
    koksma__doc_head(&list, "scene");
    koksma__doc_head(&list, "options");
    koksma__doc_head_number(&list, "samples", 7);
    koksma__doc_head(&list, "measure");
    koksma__doc_head_number(&list, "patterns", 7);
    for (size_t i = 0; i < 2; i++) {
        koksma__doc_column(&list, &(koksma__column){.name = i ? "Kendall" : "Spearman",
                                                    .group = topic->metric,
                                                    .type = KOKSMA__COLUMN_INTERVAL,
                                                    .digits = 3});
    }
    koksma_status status = koksma__cases_open(study, topic, &cases);
    koksma__combinations combinations = {.cases = &cases};
    listing l = {&list, &s, &combinations, 0};
    status = status ? status : koksma__cases_visit(&cases, list_row, &l);
    koksma__doc_table_end(&list);
    if (!status && s.n) {
        status = report(d, &cases, &l);
    }
    status = status ? status : list.json.status;
    koksma__json_writer_fini(&list.json);
    koksma__rho_fini(&s);
    koksma__combinations_fini(&combinations);
    koksma__cases_close(&cases);
    return status;
}
