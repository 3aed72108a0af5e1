/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Answers whether a measure orders the patterns as the error of images does. For every scene, variant and number of
 * samples it computes the rank correlation, over patterns, of the mean of a measure of n points with the mean error
 * of images of n samples per pixel. The interval of a correlation comes from a bootstrap over the patterns that also
 * redraws the means. All cases and measures are resampled together, so that the mean correlations of two measures
 * can be compared. The answer gives the means over all cases, then by group of scenes, by scene and by number of samples.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "study/plan/plan.h"
#include "study/report/rho.h"

/* What is collected over all cases. */
typedef struct listing {
    koksma__document list; /* the table of all cases */
    koksma__rho_means means;
    size_t most_patterns; /* largest number of patterns in a case */
} listing;

/* ---- Tables over parts of the cases ------------------------------------------------------------------------ */

/* A part of the cases, which is a row of a table. */
typedef struct part {
    char name[160];
    bool *scenes;  /* which scenes the part has; NULL: all */
    long long spp; /* 0: all numbers of samples */
} part;

/* Appends `between` and `more` to a text of limited size, or nothing if they do not fit. */
static void append(char *text, size_t size, const char *between, const char *more)
{
    const size_t used = strlen(text);
    if (used + strlen(between) + strlen(more) + 1 < size) {
        snprintf(text + used, size - used, "%s%s", used ? between : "", more);
    }
}

/* Adds a row: the mean of every measure, the best measure, and those that are significantly worse than the best, by Holm's
   method over the pairs of measures in that row. */
static void add_part(koksma__report *report, koksma__document *d, const koksma__rho_means *s, const part *of)
{
    const koksma__rho_ranking r = koksma__rho_rank(report, s, &(koksma__rho_subset){of->scenes, of->spp});
    if (!r.n) {
        return;
    }
    char worse[512] = "";
    for (size_t i = 1; i < r.n; i++) {
        if (koksma__rho_is_better(&r, r.at[0].measure, r.at[i].measure)) {
            append(worse, sizeof worse, ", ", s->of[r.at[i].measure].measure);
        }
    }
    koksma__doc_row(d, "tztt", of->name, r.at[0].cases, s->of[r.at[0].measure].measure, worse[0] ? worse : "none");
    for (size_t m = 0; m < s->n; m++) {
        koksma__estimate mean = {NAN, NAN, NAN};
        for (size_t i = 0; i < r.n; i++) {
            mean = r.at[i].measure == m ? r.at[i].mean : mean;
        }
        koksma__doc_cells(d, "i", mean);
    }
}

/* Adds a table with n parts as rows. `name` is the head of its first column. */
static void add_parts(koksma__report *r, koksma__document *d, const koksma__rho_means *s, const char *name,
                      const char *id, const char *title, const part *parts, size_t n)
{
    koksma__doc_section(d, NULL, "%s", title);
    koksma__doc_table(d, "correlation-%.10s-%.40s", name, id);
    koksma__doc_columns(d, "t %s;n7 cases;t best;t significantly worse than the best", name);
    for (size_t m = 0; m < s->n; m++) {
        koksma__doc_columns(d, "i2 %s", s->of[m].measure);
    }
    for (size_t i = 0; !r->status && i < n; i++) {
        add_part(r, d, s, &parts[i]);
    }
    koksma__doc_end(d);
}

/* Fills in the parts: one for each scene, each group of scenes and each number of samples. masks: storage for the
   scenes of the parts. */
