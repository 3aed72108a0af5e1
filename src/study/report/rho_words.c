/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The answer over all cases. Every statement is checked on the rankings over all scenes and without each one
 * (koksma__rho_always_...): one that fails without some scene is not made, and the sentence says so.
 */
#include "study/report/rho_words.h"
#include "stats/bootstrap.h"

#include <math.h>
#include <stdio.h>

static void add_name(koksma__html *h, const koksma__rho_means *s, size_t measure)
{
    koksma__html_add(h, "<code>");
    koksma__html_text(h, s->of[measure].measure);
    koksma__html_add(h, "</code>");
}

/* "a", "a and b", "a, b and c": what stands before item i of n. */
static const char *between(size_t i, size_t n)
{
    return i == 0 ? "" : i + 1 < n ? ", " : " and ";
}

/* The cases without an interval. */
static void add_without(koksma__html *h, const koksma__rho_sums *of)
{
    if (of->few) {
        koksma__html_add(h, " (%zu have fewer than %d patterns, too few for an interval", of->few,
                         KOKSMA__LEAST_PAIRS);
    }
    if (of->perfect) {
        koksma__html_add(h, "%s%zu are in perfect order, which has none", of->few ? "; " : " (", of->perfect);
    }
    koksma__html_add(h, of->few || of->perfect ? ")" : "");
}

static void add_cases(koksma__html *h, const koksma__rho_sums *of)
{
    koksma__html_add(h,
                     "mean rank correlation (Spearman) %+.2f over %zu cases, in %zu of which its interval excludes 0",
                     of->total / (double)of->all, of->all, of->sure);
    add_without(h, of);
}

/* Which measure comes first without each scene, where that is another one than over all. */
static void add_other_firsts(koksma__html *h, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    for (size_t i = 1; i < j->n; i++) {
        if (j->of[i].n && j->of[i].at[0].measure != j->of[0].at[0].measure) {
            koksma__html_add(h, "; without ");
            koksma__html_text(h, s->scenes[i - 1]);
            koksma__html_add(h, " it is ");
            add_name(h, s, j->of[i].at[0].measure);
        }
    }
}

/* Who comes first, and whether that depends on one scene. */
static void add_first(koksma__html *h, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    const size_t first = j->of[0].at[0].measure;
    if (j->n == 1) {
        add_name(h, s, first);
        koksma__html_add(h, " orders the patterns most as the error of the images does: ");
        add_cases(h, &s->of[first]);
        koksma__html_add(h, ". These cases are of one scene, and say nothing of others.");
    } else if (koksma__rho_always_first(j, first)) {
        const koksma__estimate range = koksma__rho_range(j, first);
        add_name(h, s, first);
        koksma__html_add(h, " orders the patterns most as the error of the images does: ");
        add_cases(h, &s->of[first]);
        koksma__html_add(h, ". It comes first without any one of the %zu scenes, too (%+.2f to %+.2f).", s->n_scenes,
                         range.low, range.high);
    } else {
        koksma__html_add(h, "Which measure orders the patterns most as the error of the images does depends on the "
                            "scenes. Over all of them it is ");
        add_name(h, s, first);
        koksma__html_add(h, ": ");
        add_cases(h, &s->of[first]);
        add_other_firsts(h, s, j);
        koksma__html_add(h, ".");
    }
}

/* The measures whose mean is surely above 0. */
static void add_predictors(koksma__html *h, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    size_t always = 0, sure = 0, named = 0;
    for (size_t m = 0; m < s->n; m++) {
        always += koksma__rho_always_predicts(j, m);
        sure += koksma__rho_predicts(&j->of[0], m);
    }
    koksma__html_add(h, always ? " Surely above 0%s: " : " No measure's mean is surely above 0%s.",
                     j->n > 1 ? ", whichever one scene is left out" : "");
    for (size_t m = 0; m < s->n; m++) {
        if (koksma__rho_always_predicts(j, m)) {
            koksma__html_add(h, "%s", between(named++, always));
            add_name(h, s, m);
            koksma__html_add(h, " %+.2f", s->of[m].total / (double)s->of[m].all);
        }
    }
    koksma__html_add(h, always ? "." : "");
    if (sure > always) {
        koksma__html_add(h, " For %zu more that depends on one scene.", sure - always);
    }
}

