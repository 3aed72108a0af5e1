/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads every number of a report that comes from the store: looks a series up by its key, reads its trials below the
 * plan's number of trials, and sums them up as a mean with an interval. Nothing is cached between
 * calls, because SQLite caches the pages of the store. The summaries are not SQL's: sums are compensated, in the order of
 * the trials, so that equal rows give equal bits on all machines.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/parallel.h"
#include "core/status.h"
#include "study/report/report.h"
#include "study/run/references.h"

/* ---- The report's status and memory ------------------------------------------------------------------------ */

bool koksma__report_keep(koksma__report *r, koksma_status status)
{
    r->status = r->status ? r->status : status;
    return !r->status;
}

bool koksma__report_goes_on(koksma__report *r)
{
    return !r->status && koksma__report_keep(r, koksma__ask(r->run));
}

void *koksma__report_memory(koksma__report *r, size_t n, size_t size)
{
    void **slot = r->status ? NULL : koksma__add_one(&r->memory, &r->n_memory, sizeof *slot);
    if (!slot) {
        koksma__report_keep(r, KOKSMA_MEMORY);
        return NULL;
    }
    *slot = calloc(n + 1, size);
    if (!*slot) {
        koksma__report_keep(r, koksma__fail_memory(n * size));
    }
    return *slot;
}

void *koksma__report_add(koksma__report *r, void *items, size_t *n, size_t size)
{
    void **list = items;
    if (!(*n & (*n - 1))) { /* a power of 2, or 0: the list is full */
        void *more = koksma__report_memory(r, 2 * *n, size);
        if (!more) {
            return NULL;
        }
        memcpy(more, *n ? *list : more, *n * size);
        *list = more;
    }
    return (char *)*list + size * (*n)++;
}

void koksma__report_release(koksma__report *r)
{
    while (r->n_memory) {
        free(r->memory[--r->n_memory]);
    }
    free(r->memory);
    r->memory = NULL;
}

/* ---- Subjects ---------------------------------------------------------------------------------------------- */

void koksma__case_name(const char *scene, const char *variant, char *text, size_t size)
{
    snprintf(text, size, "%s%s%s", scene, variant[0] ? ", " : "", variant);
}

koksma__subject koksma__subject_of_points(const koksma__discrepancy_block *block, const char *measure,
                                          const char *warp)
{
    koksma__subject s = {
        .points = block, .measure = measure, .warp = warp, .patterns = &block->patterns, .n = &block->n};
    koksma_spec spec;
    s.larger = !koksma_measure_spec(measure, &spec) && spec.measure->larger_is_better;
    const int length = snprintf(s.name, sizeof s.name, "%s", measure);
    if (block->dim != 2) {
        snprintf(s.name + length, sizeof s.name - (size_t)length, ", %dD", block->dim);
    } else if (warp[0]) {
        snprintf(s.name + length, sizeof s.name - (size_t)length, " through %.40s", warp);
    }
    return s;
}

koksma__subject koksma__subject_of_images(const koksma__image_block *block, const char *scene, const char *variant,
                                          const char *metric)
{
    koksma__subject s = {.images = block,
                         .scene = scene,
                         .variant = variant,
                         .metric = metric,
                         .reference = &block->references[block->n_references - 1],
                         .patterns = &block->patterns,
                         .n = &block->spp};
    koksma__case_name(scene, variant, s.name, sizeof s.name);
    return s;
}

bool koksma__topic_subject(const koksma__topic *t, size_t i, bool by_warp, koksma__subject *out)
{
    for (size_t b = 0; b < t->n_discrepancies; b++) {
        const koksma__discrepancy_block *d = t->discrepancies[b];
        const size_t warps = d->warps.n ? d->warps.n : 1, measures = d->measures.n;
        if (i < warps * measures) {
            const char *warp = !d->warps.n ? "" : d->warps.at[by_warp ? i % warps : i / measures];
            *out = koksma__subject_of_points(d, d->measures.at[by_warp ? i / warps : i % measures], warp);
            return true;
        }
        i -= warps * measures;
    }
    for (size_t b = 0; b < t->n_images; b++) {
        const koksma__image_block *block = t->images[b];
        const size_t variants = block->variants.n, n = block->scenes.n * variants;
        if (i < n) {
            *out = koksma__subject_of_images(block, block->scenes.at[i / variants], block->variants.at[i % variants],
                                             t->metric);
            return true;
        }
        i -= n;
    }
    return false;
}

/* ---- Means ------------------------------------------------------------------------------------------------- */

koksma__result *koksma__read_results(koksma__report *r, const koksma__series *series, long long trials, size_t *n)
{
    long long id;
    koksma__result *results = NULL;
    *n = 0;
    if (!koksma__report_goes_on(r) ||
        !koksma__report_keep(r, koksma__store_series(r->study->store, series, false, &id)) ||
        !koksma__report_keep(r, koksma__store_results(r->study->store, id, trials, &results, n))) {
        return NULL;
    }
    if (!results) {
        results = calloc(1, sizeof *results); /* so that NULL is a failure */
        koksma__report_keep(r, results ? KOKSMA_OK : koksma__fail_memory(sizeof *results));
    }
    return results;
}

