/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_STUDY_REPORT_REPORT_H
#define KOKSMA_STUDY_REPORT_REPORT_H

#include "study/report/html.h"
#include "study/run/study.h"

/* How many published means have each verdict. */
typedef struct koksma__agreement {
    size_t of[KOKSMA_VERDICT_UNEXPLAINED + 1];
} koksma__agreement;

/* Appends the figures of one of the study's plans: point sets as SVG, scenes as pixels. */
koksma_status koksma__report_figures(koksma_study *study, koksma__html *html, const koksma__plan_part *part,
                                     const koksma_run *run);

/* Appends one trial of every pattern of the image blocks beside its reference: pictures, error maps, and a comparer.
 */
koksma_status koksma__report_pictures(koksma_study *study, koksma__html *html, const koksma_run *run);

/* When, where and how long. One element, so that reports of the same rows differ in it alone. */
koksma_status koksma__report_runs(koksma_study *study, koksma__html *h);

/* A figure of random lines. */
void koksma__report_lines(koksma__html *h, const koksma__figure *figure, uint64_t seed);

#endif
