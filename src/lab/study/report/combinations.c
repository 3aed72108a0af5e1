/* SPDX-License-Identifier: Apache-2.0 */
/* Collects the ranks of a question's cases, one measure at a time, and reports the results of rank_regression.c: for
   each scene it chooses the single measure, the pair of measures and the combination of all measures that fit the
   errors of the other scenes best, and finds how well each of the three orders the errors of the scene itself. */
#include "study/report/combinations.h"
#include "stats/stats.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"

static koksma_status open_case(koksma__combinations *c, const koksma__case *at, const koksma__pairs *found)
{
    koksma__combined *of = koksma__add_one(&c->of, &c->n, sizeof *of);
    if (!of) {
        return KOKSMA_MEMORY;
    }
    *of = (koksma__combined){.scene = at->scene,
                             .variant = at->variant,
                             .spp = at->spp,
                             .n = found->n,
                             .patterns = malloc((found->n + 1) * sizeof *of->patterns),
                             .ranks = calloc((c->cases->n + 1) * (found->n + 1), sizeof *of->ranks)};
    KOKSMA__REQUIRE_MEMORY(of->patterns && of->ranks, (c->cases->n + 1) * found->n * sizeof *of->ranks);
    memcpy(of->patterns, found->patterns, found->n * sizeof *of->patterns);
    koksma__unit_ranks(found->y, found->n, of->ranks + c->cases->n * found->n);
    return KOKSMA_OK;
}

static bool has_patterns(const koksma__combined *of, const koksma__pairs *found)
{
    bool same = of->n == found->n;
    for (size_t i = 0; same && i < of->n; i++) {
        same = !strcmp(of->patterns[i], found->patterns[i]);
    }
    return same;
}

koksma_status koksma__combinations_add(koksma__combinations *c, const koksma__case *at, const koksma__pairs *found)
{
    const koksma__combined *last = c->n ? &c->of[c->n - 1] : NULL;
    if (!last || last->spp != at->spp || strcmp(last->scene, at->scene) != 0 ||
        strcmp(last->variant, at->variant) != 0) {
        const koksma_status status = open_case(c, at, found);
        if (status) {
            return status;
        }
    }
    koksma__combined *of = &c->of[c->n - 1];
    if (has_patterns(of, found)) {
        koksma__unit_ranks(found->x, found->n, of->ranks + (size_t)(at->of - c->cases->measured) * of->n);
        of->n_measures++;
    }
    return KOKSMA_OK;
}

/* Whether a case has ranks of all measures, and its errors are not all equal. */
static bool is_complete(const koksma__combinations *c, const koksma__combined *of)
{
    bool differ = false;
    for (size_t i = 0; i < of->n; i++) {
        differ |= of->ranks[c->cases->n * of->n + i] != 0;
    }
    return differ && of->n_measures == c->cases->n;
}

/* ---- Results ------------------------------------------------------------------------------------------- */

typedef struct findings {
    size_t n_cases, n_scenes; /* number of complete cases, and number of scenes with such cases */
    const char **scenes;
    koksma__rank_case *cases;
    koksma__held_out *held_out;
} findings;

static void findings_fini(findings *f)
{
    KOKSMA__FREE(f->scenes, f->cases, f->held_out);
    *f = (findings){0};
}

static koksma_status findings_init(const koksma__combinations *c, findings *f)
{
    *f = (findings){.scenes = calloc(c->n + 1, sizeof *f->scenes),
                    .cases = calloc(c->n + 1, sizeof *f->cases),
                    .held_out = calloc(c->n + 1, sizeof *f->held_out)};
    if (!f->scenes || !f->cases || !f->held_out) {
        findings_fini(f);
        return koksma__fail_memory(c->n * sizeof *f->held_out);
    }
    for (size_t i = 0; i < c->n; i++) {
        const koksma__combined *of = &c->of[i];
        size_t scene = 0;
        if (!is_complete(c, of)) {
            continue;
        }
        while (scene < f->n_scenes && strcmp(f->scenes[scene], of->scene) != 0) {
            scene++;
        }
        f->scenes[scene] = of->scene;
        f->n_scenes += scene == f->n_scenes;
        f->cases[f->n_cases++] = (koksma__rank_case){scene, of->n, of->ranks};
    }
    return KOKSMA_OK;
}

static void say_difference(koksma__document *d, const koksma__summary *s)
{
    koksma__doc_say(d, "%+.2f (%+.2f to %+.2f)", s->mean, s->low, s->high);
}

/* Writes a mean correlation and its interval, which is clamped to -1 .. 1. */
static void say_mean(koksma__document *d, const koksma__summary *s)
{
    koksma__doc_say(d, "%+.2f (%+.2f to %+.2f)", s->mean, fmax(s->low, -1), fmin(s->high, 1));
}

/* The number of scenes for which the same single measure (or pair) was chosen as for scene i. */
static size_t times_chosen(const findings *f, size_t i, bool pair)
{
    size_t n = 0;
    for (size_t s = 0; s < f->n_scenes; s++) {
        const koksma__held_out *a = &f->held_out[i], *b = &f->held_out[s];
        n += pair ? a->pair[0] == b->pair[0] && a->pair[1] == b->pair[1] : a->single == b->single;
    }
    return n;
}