/* Reads the results of a subject: of its measure, or the images' rows of a kind. */
static koksma__result *read_subject(koksma__report *r, const koksma__subject *s, const char *pattern, long long n,
                                    const char *kind, const char *metric, size_t *count)
{
    char name[KOKSMA__REFERENCE_NAME];
    koksma__series series = {
        .kind = "discrepancy", .scene = "", .scene_hash = "", .options = s->warp, .pattern = pattern, .n = n};
    if (s->points) {
        series.what = s->measure;
        series.dim = s->points->dim;
        return koksma__read_results(r, &series, s->points->trials, count);
    }
    const koksma__study_scene *scene = koksma__study_scene_of(r->study, s->scene);
    int width, height;
    koksma__block_size(s->images, scene, &width, &height);
    koksma__reference_name(s->reference, name);
    series.kind = kind;
    series.metric = metric;
    series.scene = scene->name;
    series.scene_hash = scene->hash;
    series.options = s->variant;
    series.what = name;
    series.width = width;
    series.height = height;
    return koksma__read_results(r, &series, s->images->trials, count);
}

static koksma__summary mean_by(koksma__report *r, const koksma__subject *s, const char *pattern, long long n,
                               const char *metric, koksma__result **results)
{
    size_t count;
    const bool in_image = metric && !strcmp(metric, KOKSMA__DEFAULT_METRIC); /* mae is the value of rows "image" */
    koksma__result *found =
        read_subject(r, s, pattern, n, in_image ? "image" : "metric", in_image ? "" : metric, &count);
    koksma__summary mean = {.mean = NAN};
    if (found) { /* a deterministic pattern has one point set, whose value is exact, but its images differ */
        mean = s->points && count == 1 && koksma__has_one_set(pattern)
                   ? koksma__exactly(found->values[0])
                   : koksma__summarize_sizes(found->values, count, KOKSMA__RESULT_STRIDE);
    }
    if (results) {
        *results = found;
    } else {
        free(found);
    }
    return mean;
}

koksma__summary koksma__read_mean(koksma__report *r, const koksma__subject *s, const char *pattern, long long n,
                                  koksma__result **results)
{
    return mean_by(r, s, pattern, n, s->metric, results);
}

koksma__summary *koksma__read_means(koksma__report *r, const koksma__subject *s)
{
    const size_t sizes = s->n->n;
    koksma__summary *means = koksma__report_memory(r, s->patterns->n * sizes, sizeof *means);
    for (size_t i = 0; means && i < s->patterns->n * sizes; i++) {
        means[i] = koksma__read_mean(r, s, s->patterns->at[i / sizes], s->n->at[i % sizes], NULL);
    }
    return means;
}

size_t koksma__order_means(const double *values, size_t stride, size_t n, bool descending, size_t *order)
{
    size_t known = 0;
    for (size_t i = 0; i < n; i++) {
        const double value = values[stride * i];
        size_t at = i;
        for (; at > 0 && !isnan(value); at--) {
            const int above = koksma__compare(values[stride * order[at - 1]], value);
            if (at <= known && (descending ? -above : above) <= 0) {
                break;
            }
            order[at] = order[at - 1];
        }
        order[at] = i;
        known += !isnan(value);
    }
    return known;
}

koksma__curve koksma__curve_of(koksma__report *r, size_t most)
{
    return (koksma__curve){0, koksma__report_memory(r, most, sizeof(double)),
                           koksma__report_memory(r, most, sizeof(koksma__summary))};
}

void koksma__curve_add(koksma__curve *curve, long long n, koksma__summary mean)
{
    if (curve->y && mean.n && mean.mean > 0) {
        curve->x[curve->n] = (double)n;
        curve->y[curve->n++] = mean;
    }
}

koksma__metric_means koksma__read_metric(koksma__report *r, const koksma__subject *s, const char *pattern,
                                         long long n, const char *metric)
{
    size_t count;
    koksma__metric_means out = {.value = mean_by(r, s, pattern, n, metric, NULL)};
    koksma__result *results = read_subject(r, s, pattern, n, "metric", metric, &count);
    if (results) {
        out.robust = koksma__summarize_sizes(&results->values[1], count, KOKSMA__RESULT_STRIDE);
        out.top_share = koksma__summarize_sizes(&results->values[2], count, KOKSMA__RESULT_STRIDE);
    }
    free(results);
    return out;
}

double koksma__reference_error(koksma__report *r, const koksma__subject *s)
{
    size_t index;
    char name[KOKSMA__REFERENCE_NAME];
    koksma__reference_row row = {.standard_error = NAN};
    const koksma__study_scene *scene = koksma__study_scene_of(r->study, s->scene);
    if (koksma__report_keep(r, koksma__reference_index(r->study, s->images, scene, s->variant,
                                                       s->images->n_references - 1, &index))) {
        const koksma__series key = koksma__reference_key(&r->study->references[index], name);
        koksma__report_keep(r, koksma__store_reference(r->study->store, &key, &row));
    }
    return row.standard_error;
}

koksma__estimate koksma__estimate_of(const koksma__summary *s)
{
    return (koksma__estimate){s->mean, s->low, s->high};
}
