/* SPDX-License-Identifier: Apache-2.0 */
/* Means of the store's rows over trials, looked up by the names that a plan uses. */
#ifndef KOKSMA_STUDY_REPORT_MEANS_H
#define KOKSMA_STUDY_REPORT_MEANS_H

#include "stats/stats.h"
#include "study/report/document.h"
#include "study/run/study.h"

enum { KOKSMA__RESULT_STRIDE = sizeof(koksma__result) / sizeof(double) };

/* Asks the caller of the report that is being written, if one is, whether to go on. Every loop over what a plan lists that
   reads no results asks, too. Errors: INTERRUPTED. */
koksma_status koksma__report_goes_on(const koksma_study *study);

/* Reads the results of a series from the store, for trials below `trials`. The caller frees *results, which is never
   NULL. Errors: those of the store, MEMORY, INTERRUPTED. */
koksma_status koksma__series_results(koksma_study *study, const koksma__series *series, long long trials,
                                     koksma__result **results, size_t *n);

/* The summary of the values of a pattern's point sets; exact for a deterministic pattern, which has only one set. */
koksma__summary koksma__summarize_sets(const char *pattern, const koksma__result *results, size_t n);

/* The mean of a measure of a block's points. Unless `results` is NULL, *results gets the result of each trial; the
   caller frees them. */
koksma_status koksma__discrepancy_mean(koksma_study *study, const koksma__discrepancy_block *block, const char *warp,
                                       const char *pattern, long long n, const char *measure,
                                       koksma__result **results, koksma__summary *mean);

/* The images of one mean: those of a pattern with `spp` samples a pixel, in all trials of a block. */
typedef struct koksma__image_mean {
    const koksma__image_block *block;
    const char *scene, *variant, *pattern;
    long long spp;
} koksma__image_mean;

/* The mean error of images against the block's last reference, by a metric. `results` has the same meaning as in
   koksma__discrepancy_mean; the error is the first value of each result. If the metric was not measured, mean->n is 0. */
koksma_status koksma__image_mean_by(koksma_study *study, const koksma__image_mean *of, const char *metric,
                                    koksma__result **results, koksma__summary *mean);

/* Means of the members of koksma_metric_value over the images. A summary's n is 0 if the store has no rows for it. */
typedef struct koksma__metric_means {
    koksma__summary value, robust, top_share;
} koksma__metric_means;

koksma_status koksma__image_metric(koksma_study *study, const koksma__image_mean *of, const char *metric,
                                   koksma__metric_means *out);

/* The mean error of the block's last reference itself; NaN: unknown. */
koksma_status koksma__reference_error(koksma_study *study, const koksma__image_block *block, const char *scene,
                                      const char *variant, double *error);

/* Writes a paragraph that names the metric of a case's errors and describes their reference, which is the block's last
   reference. */
koksma_status koksma__say_reference(koksma_study *study, koksma__document *d, const koksma__image_block *block,
                                    const char *scene, const char *variant, const char *metric);

/* Writes the name of a scene with its options, such as "checker, filter=tent". */
void koksma__case_name(const char *scene, const char *variant, char *text, size_t size);

/* The mean of a summary and its interval. */
koksma__estimate koksma__estimate_of(const koksma__summary *summary);

#endif
