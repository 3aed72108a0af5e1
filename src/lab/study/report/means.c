/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads every number of a report that comes from the store: looks a series up by its key, reads its trials below the
 * plan's number of trials, and sums them up as a mean with an interval (koksma__summarize_sizes). Nothing is cached between
 * calls, because SQLite caches the pages of the store.
 */
#include "study/report/means.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "study/run/references.h"
#include "study/run/tasks.h"

koksma_status koksma__report_goes_on(const koksma_study *study)
{
    return koksma__ask(study->report);
}

koksma_status koksma__series_results(koksma_study *study, const koksma__series *series, long long trials,
                                     koksma__result **results, size_t *n)
{
    long long id;
    koksma_status status = koksma__report_goes_on(study);
    status = status ? status : koksma__store_series(study->store, series, false, &id);
    status = status ? status : koksma__store_results(study->store, id, trials, results, n);
    if (!status && !*results) {
        *results = calloc(1, sizeof **results);
        status = *results ? KOKSMA_OK : koksma__fail_memory(sizeof **results);
    }
    return status;
}

koksma__summary koksma__summarize_sets(const char *pattern, const koksma__result *results, size_t n)
{
    return n == 1 && koksma__has_one_set(pattern)
               ? koksma__exactly(results->values[0])
               : koksma__summarize_sizes(results->values, n, KOKSMA__RESULT_STRIDE);
}

/* sets: whether the results of the series are those of point sets. A deterministic pattern has one point set, whose
   value is exact, but its images differ between trials. */
static koksma_status mean_of(koksma_study *study, const koksma__series *series, bool sets, long long trials,
                             koksma__result **results, koksma__summary *mean)
{
    koksma__result *found;
    size_t n;
    KOKSMA__TRY(koksma__series_results(study, series, trials, &found, &n));
    *mean = sets ? koksma__summarize_sets(series->pattern, found, n)
                 : koksma__summarize_sizes(found->values, n, KOKSMA__RESULT_STRIDE);
    if (results) {
        *results = found;
    } else {
        free(found);
    }
    return KOKSMA_OK;
}

koksma_status koksma__discrepancy_mean(koksma_study *study, const koksma__discrepancy_block *block, const char *warp,
                                       const char *pattern, long long n, const char *measure,
                                       koksma__result **results, koksma__summary *mean)
{
    const koksma__series series = {.kind = "discrepancy",
                                   .scene = "",
                                   .scene_hash = "",
                                   .options = warp,
                                   .pattern = pattern,
                                   .what = measure,
                                   .n = n,
                                   .dim = block->dim};
    return mean_of(study, &series, true, block->trials, results, mean);
}

/* The key of the images' rows of a kind; `name` holds a text that the key points to. */
static koksma__series series_of(koksma_study *study, const koksma__image_mean *of, const char *kind,
                                const char *metric, char name[KOKSMA__REFERENCE_NAME])
{
    const koksma__study_scene *s = koksma__study_scene_of(study, of->scene);
    int width, height;
    koksma__block_size(of->block, s, &width, &height);
    koksma__reference_name(&of->block->references[of->block->n_references - 1], name);
    return (koksma__series){.kind = kind,
                            .metric = metric,
                            .scene = s->name,
                            .scene_hash = s->hash,
                            .options = of->variant,
                            .pattern = of->pattern,
                            .what = name,
                            .n = of->spp,
                            .width = width,
                            .height = height};
}

koksma_status koksma__image_mean_by(koksma_study *study, const koksma__image_mean *of, const char *metric,
                                    koksma__result **results, koksma__summary *mean)
{
    char name[KOKSMA__REFERENCE_NAME];
    const bool in_image = !strcmp(metric, KOKSMA__DEFAULT_METRIC); /* mae is the value of rows of kind "image" */
    const koksma__series series = series_of(study, of, in_image ? "image" : "metric", in_image ? "" : metric, name);
    return mean_of(study, &series, false, of->block->trials, results, mean);
}

koksma_status koksma__image_metric(koksma_study *study, const koksma__image_mean *of, const char *metric,
                                   koksma__metric_means *out)
{
    char name[KOKSMA__REFERENCE_NAME];
    koksma__result *results;
    size_t n;
    const koksma__series series = series_of(study, of, "metric", metric, name);
    KOKSMA__TRY(koksma__series_results(study, &series, of->block->trials, &results, &n));
    out->robust = koksma__summarize_sizes(&results->values[1], n, KOKSMA__RESULT_STRIDE);
    out->top_share = koksma__summarize_sizes(&results->values[2], n, KOKSMA__RESULT_STRIDE);
    free(results);
    return koksma__image_mean_by(study, of, metric, NULL, &out->value);
}

koksma_status koksma__reference_error(koksma_study *study, const koksma__image_block *block, const char *scene,
                                      const char *variant, double *error)
{
    size_t index;
    char name[KOKSMA__REFERENCE_NAME];
    koksma__reference_row row = {.standard_error = NAN};
    koksma_status status = koksma__reference_index(study, block, koksma__study_scene_of(study, scene), variant,
                                                   block->n_references - 1, &index);
    if (!status) {
        const koksma__series key = koksma__reference_key(&study->references[index], name);
        status = koksma__store_reference(study->store, &key, &row);
    }
    *error = row.standard_error;
    return status;
}

koksma_status koksma__say_reference(koksma_study *study, koksma__document *d, const koksma__image_block *block,
                                    const char *scene, const char *variant, const char *metric)
{
    double error;
    const koksma__reference *r = &block->references[block->n_references - 1];
    const koksma_status status = koksma__reference_error(study, block, scene, variant, &error);
    koksma__doc_paragraph_begin(d);
    koksma__doc_say(
        d,
        "Errors by `%s` against the reference _%s_, the mean of %lld render%s with %lld samples a pixel of "
        "%s; ",
        metric, r->name, r->replicates, koksma__plural((double)r->replicates), r->spp, r->pattern);
    if (isfinite(error)) {
        koksma__doc_say(d, "its own error is about %.2g", error);
        if (strcmp(metric, KOKSMA__DEFAULT_METRIC) != 0) {
            koksma__doc_say(d, " by `%s`", KOKSMA__DEFAULT_METRIC);
        }
    } else {
        koksma__doc_say(d, "its own error is not known");
    }
    koksma__doc_say(d, ". Up to %lld trial%s.", block->trials, koksma__plural((double)block->trials));
    if (block->n_references > 1) {
        koksma__doc_say(d, " `koksma study export` also writes the errors against the plan's other references.");
    }
    koksma__doc_paragraph_end(d);
    return status;
}

void koksma__case_name(const char *scene, const char *variant, char *text, size_t size)
{
    snprintf(text, size, "%s%s%s", scene, variant[0] ? ", " : "", variant);
}

koksma__estimate koksma__estimate_of(const koksma__summary *s)
{
    return (koksma__estimate){s->mean, s->low, s->high};
}
