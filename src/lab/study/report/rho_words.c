/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Writes which measures predict the image error over all cases. Every statement is checked on the ranking over all
 * scenes and on the rankings without one scene (koksma__rho_always_...). A statement that fails when some scene is
 * left out is not made; the text then says that the result depends on that scene.
 */
#include "study/report/rho_words.h"
#include "stats/stats.h"

#include <math.h>
#include <stdio.h>

#include "study/plan/variants.h"

static double mean_of(const koksma__rho_sums *of)
{
    return of->total / (double)of->all;
}

/* The text before item i of n in an enumeration such as "a, b and c". */
static const char *between(size_t i, size_t n)
{
    return i == 0 ? "" : i + 1 < n ? ", " : " and ";
}

static const char *whichever(const koksma__rho_jackknife *j)
{
    return j->n > 1 ? ", whichever one scene is left out" : "";
}

/* Writes the mean correlation and the number of its cases with and without an interval. */
static void say_cases(koksma__document *d, const koksma__rho_sums *of)
{
    if (of->all == 1) {
        koksma__doc_say(d, "Spearman %+.2f, one case; %s", mean_of(of),
                        of->few       ? "too few patterns for an interval"
                        : of->perfect ? "in perfect order, which has no interval"
                        : of->sure    ? "its interval excludes 0"
                                      : "its interval includes 0");
        return;
    }
    koksma__doc_say(d, "mean Spearman %+.2f over %zu cases; the interval excludes 0 in %zu of them", mean_of(of),
                    of->all, of->sure);
    if (of->few) {
        koksma__doc_say(d, "; %zu have fewer than %d patterns, too few for an interval", of->few,
                        KOKSMA__LEAST_PAIRS);
    }
    if (of->perfect) {
        koksma__doc_say(d, "; %zu are in perfect order, which has no interval", of->perfect);
    }
}

/* For each scene whose omission changes the first measure, names the measure that is then the first. */
static void say_other_firsts(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    for (size_t i = 1; i < j->n; i++) {
        if (j->of[i].n && j->of[i].at[0].measure != j->of[0].at[0].measure) {
            koksma__doc_say(d, "; without %s it is `%s`", s->scenes[i - 1], s->of[j->of[i].at[0].measure].measure);
        }
    }
}

/* Writes which measure comes first, and whether that depends on a single scene. */
static void say_first(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    const size_t first = j->of[0].at[0].measure;
    const bool always = j->n > 1 && koksma__rho_always_first(j, first);
    if (j->n == 1 || always) {
        koksma__doc_say(d, "*Best predictor:* `%s` (", s->of[first].measure);
    } else {
        koksma__doc_say(d, "*The best predictor depends on the scenes.* Over all of them it is `%s` (",
                        s->of[first].measure);
    }
    say_cases(d, &s->of[first]);
    koksma__doc_say(d, ")");
    if (always) {
        const koksma__estimate range = koksma__rho_range(j, first);
        koksma__doc_say(d, ". It comes first whichever one of the %zu scenes is left out (%+.2f to %+.2f).",
                        s->n_scenes, range.low, range.high);
    } else if (j->n == 1) {
        koksma__doc_say(d, ". All cases are of one scene; other scenes may differ.");
    } else {
        say_other_firsts(d, s, j);
        koksma__doc_say(d, ".");
    }
}

/* Writes the measures whose mean is significantly above 0. */
static void say_predictors(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    size_t always = 0, sure = 0, named = 0;
    for (size_t m = 0; m < s->n; m++) {
        always += koksma__rho_always_predicts(j, m);
        sure += koksma__rho_predicts(&j->of[0], m);
    }
    koksma__doc_say(d, always ? " Surely above 0%s: " : " No measure's mean is surely above 0%s.", whichever(j));
    for (size_t m = 0; m < s->n; m++) {
        if (koksma__rho_always_predicts(j, m)) {
            koksma__doc_say(d, "%s`%s` %+.2f", between(named++, always), s->of[m].measure, mean_of(&s->of[m]));
        }
    }
    koksma__doc_say(d, "%s", always ? "." : "");
    if (sure > always) {
        koksma__doc_say(d, " %zu more are surely above 0 over all scenes, but not if some scene is left out.",
                        sure - always);
    }
}

/* Writes the names of the measures that are significantly worse than measure number `a`. */
static void say_worse(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j, size_t a,
                      const char **before)
{
    size_t n = 0, named = 0;
    for (size_t b = 0; b < s->n; b++) {
        n += koksma__rho_always_better(j, a, b);
    }
    if (n) {
        koksma__doc_say(d, "%s`%s` than ", *before, s->of[a].measure);
        *before = "; ";
    }
    for (size_t b = 0; b < s->n; b++) {
        if (koksma__rho_always_better(j, a, b)) {
            koksma__doc_say(d, "%s`%s`", between(named++, n), s->of[b].measure);
        }
    }
}

