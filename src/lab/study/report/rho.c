/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sums of rank correlations (a measure has a cell for each scene; both are few, so linear search finds them), and
 * rankings of measures by their means. A measure's mean over the chosen cases, and its mean in each resample, are
 * computed from the sums of cells. Two means differ significantly where the p-value of their difference, from the
 * resamples and adjusted by Holm's method, is at most 0.05. Holm's method counts all pairs of measures, not only those
 * with the best measure, because the same data determine which measure is the best. A statement about all scenes is made
 * only if it also holds when any single scene is left out. The jackknife (Efron 1982) uses the same subsets, but to
 * estimate a variance.
 */
#include "study/report/rho.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

koksma__estimate koksma__rho_shown(const koksma__estimate *rho, size_t n_patterns)
{
    const bool says = n_patterns >= KOKSMA__LEAST_PAIRS && rho->low < rho->high;
    return says ? *rho : (koksma__estimate){rho->value, NAN, NAN};
}

void koksma__rho_add(koksma__report *r, koksma__rho_means *s, const char *measure, const char *scene,
                     size_t n_patterns, const koksma__estimate *rho, const double draws[KOKSMA__RHO_SAMPLES])
{
    size_t m = 0, k = 0;
    while (m < s->n && strcmp(s->of[m].measure, measure) != 0) {
        m++;
    }
    while (k < s->n_scenes && strcmp(s->scenes[k], scene) != 0) {
        k++;
    }
    if ((m == s->n && !koksma__report_add(r, &s->of, &s->n, sizeof *s->of)) ||
        (k == s->n_scenes && !koksma__report_add(r, &s->scenes, &s->n_scenes, sizeof *s->scenes))) {
        return;
    }
    koksma__rho_sums *of = &s->of[m];
    of->measure = measure;
    s->scenes[k] = scene;
    while (of->n_cells <= k && koksma__report_add(r, &of->cells, &of->n_cells, sizeof *of->cells)) {
    }
    koksma__rho_cell *cell = r->status ? NULL : &of->cells[k];
    if (cell && !cell->draws) {
        cell->draws = koksma__report_memory(r, KOKSMA__RHO_SAMPLES, sizeof *cell->draws);
    }
    if (r->status) {
        return;
    }
    const bool few = n_patterns < KOKSMA__LEAST_PAIRS;
    cell->total += rho->value;
    cell->all++;
    cell->few += few;
    for (size_t i = 0; i < KOKSMA__RHO_SAMPLES; i++) {
        cell->draws[i] += draws[i];
    }
    of->total += rho->value;
    of->all++;
    of->sure += rho->low > 0 || rho->high < 0;
    of->few += few;
}

static double mean_of(const koksma__rho_sums *m)
{
    return m->total / (double)m->all;
}

void koksma__rho_order(koksma__report *r, koksma__rho_means *s)
{
    koksma__rho_sums *sorted = koksma__report_memory(r, s->n, sizeof *sorted);
    double *means = koksma__report_memory(r, s->n, sizeof *means);
    size_t *order = koksma__report_memory(r, s->n, sizeof *order);
    s->draws = koksma__report_memory(r, s->n * KOKSMA__RHO_SAMPLES, sizeof *s->draws);
    for (size_t m = 0; !r->status && m < s->n; m++) {
        means[m] = mean_of(&s->of[m]);
    }
    if (!r->status && s->n) {
        koksma__order_means(means, 1, s->n, true, order);
        for (size_t m = 0; m < s->n; m++) {
            sorted[m] = s->of[order[m]];
        }
        s->of = sorted;
    }
}

/* ---- Rankings ---------------------------------------------------------------------------------------------- */

static const double LEVEL = 0.05;

