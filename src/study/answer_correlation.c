/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Does a measure order the patterns as the error of images does? For every scene, variant and number of samples the
 * rank correlation, over patterns, of the mean of a measure of n points with the mean error of images of n samples a
 * pixel; its interval is a bootstrap over the patterns that redraws the means. All cases and measures are resampled
 * together, so that the mean correlations of two measures can be compared.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "study/rho_means.h"

/* The bootstrap's time goes with the square of the patterns. */
enum { MAX_PATTERNS = 256 };

typedef struct pairs {
    size_t n;
    double x[MAX_PATTERNS], y[MAX_PATTERNS], low[MAX_PATTERNS], high[MAX_PATTERNS];
    double x_error[MAX_PATTERNS], y_error[MAX_PATTERNS];
    const char *patterns[MAX_PATTERNS];
} pairs;

typedef struct point {
    const koksma__image_block *image;
    const char *scene, *variant;
    long long spp;
    const koksma__discrepancy_block *discrepancy;
    const char *measure;
} point;

static bool has(const koksma__wholes *wholes, long long n)
{
    for (size_t i = 0; i < wholes->n; i++) {
        if (wholes->at[i] == n) {
            return true;
        }
    }
    return false;
}

/* The patterns that both blocks have rows of. */
static koksma_status collect(koksma_study *study, const point *p, pairs *out)
{
    koksma_status status = KOKSMA_OK;
    out->n = 0;
    for (size_t i = 0; !status && i < p->image->patterns.n && out->n < MAX_PATTERNS; i++) {
        const char *pattern = p->image->patterns.at[i];
        koksma__summary x, y;
        status = koksma__discrepancy_mean(study, p->discrepancy, "", pattern, p->spp, p->measure, NULL, &x);
        status =
            status ? status : koksma__image_mean(study, p->image, p->scene, p->variant, pattern, p->spp, NULL, &y);
        if (!status && x.n && y.n) {
            out->x[out->n] = x.mean;
            out->y[out->n] = y.mean;
            out->x_error[out->n] = x.sd / sqrt((double)x.n);
            out->y_error[out->n] = y.sd / sqrt((double)y.n);
            out->low[out->n] = y.low;
            out->high[out->n] = y.high;
            out->patterns[out->n++] = pattern;
        }
    }
    return status;
}

typedef koksma_status (*visitor)(koksma_study *study, void *context, const point *p);

static koksma_status visit_measures(koksma_study *study, const koksma__topic *topic, point *p, visitor visit,
                                    void *context)
{
    koksma_status status = KOKSMA_OK;
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        p->discrepancy = topic->discrepancies[b];
        if (!p->discrepancy->warps.n && has(&p->discrepancy->n, p->spp)) {
            for (size_t m = 0; !status && m < p->discrepancy->measures.n; m++) {
                p->measure = p->discrepancy->measures.at[m];
                status = visit(study, context, p);
            }
        }
    }
    return status;
}

/* Every scene, variant, number of samples and measure. */
static koksma_status visit_all(koksma_study *study, const koksma__topic *topic, visitor visit, void *context)
{
    koksma_status status = KOKSMA_OK;
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *i = topic->images[b];
        for (size_t k = 0; !status && k < i->scenes.n * i->variants.n * i->spp.n; k++) {
            point p = {.image = i,
                       .scene = i->scenes.at[k / (i->variants.n * i->spp.n)],
                       .variant = i->variants.at[k / i->spp.n % i->variants.n],
                       .spp = i->spp.at[k % i->spp.n]};
            status = visit_measures(study, topic, &p, visit, context);
        }
    }
    return status;
}

typedef struct listing {
    koksma__grid *grid;
    koksma__rho_means *means;
} listing;