static void set_parts(const koksma__topic *topic, const koksma__rho_means *s, part *parts, bool *masks)
{
    part *at = parts;
    for (size_t i = 0; i < s->n_scenes; i++, at++, masks += s->n_scenes) {
        snprintf(at->name, sizeof at->name, "%.150s", s->scenes[i]);
        at->scenes = masks;
        masks[i] = true;
    }
    for (size_t g = 0; g < topic->n_groups; g++, at++, masks += s->n_scenes) {
        char names[256] = "";
        at->scenes = masks;
        for (size_t i = 0; i < s->n_scenes; i++) {
            masks[i] = koksma__texts_have(&topic->groups[g].scenes, s->scenes[i]);
            if (masks[i]) {
                append(names, sizeof names, ", ", s->scenes[i]);
            }
        }
        snprintf(at->name, sizeof at->name, "%.70s (%.80s)", topic->groups[g].title, names);
    }
    for (size_t k = 0; k < s->n_sizes; k++, at++) {
        snprintf(at->name, sizeof at->name, "%lld", s->sizes[k]);
        at->spp = s->sizes[k];
    }
}

/* Writes a table of the means by group of scenes if the plan has groups, one by scene if there are two or more scenes, and
   one by number of samples if there are two or more. */
static void add_breakdowns(koksma__report *r, koksma__document *d, const koksma__topic *topic,
                           const koksma__rho_means *s)
{
    const size_t n = s->n_scenes + topic->n_groups + s->n_sizes;
    part *parts = koksma__report_memory(r, n, sizeof *parts);
    bool *masks = koksma__report_memory(r, (s->n_scenes + topic->n_groups + 1) * (s->n_scenes + 1), sizeof *masks);
    if (r->status) {
        return;
    }
    set_parts(topic, s, parts, masks);
    if (topic->n_groups) {
        add_parts(r, d, s, "group", topic->id, "By what dominates the scenes' error", parts + s->n_scenes,
                  topic->n_groups);
    }
    if (s->n_scenes > 1) {
        add_parts(r, d, s, "scene", topic->id, "By scene", parts, s->n_scenes);
    }
    if (s->n_sizes > 1) {
        add_parts(r, d, s, "samples", topic->id, "By number of samples", parts + s->n_scenes + topic->n_groups,
                  s->n_sizes);
    }
}

/* ---- Correlations ------------------------------------------------------------------------------------------ */

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

/* Adds the row of a case to the table of all cases, and its correlation to the means. */
static void list_case(const koksma__cases *cases, void *context, const koksma__case *p)
{
    listing *l = context;
    koksma__document *d = &l->list;
    koksma__report *r = cases->report;
    koksma__pairs found;
    double draws[KOKSMA__RHO_SAMPLES];
    koksma__estimate rho, tau;
    koksma__case_pairs(cases, p, &found);
    l->most_patterns = found.patterns_in_all > l->most_patterns ? found.patterns_in_all : l->most_patterns;
    if (r->status || found.n < 4) {
        return;
    }
    if (!koksma__report_keep(r, correlate(r->run, p, &found, draws, &rho, &tau)) || isnan(rho.value)) {
        return;
    }
    rho = koksma__rho_shown(&rho, found.n);
    koksma__doc_row(d, "ttdtzii", p->scene, p->variant[0] ? p->variant : "defaults", p->spp, p->of->label, found.n,
                    rho, koksma__rho_shown(&tau, found.n));
    const koksma__rho_source source = {p->of->label, p->scene, p->variant, p->spp, found.n};
    koksma__rho_add(r, &l->means, &source, &rho, draws);
}

/* Writes the table of all measures, with their means over all cases. */
static void add_measures(koksma__document *d, const char *id, const koksma__rho_means *s,
                         const koksma__rho_jackknife *j)
{
    const size_t n_variants = s->n_variants < KOKSMA__RHO_VARIANTS ? s->n_variants : KOKSMA__RHO_VARIANTS;
    const koksma__rho_ranking *r = &j->of[0];
    const koksma__estimate none = {NAN, NAN, NAN};
    koksma__doc_table(d, "correlation-%.40s", id);
    koksma__doc_columns(d, "t measure;i3 mean Spearman;n2 p of 0 (Holm);n3 lowest without a scene;n3 highest without "
                           "a scene;i2 less the first;n2 p of that (Holm);n7 cases;n7 cases that exclude 0");
    for (size_t v = 0; v < n_variants; v++) {
        koksma__doc_columns(d, "n3 mean, %s", s->variants[v][0] ? s->variants[v] : "defaults");
    }
    for (size_t i = 0; i < r->n; i++) {
        const koksma__rho_sums *m = &s->of[r->at[i].measure];
        const koksma__estimate range = j->n > 1 ? koksma__rho_range(j, r->at[i].measure) : none;
        koksma__doc_row(d, "tinnninzz", m->measure, r->at[i].mean, r->at[i].p, range.low, range.high,
                        i ? r->at[i].less : none, i ? r->p[i] : (double)NAN, m->all, m->sure);
        for (size_t v = 0; v < n_variants; v++) {
            koksma__doc_cells(d, "n", m->cases[v] ? m->rho[v] / (double)m->cases[v] : (double)NAN);
        }
    }
}