static void say_chosen(koksma__document *d, const koksma__cases *cases, const findings *f, bool pair)
{
    size_t most = 0;
    for (size_t i = 1; i < f->n_scenes; i++) {
        most = times_chosen(f, i, pair) > times_chosen(f, most, pair) ? i : most;
    }
    const koksma__held_out *of = &f->held_out[most];
    koksma__doc_say(d, " (`%s`", cases->measured[pair ? of->pair[0] : of->single].label);
    if (pair) {
        koksma__doc_say(d, " with `%s`", cases->measured[of->pair[1]].label);
    }
    koksma__doc_say(d, " in %zu of %zu scenes) ", times_chosen(f, most, pair), f->n_scenes);
}

static void say_findings(koksma__document *d, const koksma__cases *cases, const findings *f)
{
    enum { STRIDE = sizeof *f->held_out / sizeof(double) };
    _Static_assert(sizeof *f->held_out % sizeof(double) == 0, "the stride must be a whole number of doubles");
    const size_t n = f->n_scenes;
    const koksma__held_out *of = f->held_out;
    const koksma__summary single = koksma__summarize(&of->rho_single, n, STRIDE);
    const koksma__summary pair = koksma__summarize(&of->rho_pair, n, STRIDE);
    const koksma__summary all = koksma__summarize(&of->rho_all, n, STRIDE);
    const koksma__summary gain = koksma__paired(&of->rho_pair, &of->rho_single, n, STRIDE);
    const koksma__summary gain_of_all = koksma__paired(&of->rho_all, &of->rho_single, n, STRIDE);
    const koksma__summary best = koksma__summarize(&of->rho_hindsight, n, STRIDE);
    koksma__doc_paragraph_begin(d);
    koksma__doc_say(
        d,
        "The errors of each scene are predicted from the ranks of the measures; the measures are chosen, and the "
        "regressions fitted, on the other %zu scenes (%zu cases). Mean Spearman correlation of the prediction "
        "with the error in the scene left out: the best single measure",
        n - 1, f->n_cases);
    say_chosen(d, cases, f, false);
    say_mean(d, &single);
    koksma__doc_say(d, ", the best pair");
    say_chosen(d, cases, f, true);
    say_mean(d, &pair);
    koksma__doc_say(d, ", ridge regression on all %zu measures ", cases->n);
    say_mean(d, &all);
    koksma__doc_say(d, ". Compared with the single measure the pair changes the correlation by ");
    say_difference(d, &gain);
    koksma__doc_say(d, ", all measures by ");
    say_difference(d, &gain_of_all);
    koksma__doc_say(
        d,
        ". The measure that is best in the scene left out has %+.2f on average, but it is known only in hindsight. "
        "Intervals are by Student's t over the scenes; they are approximate, because any two fits "
        "have scenes in common, and all scenes have the same patterns.",
        best.mean);
    koksma__doc_paragraph_end(d);
}

static void add_table(koksma__document *d, const char *id, const koksma__cases *cases, const findings *f)
{
    char text[2 * KOKSMA_MAX_SPEC + 64];
    snprintf(text, sizeof text, "combinations-%.40s", id);
    koksma__doc_table_begin(d, text);
    koksma__doc_head(d, "scene left out");
    koksma__doc_head_number(d, "cases", 7);
    koksma__doc_head(d, "single measure");
    koksma__doc_head_number(d, "its Spearman", 3);
    koksma__doc_head(d, "pair");
    koksma__doc_head_number(d, "pair's Spearman", 3);
    koksma__doc_head_number(d, "penalty of all", 2);
    koksma__doc_head_number(d, "all's Spearman", 3);
    koksma__doc_head(d, "best in hindsight");
    koksma__doc_head_number(d, "hindsight's Spearman", 3);
    for (size_t s = 0; s < f->n_scenes; s++) {
        const koksma__held_out *of = &f->held_out[s];
        koksma__doc_row(d);
        koksma__doc_text(d, f->scenes[s]);
        koksma__doc_number(d, (double)of->cases);
        koksma__doc_text(d, cases->measured[of->single].label);
        koksma__doc_number(d, of->rho_single);
        snprintf(text, sizeof text, "%s + %s", cases->measured[of->pair[0]].label,
                 cases->measured[of->pair[1]].label);
        koksma__doc_text(d, text);
        koksma__doc_number(d, of->rho_pair);
        koksma__doc_number(d, of->penalty);
        koksma__doc_number(d, of->rho_all);
        koksma__doc_text(d, cases->measured[of->hindsight].label);
        koksma__doc_number(d, of->rho_hindsight);
    }
    koksma__doc_table_end(d);
}

koksma_status koksma__combinations_report(koksma__document *d, const char *id, const koksma__combinations *c)
{
    findings f;
    koksma_status status = findings_init(c, &f);
    if (!status && f.n_scenes >= 3 && c->cases->n >= 2) {
        status =
            koksma__rank_regression(f.cases, f.n_cases, c->cases->n, f.n_scenes, c->cases->study->report, f.held_out);
        if (!status) {
            koksma__doc_section(d, NULL, "Combinations of measures, tried on the scene left out");
            say_findings(d, c->cases, &f);
            add_table(d, id, c->cases, &f);
            koksma__doc_end(d);
        }
    }
    findings_fini(&f);
    return status;
}

void koksma__combinations_fini(koksma__combinations *c)
{
    for (size_t i = 0; i < c->n; i++) {
        free(c->of[i].patterns);
        free(c->of[i].ranks);
    }
    free(c->of);
}
