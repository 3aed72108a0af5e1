/* SPDX-License-Identifier: Apache-2.0 */
/* What the functions that test conclusions share. */
#ifndef KOKSMA_STUDY_REPORT_CONCLUSIONS_CONCLUSION_H
#define KOKSMA_STUDY_REPORT_CONCLUSIONS_CONCLUSION_H

#include "study/report/conclusion_tables.h"
#include "study/report/document.h"
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

/* Declares the functions. Each appends the words of the result to `words`, in which a paragraph is open, and counts its
   tests. */
#define CONCLUSION(name, fields)                                                                                     \
    koksma_status koksma__conclude_##name(koksma_study *study, koksma__document *words, const koksma__conclusion *c, \
                                          koksma__tested *tested);
#include "study/plan/conclusions.def"
#undef CONCLUSION

#endif
