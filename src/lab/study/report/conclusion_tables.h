/* SPDX-License-Identifier: Apache-2.0 */
/* The means that conclusions are tested with, and the names of patterns as the paper has them. */
#ifndef KOKSMA_STUDY_REPORT_CONCLUSION_TABLES_H
#define KOKSMA_STUDY_REPORT_CONCLUSION_TABLES_H

#include "study/report/published_tables.h"
#include "study/run/study.h"

/* The means of a table's rows for the patterns of a list, at column number k: ours[i], in print[i], and the summaries of
   ours. NaN: none. Unless `of` is NULL, of[i] is our summary. */
koksma_status koksma__conclusion_means(koksma_study *study, const koksma__table *table, const koksma__texts *patterns,
                                       size_t k, double *ours, double *in_print, koksma__summary *of);

/* The table of a conclusion's plan with this id. */
const koksma__table *koksma__conclusion_table(const koksma_study *study, const koksma__conclusion *c, const char *id);

/* The label of a pattern in the first table of the conclusion's plan that has it, or the pattern. */
const char *koksma__conclusion_label(const koksma_study *study, const koksma__conclusion *c, const char *pattern);

#endif
