/* SPDX-License-Identifier: Apache-2.0 */
/* What the functions that test conclusions share. */
#ifndef KOKSMA_STUDY_REPORT_CONCLUSIONS_CONCLUSION_H
#define KOKSMA_STUDY_REPORT_CONCLUSIONS_CONCLUSION_H

#include "study/report/document.h"
#include "study/report/published_tables.h"
#include "study/run/study.h"

/* The number of tests that a conclusion passes, of those that its rows allow; rows that are missing count as `open`. */
typedef struct koksma__tested {
    size_t passed, tests, open;
} koksma__tested;

/* Counts a test. */
static inline void koksma__test(koksma__tested *t, bool passes)
{
    t->tests++;
    t->passed += passes;
}

/* The means of a table's rows for the patterns of a list, at column number k: ours[i], in print[i], and the summaries of
   ours. NaN: none. Unless `of` is NULL, of[i] is our summary. */
koksma_status koksma__conclusion_means(koksma_study *study, const koksma__table *table, const koksma__texts *patterns,
                                       size_t k, double *ours, double *in_print, koksma__summary *of);

/* The table of a conclusion's plan with this id. */
const koksma__table *koksma__conclusion_table(const koksma_study *study, const koksma__conclusion *c, const char *id);

/* The label of a pattern in the first table of the conclusion's plan that has it, or the pattern. */
const char *koksma__conclusion_label(const koksma_study *study, const koksma__conclusion *c, const char *pattern);

/* Writes the labels of patterns with "; " between them, because names have commas. */
void koksma__say_patterns(koksma__document *d, const koksma_study *study, const koksma__conclusion *c,
                          const koksma__texts *patterns);

/* Declares the functions. Each appends the words of the result to `words`, in which a paragraph is open, and counts its
   tests. */
#define CONCLUSION(name, fields)                                                                                     \
    koksma_status koksma__conclude_##name(koksma_study *study, koksma__document *words, const koksma__conclusion *c, \
                                          koksma__tested *tested);
#include "study/plan/conclusions.def"
#undef CONCLUSION

#endif
