/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rankings of measures by their mean rank correlation with the image error. A measure's mean over the chosen cases,
 * and its mean in each resample, are computed from sums of cells (rho_means.h). Two means differ significantly where
 * the p-value of their difference, from the resamples and adjusted by Holm's method, is at most 0.05. Holm's method
 * counts all pairs of measures, not only those with the best measure, because the same data determine which measure
 * is the best. A statement about all scenes is made only if it also holds when any single scene is left out. The
 * jackknife (Efron 1982) uses the same subsets, but to estimate a variance.
 */
#include "study/report/rho_ranking.h"
#include "stats/stats.h"

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"

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

static koksma_status fill(const koksma__rho_means *s, const koksma__rho_subset *of, koksma__rho_ranking *r,
                          double **draws)
{
    koksma_status status = KOKSMA_OK;
    for (size_t m = 0; !status && m < s->n; m++) {
        koksma__rho_standing *standing = &r->at[r->n];
        *standing = (koksma__rho_standing){.measure = m};
        status = koksma__ask(s->run);
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
    return status ? status : compare_pairs(s->run, r, draws);
}

koksma_status koksma__rho_rank(const koksma__rho_means *s, const koksma__rho_subset *of, koksma__rho_ranking *r)
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
    status = status ? status : fill(s, of, r, draws);
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

bool koksma__rho_predicts(const koksma__rho_ranking *r, size_t measure)
{
    const size_t i = r->place[measure];
    return i < r->n && r->at[i].p <= LEVEL && r->at[i].mean.value > 0;
}

/* ---- Without one scene --------------------------------------------------------------------------------- */

koksma_status koksma__rho_leave_out(const koksma__rho_means *s, koksma__rho_jackknife *j)
{
    const size_t n = s->n_scenes > 1 ? 1 + s->n_scenes : 1;
    bool *scenes = malloc((s->n_scenes + 1) * sizeof *scenes);
    *j = (koksma__rho_jackknife){.of = calloc(n, sizeof *j->of)};
    koksma_status status = scenes && j->of ? KOKSMA_OK : koksma__fail_memory(n * sizeof *j->of);
    while (!status && j->n < n) {
        for (size_t k = 0; k < s->n_scenes; k++) {
            scenes[k] = j->n != 1 + k;
        }
        status = koksma__rho_rank(s, &(koksma__rho_subset){.scenes = scenes}, &j->of[j->n]);
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

bool koksma__rho_always_better(const koksma__rho_jackknife *j, size_t a, size_t b)
{
    bool always = j->n > 0;
    for (size_t i = 0; always && i < j->n; i++) {
        always = koksma__rho_is_better(&j->of[i], a, b);
    }
    return always;
}

bool koksma__rho_always_predicts(const koksma__rho_jackknife *j, size_t measure)
{
    bool always = j->n > 0;
    for (size_t i = 0; always && i < j->n; i++) {
        always = koksma__rho_predicts(&j->of[i], measure);
    }
    return always;
}

bool koksma__rho_always_first(const koksma__rho_jackknife *j, size_t measure)
{
    bool always = j->n > 0;
    for (size_t i = 0; always && i < j->n; i++) {
        always = j->of[i].place[measure] == 0;
    }
    return always;
}

bool koksma__rho_always_last(const koksma__rho_jackknife *j, size_t measure)
{
    bool always = j->n > 0;
    for (size_t i = 0; always && i < j->n; i++) {
        always = j->of[i].place[measure] + 1 == j->of[i].n;
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