/* Writes all pairs of measures of which one is significantly better. */
static void say_pairs(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    size_t always = 0, sure = 0;
    const char *before = "";
    for (size_t i = 0; i < s->n * s->n; i++) {
        always += koksma__rho_always_better(j, i / s->n, i % s->n);
        sure += koksma__rho_is_better(&j->of[0], i / s->n, i % s->n);
    }
    koksma__doc_say(d, always ? " Surely better%s: " : " No measure is surely better than another%s.", whichever(j));
    for (size_t a = 0; a < s->n; a++) {
        say_worse(d, s, j, a, &before);
    }
    koksma__doc_say(d, "%s", always ? "." : "");
    if (sure > always) {
        koksma__doc_say(d, " %zu more differences are sure over all scenes, but not if some scene is left out.",
                        sure - always);
    }
}

void koksma__rho_sentence(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    const size_t last = j->of[0].at[j->of[0].n - 1].measure;
    const size_t first = j->of[0].at[0].measure;
    const bool too_few = s->of[first].few == s->of[first].all;
    koksma__doc_answer_begin(d, !too_few && (j->n == 1 || koksma__rho_always_first(j, first)));
    if (too_few) {
        koksma__doc_say(d,
                        "*Undecided:* a rank correlation needs %d patterns or more for an interval. The largest "
                        "correlation, over fewer patterns, is that of `%s` (",
                        KOKSMA__LEAST_PAIRS, s->of[first].measure);
        say_cases(d, &s->of[first]);
        koksma__doc_say(d, ").");
    } else {
        say_first(d, s, j);
        say_predictors(d, s, j);
        say_pairs(d, s, j);
        if (s->n > 1 && koksma__rho_always_last(j, last)) {
            koksma__doc_say(d, " The last is `%s` with %+.2f.", s->of[last].measure, mean_of(&s->of[last]));
        }
    }
    koksma__doc_paragraph_end(d);
    koksma__doc_paragraph(
        d,
        "A case is the rank correlation, over patterns, of a measure of n points with the error of "
        "images of n samples a pixel. Intervals are 95 %% intervals from %d bootstrap resamples of the "
        "patterns and their means. _Surely_ means significant at 5 %% for all tests of a kind together "
        "(Holm's method): the tests of %zu pairs of measures here, and those of %zu measures against 0. The "
        "sign of the correlations is reversed for a measure that is better when larger, so that +1 always "
        "means that the measure orders the patterns as their errors do.",
        KOKSMA__RHO_SAMPLES, j->of[0].n_pairs, s->n);
    if (0.05 * (KOKSMA__RHO_SAMPLES + 1) < 2 * (double)j->of[0].n_pairs) {
        koksma__doc_paragraph(d, "%d resamples are too few for so many pairs: no difference can be called sure.",
                              KOKSMA__RHO_SAMPLES);
    }
}

static void add_heads(koksma__document *d, const koksma__rho_means *s, size_t n_variants)
{
    char text[KOKSMA__VARIANT_TEXT + 64];
    koksma__doc_head(d, "measure");
    koksma__doc_head_interval(d, "mean Spearman", 3);
    koksma__doc_head_number(d, "p of 0 (Holm)", 2);
    koksma__doc_head_number(d, "lowest without a scene", 3);
    koksma__doc_head_number(d, "highest without a scene", 3);
    koksma__doc_head_interval(d, "less the first", 2);
    koksma__doc_head_number(d, "p of that (Holm)", 2);
    koksma__doc_head_number(d, "cases", 7);
    koksma__doc_head_number(d, "cases that exclude 0", 7);
    for (size_t v = 0; v < n_variants; v++) {
        snprintf(text, sizeof text, "mean, %s", s->variants[v][0] ? s->variants[v] : "defaults");
        koksma__doc_head_number(d, text, 3);
    }
}

void koksma__rho_table(koksma__document *d, const char *id, const koksma__rho_means *s,
                       const koksma__rho_jackknife *j)
{
    const size_t n_variants = s->n_variants < KOKSMA__RHO_VARIANTS ? s->n_variants : KOKSMA__RHO_VARIANTS;
    const koksma__rho_ranking *r = &j->of[0];
    char name[64];
    snprintf(name, sizeof name, "correlation-%.40s", id);
    koksma__doc_table_begin(d, name);
    add_heads(d, s, n_variants);
    for (size_t i = 0; i < r->n; i++) {
        const koksma__rho_sums *m = &s->of[r->at[i].measure];
        const koksma__estimate none = {NAN, NAN, NAN};
        const koksma__estimate range = j->n > 1 ? koksma__rho_range(j, r->at[i].measure) : none;
        koksma__doc_row(d);
        koksma__doc_text(d, m->measure);
        koksma__doc_interval(d, r->at[i].mean);
        koksma__doc_number(d, r->at[i].p);
        koksma__doc_number(d, range.low);
        koksma__doc_number(d, range.high);
        koksma__doc_interval(d, i ? r->at[i].less : none);
        koksma__doc_number(d, i ? r->p[i] : (double)NAN);
        koksma__doc_number(d, (double)m->all);
        koksma__doc_number(d, (double)m->sure);
        for (size_t v = 0; v < n_variants; v++) {
            koksma__doc_number(d, m->cases[v] ? m->rho[v] / (double)m->cases[v] : (double)NAN);
        }
    }
    koksma__doc_table_end(d);
}
