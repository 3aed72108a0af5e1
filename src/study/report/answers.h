/* SPDX-License-Identifier: Apache-2.0 */
/* The questions of a report: tables, charts and a sentence, from the rows that the store has. */
#ifndef KOKSMA_STUDY_REPORT_ANSWERS_H
#define KOKSMA_STUDY_REPORT_ANSWERS_H

#include "study/report/published_tables.h"
#include "study/report/report_chart.h"
#include "study/report/report_table.h"

enum { KOKSMA__RESULT_STRIDE = sizeof(koksma__result) / sizeof(double) };

/* A question with its blocks. */
typedef struct koksma__topic {
    const char *id;
    const koksma__discrepancy_block **discrepancies; /* room for all of the plan */
    const koksma__image_block **images;
    size_t n_discrepancies, n_images;
    size_t n_groups; /* of scenes, of the question */
    const koksma__scene_group *groups;
} koksma__topic;

/* Appends all questions of the plan; of a plan without tables and questions, those that its blocks can answer. */
koksma_status koksma__report_questions(koksma_study *study, koksma__html *html);

koksma_status koksma__answer_correlation(koksma_study *study, koksma__html *html, const koksma__topic *topic);
koksma_status koksma__answer_slopes(koksma_study *study, koksma__html *html, const koksma__topic *topic);
koksma_status koksma__answer_equal(koksma_study *study, koksma__html *html, const koksma__topic *topic);
koksma_status koksma__answer_options(koksma_study *study, koksma__html *html, const koksma__topic *topic);
koksma_status koksma__answer_table(koksma_study *study, koksma__html *html, const koksma__topic *topic);
koksma_status koksma__answer_inequality(koksma_study *study, koksma__html *html, const koksma__topic *topic);

/* Results of one point of a block; `results` (may be NULL) is the caller's. Of an image against the last reference.
 */
koksma_status koksma__discrepancy_mean(koksma_study *study, const koksma__discrepancy_block *block, const char *warp,
                                       const char *pattern, long long n, const char *measure,
                                       koksma__result **results, koksma__summary *mean);
koksma_status koksma__image_mean(koksma_study *study, const koksma__image_block *block, const char *scene,
                                 const char *variant, const char *pattern, long long spp, koksma__result **results,
                                 koksma__summary *mean);

/* "checker, filter=tent" */
void koksma__case_name(const char *scene, const char *variant, char *text, size_t size);

/* A sentence on what the errors of a case are against: the block's last reference. */
koksma_status koksma__add_reference(koksma_study *study, koksma__html *html, const koksma__image_block *block,
                                    const char *scene, const char *variant);

koksma__estimate koksma__estimate_of(const koksma__summary *summary);

#endif