/* Computes a measure's mean over some scenes, and its resamples; out->cases = 0: the measure has no such cases. */
static void stand(koksma__report *r, const koksma__rho_sums *m, const bool *scenes, double *draws,
                  koksma__rho_standing *out)
{
    size_t few = 0;
    double total = 0;
    for (size_t i = 0; i < KOKSMA__RHO_SAMPLES; i++) {
        draws[i] = 0;
    }
    for (size_t k = 0; k < m->n_cells; k++) {
        const koksma__rho_cell *cell = &m->cells[k];
        if (scenes[k] && cell->draws) {
            out->cases += cell->all;
            few += cell->few;
            total += cell->total;
            for (size_t i = 0; i < KOKSMA__RHO_SAMPLES; i++) {
                draws[i] += cell->draws[i];
            }
        }
    }
    const double share = out->cases ? 1 / (double)out->cases : 0;
    for (size_t i = 0; i < KOKSMA__RHO_SAMPLES; i++) {
        draws[i] *= share;
    }
    const koksma__draws mean = {total * share, 1, draws}, zero = {0, 0, draws};
    koksma__report_keep(r, koksma__bootstrap_difference(&mean, &zero, KOKSMA__RHO_SAMPLES, &out->mean));
    out->p = koksma__resampled_p(draws, 1, NULL, 0, KOKSMA__RHO_SAMPLES);
    if (few) {
        out->mean.low = out->mean.high = NAN;
        out->p = 1;
    }
}

/* Finds by how much each mean is less than the first, and adjusts the p-values of the means, and of all pairs of
   measures that can be compared, by Holm's method. */
static void compare(koksma__report *r, const koksma__rho_means *s, koksma__rho_ranking *k)
{
    double *p = koksma__report_memory(r, k->n * (k->n + 1), sizeof *p), *pairs = p + k->n;
    for (size_t i = 0; koksma__report_goes_on(r) && i < k->n; i++) {
        const size_t a = k->order[i], first = k->order[0];
        koksma__rho_standing *x = &k->of[a];
        const double *draws = s->draws + a * KOKSMA__RHO_SAMPLES;
        const koksma__draws mean = {x->mean.value, 1, draws},
                            best = {k->of[first].mean.value, 1, s->draws + first * KOKSMA__RHO_SAMPLES};
        koksma__report_keep(r, koksma__bootstrap_difference(&mean, &best, KOKSMA__RHO_SAMPLES, &x->less));
        if (i == 0 || isnan(x->mean.low) || isnan(k->of[first].mean.low)) {
            x->less.low = x->less.high = NAN;
        }
        p[i] = x->p;
        for (size_t j = i; j < k->n; j++) {
            const size_t b = k->order[j];
            const koksma__rho_standing *y = &k->of[b];
            const bool compared = i != j && x->cases == y->cases && !isnan(x->mean.low) && !isnan(y->mean.low);
            k->p[a * s->n + b] = k->p[b * s->n + a] = compared ? 1 : (double)NAN;
            if (compared) {
                pairs[k->n_pairs++] =
                    koksma__resampled_p(draws, 1, s->draws + b * KOKSMA__RHO_SAMPLES, 1, KOKSMA__RHO_SAMPLES);
            }
        }
    }
    koksma__report_keep(r, r->status ? r->status : koksma__holm(p, k->n));
    koksma__report_keep(r, r->status ? r->status : koksma__holm(pairs, k->n_pairs));
    for (size_t i = 0, next = 0; !r->status && i < k->n; i++) {
        const size_t a = k->order[i];
        k->of[a].p = p[i];
        for (size_t j = i + 1; j < k->n; j++) {
            const size_t b = k->order[j];
            if (!isnan(k->p[a * s->n + b])) {
                k->p[a * s->n + b] = k->p[b * s->n + a] = pairs[next++];
            }
        }
    }
}

