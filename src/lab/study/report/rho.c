/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sums of rank correlations (a measure has a cell for each scene and number of samples; the cells are few, so linear
 * search finds them), and rankings of measures by their means. A measure's mean over the chosen cases, and its mean in each
 * resample, are computed from the sums of cells. Two means differ significantly where the p-value of their difference,
 * from the resamples and adjusted by Holm's method, is at most 0.05. Holm's method counts all pairs of measures, not only
 * those with the best measure, because the same data determine which measure is the best. A statement about all scenes is
 * made only if it also holds when any single scene is left out. The jackknife (Efron 1982) uses the same subsets, but to
 * estimate a variance.
 */
#include "study/report/rho.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/parallel.h"
#include "core/status.h"

/* Finds or adds the sums of a measure; NULL: no memory. */
static koksma__rho_sums *sums_of(koksma__rho_means *s, const char *measure)
{
    for (size_t m = 0; m < s->n; m++) {
        if (!strcmp(s->of[m].measure, measure)) {
            return &s->of[m];
        }
    }
    koksma__rho_sums *of = koksma__add_one(&s->of, &s->n, sizeof *of);
    if (of) {
        of->measure = measure;
    }
    return of;
}

static koksma_status index_of(const char ***texts, size_t *n, const char *text, size_t *index)
{
    for (*index = 0; *index < *n; ++*index) {
        if (!strcmp((*texts)[*index], text)) {
            return KOKSMA_OK;
        }
    }
    const char **added = koksma__add_one(texts, n, sizeof *added);
    if (!added) {
        return KOKSMA_MEMORY;
    }
    *added = text;
    return KOKSMA_OK;
}

static koksma_status add_size(koksma__rho_means *s, long long spp)
{
    for (size_t i = 0; i < s->n_sizes; i++) {
        if (s->sizes[i] == spp) {
            return KOKSMA_OK;
        }
    }
    long long *size = koksma__add_one(&s->sizes, &s->n_sizes, sizeof *size);
    if (!size) {
        return KOKSMA_MEMORY;
    }
    *size = spp;
    return KOKSMA_OK;
}

/* Finds or adds the cell of a scene and a number of samples; NULL: no memory. */
static koksma__rho_cell *cell_of(koksma__rho_sums *of, size_t scene, long long spp)
{
    for (size_t c = 0; c < of->n_cells; c++) {
        if (of->cells[c].scene == scene && of->cells[c].spp == spp) {
            return &of->cells[c];
        }
    }
    koksma__rho_cell *cell = koksma__add_one(&of->cells, &of->n_cells, sizeof *cell);
    if (!cell) {
        return NULL;
    }
    *cell = (koksma__rho_cell){.scene = scene, .spp = spp, .draws = calloc(KOKSMA__RHO_SAMPLES, sizeof *cell->draws)};
    if (!cell->draws) {
        (void)koksma__fail_memory(KOKSMA__RHO_SAMPLES * sizeof *cell->draws);
        return NULL;
    }
    return cell;
}

koksma__estimate koksma__rho_shown(const koksma__estimate *rho, size_t n_patterns)
{
    const bool says = n_patterns >= KOKSMA__LEAST_PAIRS && rho->low < rho->high;
    return says ? *rho : (koksma__estimate){rho->value, NAN, NAN};
}

koksma_status koksma__rho_add(koksma__rho_means *s, const koksma__rho_source *source, const koksma__estimate *rho,
                              const double draws[KOKSMA__RHO_SAMPLES])
{
    size_t v, scene;
    koksma__rho_sums *of = sums_of(s, source->measure);
    koksma_status status = of ? index_of(&s->variants, &s->n_variants, source->variant, &v) : KOKSMA_MEMORY;
    status = status ? status : index_of(&s->scenes, &s->n_scenes, source->scene, &scene);
    status = status ? status : add_size(s, source->spp);
    koksma__rho_cell *cell = status ? NULL : cell_of(of, scene, source->spp);
    if (!cell) {
        return KOKSMA_MEMORY;
    }
    const bool few = source->n_patterns < KOKSMA__LEAST_PAIRS;
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
    of->perfect += !few && isnan(rho->low);
    if (v < KOKSMA__RHO_VARIANTS) {
        of->rho[v] += rho->value;
        of->cases[v]++;
    }
    return KOKSMA_OK;
}

static double mean_rho(const koksma__rho_sums *m)
{
    return m->all ? m->total / (double)m->all : (double)NAN;
}