/* Which measures are surely better than which. */
static void add_pairs(koksma__html *h, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    size_t always = 0, sure = 0;
    for (size_t i = 0; i < s->n * s->n; i++) {
        always += koksma__rho_always_better(j, i / s->n, i % s->n);
        sure += koksma__rho_is_better(&j->of[0], i / s->n, i % s->n);
    }
    koksma__html_add(h, always ? " Surely better%s: " : " No measure is surely better than another%s.",
                     j->n > 1 ? ", whichever one scene is left out" : "");
    const char *next = "";
    for (size_t a = 0; a < s->n; a++) {
        size_t n = 0, named = 0;
        for (size_t b = 0; b < s->n; b++) {
            n += koksma__rho_always_better(j, a, b);
        }
        if (n) {
            koksma__html_add(h, "%s", next);
            add_name(h, s, a);
            koksma__html_add(h, " than ");
            next = "; ";
        }
        for (size_t b = 0; b < s->n; b++) {
            if (koksma__rho_always_better(j, a, b)) {
                koksma__html_add(h, "%s", between(named++, n));
                add_name(h, s, b);
            }
        }
    }
    koksma__html_add(h, always ? "." : "");
    if (sure > always) {
        koksma__html_add(h, " %zu more differences that are sure over all scenes are not without one of them.",
                         sure - always);
    }
}

void koksma__rho_sentence(koksma__html *h, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    const size_t last = j->of[0].at[j->of[0].n - 1].measure;
    koksma__html_add(h, "<p><strong>Answer.</strong> ");
    add_first(h, s, j);
    add_predictors(h, s, j);
    add_pairs(h, s, j);
    if (s->n > 1 && koksma__rho_always_last(j, last)) {
        koksma__html_add(h, " The last is ");
        add_name(h, s, last);
        koksma__html_add(h, " with %+.2f.", s->of[last].total / (double)s->of[last].all);
    }
    koksma__html_add(
        h,
        "</p>\n<p>Intervals are of 95 %% by %d bootstrap resamples of the patterns and their means. "
        "<em>Surely</em> is at 5 %% for all tests of a kind together, by Holm: %zu pairs of measures "
        "here, and %zu measures against 0. The correlations of a measure that is better when larger have "
        "the other sign, so that +1 is always the order of the errors.</p>\n",
        KOKSMA__RHO_SAMPLES, j->of[0].n_pairs, s->n);
    if (0.05 * (KOKSMA__RHO_SAMPLES + 1) < 2 * (double)j->of[0].n_pairs) {
        koksma__html_add(h, "<p>These are more pairs than %d resamples can tell apart: no difference is sure.</p>\n",
                         KOKSMA__RHO_SAMPLES);
    }
}

void koksma__rho_table(koksma__html *h, const char *id, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    const size_t n_variants = s->n_variants < KOKSMA__RHO_VARIANTS ? s->n_variants : KOKSMA__RHO_VARIANTS;
    const koksma__rho_ranking *r = &j->of[0];
    koksma__grid grid;
    char text[KOKSMA__VARIANT_TEXT + 64];
    snprintf(text, sizeof text, "correlation-%.40s", id);
    koksma__grid_open(&grid, h, text);
    koksma__grid_head(&grid, "measure");
    koksma__grid_head_interval(&grid, "mean Spearman");
    koksma__grid_head(&grid, "p of 0 (Holm)");
    koksma__grid_head(&grid, "lowest without a scene");
    koksma__grid_head(&grid, "highest without a scene");
    koksma__grid_head_interval(&grid, "less the first");
    koksma__grid_head(&grid, "p of that (Holm)");
    koksma__grid_head(&grid, "cases");
    koksma__grid_head(&grid, "cases that exclude 0");
    for (size_t v = 0; v < n_variants; v++) {
        snprintf(text, sizeof text, "mean, %s", s->variants[v][0] ? s->variants[v] : "defaults");
        koksma__grid_head(&grid, text);
    }
    for (size_t i = 0; i < r->n; i++) {
        const koksma__rho_sums *m = &s->of[r->at[i].measure];
        const koksma__estimate none = {NAN, NAN, NAN};
        const koksma__estimate range = j->n > 1 ? koksma__rho_range(j, r->at[i].measure) : none;
        koksma__grid_row(&grid);
        koksma__grid_text(&grid, m->measure);
        koksma__grid_interval(&grid, r->at[i].mean, 3);
        koksma__grid_number(&grid, r->at[i].p, 2);
        koksma__grid_number(&grid, range.low, 3);
        koksma__grid_number(&grid, range.high, 3);
        koksma__grid_interval(&grid, i ? r->at[i].less : none, 2);
        koksma__grid_number(&grid, i ? r->p[i] : (double)NAN, 2);
        koksma__grid_number(&grid, (double)m->all, 7);
        koksma__grid_number(&grid, (double)m->sure, 7);
        for (size_t v = 0; v < n_variants; v++) {
            koksma__grid_number(&grid, m->cases[v] ? m->rho[v] / (double)m->cases[v] : (double)NAN, 3);
        }
    }
    koksma__grid_close(&grid);
}
