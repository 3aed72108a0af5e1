/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_STUDY_TABLES_H
#define KOKSMA_STUDY_TABLES_H

#include "study/statistics.h"
#include "study/study.h"

/* One cell triple of a table. */
typedef struct koksma__cell {
    koksma__summary mean; /* of the trials' means (images) or values (discrepancies) */
    double sd;            /* mean of the trials' SDs (images), SD of the values (discrepancies) */
    double max, max_sd;   /* of the trials' maxima (images), of the largest of 100 values (discrepancies) */
} koksma__cell;

/* The results of a series that the store has, of trials below `trials`; *results is the caller's. */
koksma_status koksma__series_results(koksma_study *study, const koksma__series *series, long long trials,
                                     koksma__result **results, size_t *n);

/* The summary of the values of a pattern's point sets: of one that has no other set, exact. */
koksma__summary koksma__summarize_sets(const char *pattern, const koksma__result *results, size_t n);

/* The block that makes an image table. */
const koksma__image_block *koksma__table_images(const koksma_study *study, const koksma__table *table);

koksma_status koksma__table_discrepancy(koksma_study *study, const koksma__table *table, const char *measure,
                                        const char *pattern, koksma__cell *cell);
koksma_status koksma__table_image(koksma_study *study, const koksma__table *table, const koksma__reference *reference,
                                  const char *pattern, koksma__cell *cell);

/* The most sets that a pattern of the table has, and whether those that have more than one set differ in it. */
koksma_status koksma__table_sets(koksma_study *study, const koksma__table *table, size_t *most, bool *differ);

#endif