/* Writes what the answer leaves out. */
static void say_limits(koksma__document *d, const listing *l)
{
    const koksma__rho_means *s = &l->means;
    if (l->most_patterns > KOKSMA__CASE_PATTERNS) {
        koksma__doc_paragraph(d,
                              "A case has up to %zu patterns; correlations use only the first %d of them. `koksma "
                              "study export` has the results of all.",
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
static void add_scatter(const koksma__cases *cases, void *context, const koksma__case *p)
{
    plots *to = context;
    koksma__document *d = to->document;
    koksma__pairs found;
    if (!to->left || strcmp(p->of->label, to->measure) != 0 || p->spp != p->image->spp.at[p->image->spp.n / 2]) {
        return;
    }
    koksma__case_pairs(cases, p, &found);
    char title[256], name[KOKSMA__VARIANT_TEXT + 64];
    koksma__case_name(p->scene, p->variant, name, sizeof name);
    koksma__snprintf(title, sizeof title, "%.120s, %lld sample%s: error against %.60s, Spearman %.2f", name, p->spp,
                     koksma__plural((double)p->spp), p->of->label, koksma__spearman(found.x, found.y, found.n));
    koksma__doc_chart(d, &(koksma__chart){title, p->of->label, cases->topic->metric, true, true, 0, NULL});
    for (size_t i = 0; i < found.n; i++) {
        koksma__doc_series(d, found.patterns[i], NULL, KOKSMA__SERIES_MARKS);
        koksma__doc_point(d, found.x[i], found.y[i], found.low[i], found.high[i]);
    }
    to->left--;
}

/* Writes the sentence, tables and charts of the correlations, of which there must be at least one. Empties
   l->list. */
static void add_answer(koksma__document *d, const koksma__cases *cases, listing *l)
{
    koksma__report *r = cases->report;
    koksma__rho_order(r, &l->means);
    const koksma__rho_jackknife jackknife = koksma__rho_leave_out(r, &l->means);
    if (r->status) {
        return;
    }
    koksma__rho_say(d, &l->means, &jackknife);
    say_limits(d, l);
    add_measures(d, cases->topic->id, &l->means, &jackknife);
    add_breakdowns(r, d, cases->topic, &l->means);
    koksma__doc_collapsed_section(d, NULL, "Every case, with intervals");
    koksma__doc_append(d, &l->list);
    koksma__doc_end(d);
    koksma__cases_visit(cases, add_scatter, &(plots){d, l->means.of[0].measure, 6});
}

void koksma__answer_correlation(koksma__report *r, koksma__document *d, const koksma__topic *topic)
{
    const koksma__cases cases = koksma__cases_of(r, topic);
    listing l = {.most_patterns = 0};
    koksma__doc_table(&l.list, "correlations-%.40s", topic->id);
    koksma__doc_columns(&l.list, "t scene;t options;n7 samples;t measure;n7 patterns;i3 Spearman##%s;i3 Kendall##%s",
                        topic->metric, topic->metric);
    koksma__cases_visit(&cases, list_case, &l);
    if (!r->status && l.means.n) {
        add_answer(d, &cases, &l);
    }
    koksma__report_keep(r, l.list.json.status);
    koksma__json_writer_fini(&l.list.json);
}