koksma__rho_ranking koksma__rho_rank(koksma__report *r, const koksma__rho_means *s, const bool *scenes)
{
    koksma__rho_ranking k = {.measures = s->n,
                             .of = koksma__report_memory(r, s->n, sizeof *k.of),
                             .p = koksma__report_memory(r, s->n * s->n, sizeof *k.p),
                             .order = koksma__report_memory(r, s->n, sizeof *k.order)};
    double *means = koksma__report_memory(r, s->n, sizeof *means);
    for (size_t m = 0; koksma__report_goes_on(r) && m < s->n; m++) {
        stand(r, &s->of[m], scenes, s->draws + m * KOKSMA__RHO_SAMPLES, &k.of[m]);
        means[m] = k.of[m].cases ? k.of[m].mean.value : (double)NAN;
    }
    if (!r->status) {
        k.n = koksma__order_means(means, 1, s->n, true, k.order);
        compare(r, s, &k);
    }
    return r->status ? (koksma__rho_ranking){0} : k;
}

bool koksma__rho_is_better(const koksma__rho_ranking *r, size_t a, size_t b)
{
    return r->of[a].cases && r->of[b].cases && r->p[a * r->measures + b] <= LEVEL &&
           r->of[a].mean.value > r->of[b].mean.value;
}

/* ---- Without one scene --------------------------------------------------------------------------------- */

koksma__rho_jackknife koksma__rho_leave_out(koksma__report *r, const koksma__rho_means *s)
{
    const size_t n = s->n_scenes > 1 ? 1 + s->n_scenes : 1;
    bool *scenes = koksma__report_memory(r, s->n_scenes, sizeof *scenes);
    koksma__rho_jackknife j = {.of = koksma__report_memory(r, n, sizeof *j.of)};
    for (; !r->status && j.n < n; j.n++) {
        for (size_t k = 0; k < s->n_scenes; k++) {
            scenes[k] = j.n != 1 + k;
        }
        j.of[j.n] = koksma__rho_rank(r, s, scenes);
    }
    return j;
}

bool koksma__rho_always(const koksma__rho_jackknife *j, koksma__rho_statement statement, size_t a, size_t b)
{
    bool always = j->n > 0;
    for (size_t i = 0; always && i < j->n; i++) {
        const koksma__rho_ranking *r = &j->of[i];
        always = statement == KOKSMA__RHO_BETTER ? koksma__rho_is_better(r, a, b)
                 : statement == KOKSMA__RHO_PREDICTS
                     ? r->of[a].cases && r->of[a].p <= LEVEL && r->of[a].mean.value > 0
                     : r->order[0] == a;
    }
    return always;
}

koksma__estimate koksma__rho_range(const koksma__rho_jackknife *j, size_t measure)
{
    koksma__estimate range = {NAN, NAN, NAN};
    for (size_t i = 0; i < j->n; i++) {
        const koksma__rho_standing *of = &j->of[i].of[measure];
        const double mean = of->cases ? of->mean.value : (double)NAN;
        range.value = i == 0 ? mean : range.value;
        range.low = fmin(range.low, mean);
        range.high = fmax(range.high, mean);
    }
    return range;
}

/* ---- Words ------------------------------------------------------------------------------------------------- */

/* Writes which measure comes first, and whether that depends on a single scene. */
static void say_first(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    const koksma__rho_sums *first = &s->of[0];
    const bool always = koksma__rho_always(j, KOKSMA__RHO_FIRST, 0, 0);
    koksma__doc_say(d,
                    always
                        ? "*Best predictor:* `%s` (mean Spearman %+.2f over %zu case%s; the interval excludes 0 in "
                          "%zu of them)"
                        : "*The best predictor depends on the scenes.* Over all of them it is `%s` (mean Spearman "
                          "%+.2f over %zu case%s; the interval excludes 0 in %zu of them)",
                    first->measure, mean_of(first), first->all, koksma__plural((double)first->all), first->sure);
    if (j->n == 1) {
        koksma__doc_say(d, ". All cases are of one scene; other scenes may differ.");
    } else if (always) {
        const koksma__estimate range = koksma__rho_range(j, 0);
        koksma__doc_say(d, ". It comes first whichever one of the %zu scenes is left out (%+.2f to %+.2f).",
                        s->n_scenes, range.low, range.high);
    } else {
        koksma__doc_say(d, ".");
    }
}

