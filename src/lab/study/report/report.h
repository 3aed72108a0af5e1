/* SPDX-License-Identifier: Apache-2.0 */
/* The sections of a report; each is a line of sections.def and a file of sections/. */
#ifndef KOKSMA_STUDY_REPORT_REPORT_H
#define KOKSMA_STUDY_REPORT_REPORT_H

#include "study/report/document.h"
#include "study/run/study.h"

/* The data that a section is written from. */
typedef struct koksma__report_scope {
    koksma_study *study;
    char rows[KOKSMA__SHA256_TEXT]; /* SHA-256 of all rows of the store (export.h) */
    size_t plan;                    /* index of the plan that a section with of_each_plan is about */
} koksma__report_scope;

typedef struct koksma__section {
    const char *heading;
    bool of_each_plan; /* the section is written once for every plan of the study */
    bool (*is_shown)(const koksma__report_scope *scope);
    koksma_status (*write)(const koksma__report_scope *scope,
                           koksma__document *d); /* writes the section's content, below its heading */
} koksma__section;

/* The plan that a section with of_each_plan is about. */
static inline const koksma__plan_part *koksma__plan_of(const koksma__report_scope *scope)
{
    return &scope->study->plan.parts[scope->plan];
}

#endif
