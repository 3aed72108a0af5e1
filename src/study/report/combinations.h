/* SPDX-License-Identifier: Apache-2.0 */
/* Which combination of measures predicts the error in scenes that it was not fitted to: the cases of a question, and
   their table and sentence. */
#ifndef KOKSMA_STUDY_REPORT_COMBINATIONS_H
#define KOKSMA_STUDY_REPORT_COMBINATIONS_H

#include "stats/rank_regression.h"
#include "study/report/cases.h"

/* A case as far as its measures were visited. */
typedef struct koksma__combined {
    const char *scene, *variant;
    long long spp;
    size_t n, n_measures;  /* patterns; measures so far */
    const char **patterns; /* n */
    double *ranks;         /* as of koksma__rank_case */
} koksma__combined;

typedef struct koksma__combinations {
    const koksma__cases *cases;
    size_t n, capacity;
    koksma__combined *of;
} koksma__combinations;

/* Adds a measure of a case; measures come in their order, all of a case one after another. Errors: MEMORY. */
koksma_status koksma__combinations_add(koksma__combinations *c, const koksma__case *at, const koksma__pairs *found);

/* Appends sentence and table; nothing unless three scenes have cases whose patterns have all measures, of which there
   are two or more. Errors: MEMORY. */
koksma_status koksma__combinations_report(koksma__document *d, const char *id, const koksma__combinations *c);

void koksma__combinations_fini(koksma__combinations *c);

#endif