/* Uses insertion sort, because measures and numbers of samples are few. */
void koksma__rho_order(koksma__rho_means *s)
{
    for (size_t m = 1; m < s->n; m++) {
        const koksma__rho_sums of = s->of[m];
        size_t at = m;
        for (; at > 0 && koksma__compare(mean_rho(&s->of[at - 1]), mean_rho(&of)) < 0; at--) {
            s->of[at] = s->of[at - 1];
        }
        s->of[at] = of;
    }
    for (size_t k = 1; k < s->n_sizes; k++) {
        const long long size = s->sizes[k];
        size_t at = k;
        for (; at > 0 && s->sizes[at - 1] > size; at--) {
            s->sizes[at] = s->sizes[at - 1];
        }
        s->sizes[at] = size;
    }
}

void koksma__rho_fini(koksma__rho_means *s)
{
    for (size_t m = 0; m < s->n; m++) {
        for (size_t c = 0; c < s->of[m].n_cells; c++) {
            free(s->of[m].cells[c].draws);
        }
        free(s->of[m].cells);
    }
    KOKSMA__FREE(s->of, s->variants, s->scenes, s->sizes);
}

/* ---- Rankings ---------------------------------------------------------------------------------------------- */

static const double LEVEL = 0.05;

static bool is_in(const koksma__rho_subset *of, const koksma__rho_cell *cell)
{
    return (!of->scenes || of->scenes[cell->scene]) && (!of->spp || of->spp == cell->spp);
}

