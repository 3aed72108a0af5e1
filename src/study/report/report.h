/* SPDX-License-Identifier: Apache-2.0 */
/* The sections of a report: one line of sections.def and one file of sections/ each. */
#ifndef KOKSMA_STUDY_REPORT_REPORT_H
#define KOKSMA_STUDY_REPORT_REPORT_H

#include "study/report/document.h"
#include "study/run/study.h"

/* What a section is written from. */
typedef struct koksma__report_scope {
    koksma_study *study;
    const koksma_run *run;          /* deadline and cancellation of what has to be rendered again; may be NULL */
    char rows[KOKSMA__SHA256_TEXT]; /* their fingerprint (export.h) */
    size_t plan;                    /* the number of the plan that a section of one plan is about */
} koksma__report_scope;

typedef struct koksma__section {
    const char *heading;
    bool of_each_plan; /* written for every plan of the study, under the plan's title where there are several */
    bool (*is_shown)(const koksma__report_scope *scope);
    koksma_status (*write)(const koksma__report_scope *scope, koksma__document *d); /* what is below the heading */
} koksma__section;

/* The plan that a section of one plan is about. */
static inline const koksma__plan_part *koksma__plan_of(const koksma__report_scope *scope)
{
    return &scope->study->plan.parts[scope->plan];
}

#endif
