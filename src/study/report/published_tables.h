/* SPDX-License-Identifier: Apache-2.0 */
/* The published tables of a plan: cells of the store, verdicts on printed means. */
#ifndef KOKSMA_STUDY_REPORT_PUBLISHED_TABLES_H
#define KOKSMA_STUDY_REPORT_PUBLISHED_TABLES_H

#include "stats/statistics.h"
#include "study/run/study.h"

/* One cell triple of a table. */
typedef struct koksma__cell {
    koksma__summary mean; /* of the trials' means (images) or values (discrepancies) */
    double sd;            /* mean of the trials' SDs (images), SD of the values (discrepancies) */
    double max, max_sd;   /* of the trials' maxima (images), of the largest of 100 values (discrepancies) */
} koksma__cell;

/* The block that makes an image table. */
const koksma__image_block *koksma__table_images(const koksma_study *study, const koksma__table *table);

koksma_status koksma__table_discrepancy(koksma_study *study, const koksma__table *table, const char *measure,
                                        const char *pattern, long long n, koksma__cell *cell);
koksma_status koksma__table_image(koksma_study *study, const koksma__table *table, const koksma__reference *reference,
                                  const char *pattern, koksma__cell *cell);

/* ---- Agreement of a published mean with ours ------------------------------------------------------------- */

/* Published means of discrepancies are of 100 sets; |z| below this is chance. */
static const double KOKSMA__AGREEMENT_Z = 2.6;

/* How far the mean of an image table may be from the printed one: the scenes are stand-ins. */
static const double KOKSMA__IMAGE_TOLERANCE = 0.25;

typedef struct koksma__verdict {
    koksma_study_verdict kind;
    double z;     /* discrepancies: printed - ours over the standard error of both and half of the last digit */
    double ratio; /* images: ours / printed - 1 */
    size_t note;  /* number of the note on the cell, from 1; 0: none */
} koksma__verdict;

/* Judges column `column` of the row (0: the mean; of a table over several n, the n of that index). */
koksma__verdict koksma__table_judge(const koksma__table *table, const koksma__table_row *row, size_t column,
                                    const koksma__cell *cell);

/* The number of the note on a cell, from 1, or 0; n: of a table over several n, else 0. */
size_t koksma__table_note(const koksma__table *table, const char *pattern, long long n, int statistic);

/* Slope in log-log of the printed ends of a row of a table over several n; NaN where an end is not printed. */
double koksma__table_printed_slope(const koksma__table *table, const koksma__table_row *row);

/* The most sets that a pattern of the table has, and whether those that have more than one set differ in it. */
koksma_status koksma__table_sets(koksma_study *study, const koksma__table *table, size_t *most, bool *differ);

#endif
