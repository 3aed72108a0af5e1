/* SPDX-License-Identifier: Apache-2.0 */
/* Tests which combination of measures predicts the error in scenes that it was not fitted to: collects the cases of
   a question, and writes their table and sentence. */
#ifndef KOKSMA_STUDY_REPORT_COMBINATIONS_H
#define KOKSMA_STUDY_REPORT_COMBINATIONS_H

#include "stats/stats.h"
#include "study/report/cases.h"

/* A case, with the ranks of the measures that were visited so far. */
typedef struct koksma__combined {
    const char *scene, *variant;
    long long spp;
    size_t n, n_measures;  /* number of patterns; number of measures added so far */
    const char **patterns; /* n names */
    double *ranks;         /* ranks of the measures, in the layout of koksma__rank_case */
} koksma__combined;

typedef struct koksma__combinations {
    const koksma__cases *cases;
    size_t n;
    koksma__combined *of;
} koksma__combinations;

/* Adds a measure of a case. All measures of a case must be added one after another, in their order. Errors:
   MEMORY. */
koksma_status koksma__combinations_add(koksma__combinations *c, const koksma__case *at, const koksma__pairs *found);

/* Appends the sentence and the table. Appends nothing unless there are two or more measures, and three or more
   scenes with cases whose patterns have all measures. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__combinations_report(koksma__document *d, const char *id, const koksma__combinations *c);

void koksma__combinations_fini(koksma__combinations *c);

#endif