/* Computes a measure's mean over the subset, and its resamples; out->cases = 0: the measure has no such cases. */
static koksma_status stand(const koksma__rho_sums *m, const koksma__rho_subset *of, double *draws,
                           koksma__rho_standing *out)
{
    size_t few = 0;
    double total = 0;
    for (size_t i = 0; i < KOKSMA__RHO_SAMPLES; i++) {
        draws[i] = 0;
    }
    for (size_t c = 0; c < m->n_cells; c++) {
        const koksma__rho_cell *cell = &m->cells[c];
        if (is_in(of, cell)) {
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
    const koksma_status status = koksma__bootstrap_difference(&mean, &zero, KOKSMA__RHO_SAMPLES, &out->mean);
    out->p = koksma__resampled_p(draws, 1, NULL, 0, KOKSMA__RHO_SAMPLES);
    if (few) {
        out->mean.low = out->mean.high = NAN;
        out->p = 1;
    }
    return status;
}

/* Computes the p-values of all pairs of measures that can be compared, adjusted by Holm's method. */
static koksma_status compare_pairs(const koksma_run *run, koksma__rho_ranking *r, double *const *draws)
{
    const size_t n = r->n;
    double *p = malloc((n * n + 1) * sizeof *p);
    KOKSMA__REQUIRE_MEMORY(p, (n * n + 1) * sizeof *p);
    koksma_status status = KOKSMA_OK;
    for (size_t a = 0; !status && a < n; a++) {
        status = koksma__ask(run);
        for (size_t b = a; !status && b < n; b++) {
            const koksma__rho_standing *x = &r->at[a], *y = &r->at[b];
            const bool compared = a != b && x->cases == y->cases && !isnan(x->mean.low) && !isnan(y->mean.low);
            r->p[a * n + b] = r->p[b * n + a] = compared ? 1 : (double)NAN;
            if (compared) {
                p[r->n_pairs++] = koksma__resampled_p(draws[a], 1, draws[b], 1, KOKSMA__RHO_SAMPLES);
            }
        }
    }
    status = status ? status : koksma__holm(p, r->n_pairs);
    for (size_t a = 0, k = 0; !status && a < n; a++) {
        for (size_t b = a + 1; b < n; b++) {
            if (!isnan(r->p[a * n + b])) {
                r->p[a * n + b] = r->p[b * n + a] = p[k++];
            }
        }
    }
    free(p);
    return status;
}

/* Sorts the standings and their resamples by mean. */
static void order(koksma__rho_ranking *r, double **draws)
{
    for (size_t m = 1; m < r->n; m++) {
        const koksma__rho_standing of = r->at[m];
        double *values = draws[m];
        size_t at = m;
        for (; at > 0 && koksma__compare(r->at[at - 1].mean.value, of.mean.value) < 0; at--) {
            r->at[at] = r->at[at - 1];
            draws[at] = draws[at - 1];
        }
        r->at[at] = of;
        draws[at] = values;
    }
}

static koksma_status fill(const koksma__rho_means *s, const koksma__rho_subset *of, const koksma_run *run,
                          koksma__rho_ranking *r, double **draws)
{
    koksma_status status = KOKSMA_OK;
    for (size_t m = 0; !status && m < s->n; m++) {
        koksma__rho_standing *standing = &r->at[r->n];
        *standing = (koksma__rho_standing){.measure = m};
        status = koksma__ask(run);
        status = status ? status : stand(&s->of[m], of, draws[r->n], standing);
        r->n += standing->cases > 0;
    }
    if (status) {
        return status;
    }
    order(r, draws);
    double *p = malloc((r->n + 1) * sizeof *p);
    KOKSMA__REQUIRE_MEMORY(p, (r->n + 1) * sizeof *p);
    for (size_t i = 0; i < r->n; i++) {
        p[i] = r->at[i].p;
    }
    status = koksma__holm(p, r->n);
    for (size_t i = 0; !status && i < r->n; i++) {
        const koksma__draws mean = {r->at[i].mean.value, 1, draws[i]}, first = {r->at[0].mean.value, 1, draws[0]};
        r->at[i].p = p[i];
        status = koksma__bootstrap_difference(&mean, &first, KOKSMA__RHO_SAMPLES, &r->at[i].less);
        if (i == 0 || isnan(r->at[i].mean.low) || isnan(r->at[0].mean.low)) {
            r->at[i].less.low = r->at[i].less.high = NAN;
        }
    }
    free(p);
    return status ? status : compare_pairs(run, r, draws);
}

koksma_status koksma__rho_rank(const koksma__rho_means *s, const koksma__rho_subset *of, const koksma_run *run,
                               koksma__rho_ranking *r)
{
    const size_t size = KOKSMA__RHO_SAMPLES * sizeof(double);
    *r = (koksma__rho_ranking){.at = calloc(s->n + 1, sizeof *r->at),
                               .place = calloc(s->n + 1, sizeof *r->place),
                               .p = calloc(s->n * s->n + 1, sizeof *r->p)};
    double **draws = calloc(s->n + 1, sizeof *draws);
    const bool complete = r->at && r->place && r->p && draws;
    koksma_status status = complete ? KOKSMA_OK : koksma__fail_memory(s->n * s->n * sizeof *r->p);
    for (size_t m = 0; !status && m < s->n; m++) {
        draws[m] = malloc(size);
        status = draws[m] ? KOKSMA_OK : koksma__fail_memory(size);
    }
    status = status ? status : fill(s, of, run, r, draws);
    for (size_t m = 0; !status && m < s->n; m++) {
        r->place[m] = r->n;
    }
    for (size_t i = 0; !status && i < r->n; i++) {
        r->place[r->at[i].measure] = i;
    }
    for (size_t m = 0; draws && m < s->n; m++) {
        free(draws[m]);
    }
    free(draws);
    if (status) {
        koksma__rho_ranking_fini(r);
    }
    return status;
}

void koksma__rho_ranking_fini(koksma__rho_ranking *r)
{
    free(r->at);
    free(r->place);
    free(r->p);
    *r = (koksma__rho_ranking){0};
}

bool koksma__rho_is_better(const koksma__rho_ranking *r, size_t a, size_t b)
{
    const size_t i = r->place[a], j = r->place[b];
    return i < j && j < r->n && r->p[i * r->n + j] <= LEVEL && r->at[i].mean.value > r->at[j].mean.value;
}

/* Whether a measure's mean is significantly above 0 (at 5 % for all measures together). */
static bool predicts(const koksma__rho_ranking *r, size_t measure)
{
    const size_t i = r->place[measure];
    return i < r->n && r->at[i].p <= LEVEL && r->at[i].mean.value > 0;
}

/* ---- Without one scene --------------------------------------------------------------------------------- */

koksma_status koksma__rho_leave_out(const koksma__rho_means *s, const koksma_run *run, koksma__rho_jackknife *j)
{
    const size_t n = s->n_scenes > 1 ? 1 + s->n_scenes : 1;
    bool *scenes = malloc((s->n_scenes + 1) * sizeof *scenes);
    *j = (koksma__rho_jackknife){.of = calloc(n, sizeof *j->of)};
    koksma_status status = scenes && j->of ? KOKSMA_OK : koksma__fail_memory(n * sizeof *j->of);
    while (!status && j->n < n) {
        for (size_t k = 0; k < s->n_scenes; k++) {
            scenes[k] = j->n != 1 + k;
        }
        status = koksma__rho_rank(s, &(koksma__rho_subset){.scenes = scenes}, run, &j->of[j->n]);
        j->n += !status;
    }
    free(scenes);
    if (status) {
        koksma__rho_jackknife_fini(j);
    }
    return status;
}

void koksma__rho_jackknife_fini(koksma__rho_jackknife *j)
{
    for (size_t i = 0; i < j->n; i++) {
        koksma__rho_ranking_fini(&j->of[i]);
    }
    free(j->of);
    *j = (koksma__rho_jackknife){0};
}

bool koksma__rho_always(const koksma__rho_jackknife *j, koksma__rho_statement statement, size_t a, size_t b)
{
    bool always = j->n > 0;
    for (size_t i = 0; always && i < j->n; i++) {
        const koksma__rho_ranking *r = &j->of[i];
        always = statement == KOKSMA__RHO_BETTER     ? koksma__rho_is_better(r, a, b)
                 : statement == KOKSMA__RHO_PREDICTS ? predicts(r, a)
                 : statement == KOKSMA__RHO_FIRST    ? r->place[a] == 0
                                                     : r->place[a] + 1 == r->n;
    }
    return always;
}

koksma__estimate koksma__rho_range(const koksma__rho_jackknife *j, size_t measure)
{
    koksma__estimate range = {NAN, NAN, NAN};
    for (size_t i = 0; i < j->n; i++) {
        const size_t at = j->of[i].place[measure];
        const double mean = at < j->of[i].n ? j->of[i].at[at].mean.value : (double)NAN;
        range.value = i == 0 ? mean : range.value;
        range.low = fmin(range.low, mean);
        range.high = fmax(range.high, mean);
    }
    return range;
}

/* ---- Words ------------------------------------------------------------------------------------------------- */

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
    const bool always = j->n > 1 && koksma__rho_always(j, KOKSMA__RHO_FIRST, first, 0);
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
        always += koksma__rho_always(j, KOKSMA__RHO_PREDICTS, m, 0);
        sure += predicts(&j->of[0], m);
    }
    koksma__doc_say(d, always ? " Surely above 0%s: " : " No measure's mean is surely above 0%s.", whichever(j));
    for (size_t m = 0; m < s->n; m++) {
        if (koksma__rho_always(j, KOKSMA__RHO_PREDICTS, m, 0)) {
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
        n += koksma__rho_always(j, KOKSMA__RHO_BETTER, a, b);
    }
    if (n) {
        koksma__doc_say(d, "%s`%s` than ", *before, s->of[a].measure);
        *before = "; ";
    }
    for (size_t b = 0; b < s->n; b++) {
        if (koksma__rho_always(j, KOKSMA__RHO_BETTER, a, b)) {
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
        always += koksma__rho_always(j, KOKSMA__RHO_BETTER, i / s->n, i % s->n);
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

void koksma__rho_say(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *j)
{
    const size_t last = j->of[0].at[j->of[0].n - 1].measure;
    const size_t first = j->of[0].at[0].measure;
    const bool too_few = s->of[first].few == s->of[first].all;
    koksma__doc_answer_begin(d, !too_few && (j->n == 1 || koksma__rho_always(j, KOKSMA__RHO_FIRST, first, 0)));
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
        if (s->n > 1 && koksma__rho_always(j, KOKSMA__RHO_LAST, last, 0)) {
            koksma__doc_say(d, " The last is `%s` with %+.2f.", s->of[last].measure, mean_of(&s->of[last]));
        }
    }
    koksma__doc_paragraph_end(d);
    koksma__doc_paragraph(
        d,
        "A case is the rank correlation, over patterns, of a measure of n points with the error of "
        "images of n samples a pixel. Intervals are 95 %% intervals from %d bootstrap resamples of the "
        "patterns and their means; they are approximate: those of single cases with 7 to 30 simulated patterns hold "
        "in 94 to 99 %%, and in 86 to 100 %% where each mean is uncertain by a fifth of their spread. _Surely_ means "
        "significant at 5 %% for all tests of a "
        "kind together "
        "(Holm's method): the tests of %zu pairs of measures here, and those of %zu measures against 0. The "
        "sign of the correlations is reversed for a measure that is better when larger, so that +1 always "
        "means that the measure orders the patterns as their errors do.",
        KOKSMA__RHO_SAMPLES, j->of[0].n_pairs, s->n);
    if (0.05 * (KOKSMA__RHO_SAMPLES + 1) < 2 * (double)j->of[0].n_pairs) {
        koksma__doc_paragraph(d, "%d resamples are too few for so many pairs: no difference can be called sure.",
                              KOKSMA__RHO_SAMPLES);
    }
}