/* Writes, unless d is NULL, the measures whose mean is always surely above 0 (with their means), or, with a measure `than`,
   those that are always surely worse than it, as "a, b and c". Returns their number. */
static size_t list_measures(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j,
                            const size_t *than)
{
    size_t n = d ? list_measures(NULL, s, j, than) : 0, named = 0;
    for (size_t m = 0; m < s->n; m++) {
        if (!(than ? koksma__rho_always(j, KOKSMA__RHO_BETTER, *than, m)
                   : koksma__rho_always(j, KOKSMA__RHO_PREDICTS, m, 0))) {
            continue;
        }
        named++;
        if (d) {
            koksma__doc_say(d, "%s`%s`", named == 1 ? "" : named < n ? ", " : " and ", s->of[m].measure);
        }
        if (d && !than) {
            koksma__doc_say(d, " %+.2f", mean_of(&s->of[m]));
        }
    }
    return named;
}

/* Writes the measures whose mean is significantly above 0, and all pairs of measures of which one is significantly
   better. */
static void say_sure(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    const char *whichever = j->n > 1 ? ", whichever one scene is left out" : "", *before = "";
    const size_t always = list_measures(NULL, s, j, NULL);
    size_t better = 0;
    for (size_t a = 0; a < s->n; a++) {
        better += list_measures(NULL, s, j, &a);
    }
    koksma__doc_say(d, always ? " Surely above 0%s: " : " No measure's mean is surely above 0%s.", whichever);
    list_measures(d, s, j, NULL);
    koksma__doc_say(d, "%s", always ? "." : "");
    koksma__doc_say(d, better ? " Surely better%s: " : " No measure is surely better than another%s.", whichever);
    for (size_t a = 0; a < s->n; a++) {
        if (list_measures(NULL, s, j, &a)) {
            koksma__doc_say(d, "%s`%s` than ", before, s->of[a].measure);
            list_measures(d, s, j, &a);
            before = "; ";
        }
    }
    koksma__doc_say(d, "%s", better ? "." : "");
}

void koksma__rho_say(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    const koksma__rho_sums *first = &s->of[0];
    const bool too_few = first->few == first->all;
    koksma__doc_answer(d, !too_few && koksma__rho_always(j, KOKSMA__RHO_FIRST, 0, 0), "%s", "");
    if (too_few) {
        koksma__doc_say(d,
                        "*Undecided:* a rank correlation needs %d patterns or more for an interval. The largest "
                        "correlation, over fewer patterns, is that of `%s`, %+.2f.",
                        KOKSMA__LEAST_PAIRS, first->measure, mean_of(first));
    } else {
        say_first(d, s, j);
        say_sure(d, s, j);
    }
    koksma__doc_paragraph(
        d,
        "A case is the rank correlation, over patterns, of a measure of n points with the error of images of n "
        "samples a pixel. Intervals are 95 %% intervals from %d bootstrap resamples of the patterns and their means; "
        "they are approximate: those of single cases with 7 to 30 simulated patterns hold in 94 to 99 %%, and in 86 "
        "to 100 %% where each mean is uncertain by a fifth of their spread. _Surely_ means significant at 5 %% for "
        "all tests of a kind together (Holm's method): the tests of %zu pairs of measures here, and those of %zu "
        "measures against 0. The sign of the correlations is reversed for a measure that is better when larger, so "
        "that +1 always means that the measure orders the patterns as their errors do.",
        KOKSMA__RHO_SAMPLES, j->of[0].n_pairs, s->n);
    if (0.05 * (KOKSMA__RHO_SAMPLES + 1) < 2 * (double)j->of[0].n_pairs) {
        koksma__doc_paragraph(d, "%d resamples are too few for so many pairs: no difference can be called sure.",
                              KOKSMA__RHO_SAMPLES);
    }
}