/* rho, with its resamples, and tau. */
static koksma_status correlate(const point *p, const pairs *found, double draws[KOKSMA__RHO_SAMPLES],
                               koksma__estimate *rho, koksma__estimate *tau)
{
    const koksma__means x = {found->x, found->x_error, koksma__job_seed("means|%s|%lld", p->measure, p->spp)};
    const koksma__means y = {found->y, found->y_error,
                             koksma__job_seed("means|%s|%s|%lld", p->scene, p->variant, p->spp)};
    const uint64_t seed = koksma__job_seed("correlation");
    memset(draws, 0, KOKSMA__RHO_SAMPLES * sizeof *draws);
    const koksma_status status =
        koksma__bootstrap_pairs(&x, &y, found->n, koksma__spearman, KOKSMA__RHO_SAMPLES, seed, draws, rho);
    return status ? status
                  : koksma__bootstrap_pairs(&x, &y, found->n, koksma__kendall, KOKSMA__RHO_SAMPLES, seed, NULL, tau);
}

/* An interval without width says nothing. */
static koksma__estimate shown(koksma__estimate e)
{
    return e.low < e.high ? e : (koksma__estimate){e.value, NAN, NAN};
}

static koksma_status list_row(koksma_study *study, void *context, const point *p)
{
    listing *l = context;
    pairs found;
    double draws[KOKSMA__RHO_SAMPLES];
    koksma__estimate rho, tau;
    koksma_status status = collect(study, p, &found);
    if (status || found.n < 4) {
        return status;
    }
    status = correlate(p, &found, draws, &rho, &tau);
    if (status || isnan(rho.value)) {
        return status;
    }
    koksma__grid_row(l->grid);
    koksma__grid_text(l->grid, p->scene);
    koksma__grid_text(l->grid, p->variant[0] ? p->variant : "defaults");
    koksma__grid_number(l->grid, (double)p->spp, 7);
    koksma__grid_text(l->grid, p->measure);
    koksma__grid_number(l->grid, (double)found.n, 7);
    koksma__grid_interval(l->grid, shown(rho), 3);
    koksma__grid_interval(l->grid, shown(tau), 3);
    return koksma__rho_add(l->means, p->measure, p->variant, &rho, draws, found.n);
}

/* What the answer leaves out. */
static void add_limits(koksma__html *h, const koksma__topic *topic, const koksma__rho_means *s)
{
    size_t most = 0;
    for (size_t b = 0; b < topic->n_images; b++) {
        most = topic->images[b]->patterns.n > most ? topic->images[b]->patterns.n : most;
    }
    if (most > MAX_PATTERNS) {
        koksma__html_add(h,
                         "<p>Of up to %zu patterns the first %d are correlated; the others are in the export.</p>\n",
                         most, MAX_PATTERNS);
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
static koksma_status add_scatter(koksma_study *study, void *context, const point *p)
{
    plots *to = context;
    pairs found;
    if (!to->left || strcmp(p->measure, to->measure) != 0 || p->spp != p->image->spp.at[p->image->spp.n / 2]) {
        return KOKSMA_OK;
    }
    const koksma_status status = collect(study, p, &found);
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
                     p->measure, koksma__spearman(found.x, found.y, found.n));
    const koksma__chart chart = {title, p->measure, "mean absolute error", true, true, n, series, found.n - n};
    koksma__html_chart(to->html, &chart);
    free(series);
    to->left--;
    return KOKSMA_OK;
}

koksma_status koksma__answer_correlation(koksma_study *study, koksma__html *h, const koksma__topic *topic)
{
    koksma__grid grid;
    koksma__html list = {0};
    koksma__rho_means s = {0};
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
    koksma_status status = visit_all(study, topic, list_row, &l);
    koksma__grid_close(&grid);
    if (!status && s.n) {
        koksma__rho_order(&s);
        status = koksma__rho_sentence(h, &s);
        add_limits(h, topic, &s);
        status = status ? status : koksma__rho_table(h, topic->id, &s);
        koksma__html_add(h, "<details><summary>Every case, with intervals</summary>\n%s</details>\n",
                         list.text ? list.text : "");
        koksma__html_add(h, "<div class=\"figures\">\n");
        plots to = {h, s.of[0].measure, 6};
        status = status ? status : visit_all(study, topic, add_scatter, &to);
        koksma__html_add(h, "</div>\n");
    }
    h->failed |= list.failed;
    free(list.text);
    koksma__rho_fini(&s);
    return status;
}
