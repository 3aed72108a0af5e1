/* SPDX-License-Identifier: Apache-2.0 */
/* The published tables of a plan: their cells from the store, and verdicts on the published means. */
#ifndef KOKSMA_STUDY_REPORT_PUBLISHED_TABLES_H
#define KOKSMA_STUDY_REPORT_PUBLISHED_TABLES_H

#include "stats/stats.h"
#include "study/run/study.h"

/* The mean, SD and maximum of one cell of a table. */
typedef struct koksma__cell {
    koksma__summary mean; /* mean of the trials' mean errors (images) or of the values (discrepancies) */
    double sd;            /* mean of the trials' SDs (images) or SD of the values (discrepancies) */
    double max,
        max_sd; /* mean and SD of the trials' maxima (images) or of the largest of 100 values (discrepancies) */
} koksma__cell;

/* The block that has the results of an image table. */
const koksma__image_block *koksma__table_images(const koksma_study *study, const koksma__table *table);

/* Read a cell of a discrepancy table, or of an image table against one reference, from the store. */
koksma_status koksma__table_discrepancy(koksma_study *study, const koksma__table *table, const char *measure,
                                        const char *pattern, long long n, koksma__cell *cell);
koksma_status koksma__table_image(koksma_study *study, const koksma__table *table, const koksma__reference *reference,
                                  const char *pattern, koksma__cell *cell);

/* ---- Agreement of a published mean with ours ------------------------------------------------------------- */

/* A published mean of discrepancies, which was taken over 100 sets, agrees if |z| is below this limit. */
static const double KOKSMA__AGREEMENT_Z = 2.6;

/* The largest relative difference at which our mean of image errors agrees with the published one; the limit is
   large because our scenes only approximate the paper's. */
static const double KOKSMA__IMAGE_TOLERANCE = 0.25;

typedef struct koksma__verdict {
    koksma_study_verdict kind;
    double z;     /* for discrepancies: (published - ours) / (standard error of both + half of the last digit) */
    double ratio; /* images: ours / published - 1 */
    size_t note;  /* number of the note on the cell, from 1; 0: none */
} koksma__verdict;

/* Judges a published mean of the row. column: the index of n in a table over several n; otherwise 0. */
koksma__verdict koksma__table_judge(const koksma__table *table, const koksma__table_row *row, size_t column,
                                    const koksma__cell *cell);

/* The number of the note on a cell, from 1; 0: no note. n: the column's number of points in a table over several n,
   otherwise 0. */
size_t koksma__table_note(const koksma__table *table, const char *pattern, long long n, int statistic);

/* The log-log slope of the published numbers of a row in a table over several n, by least squares as ours; NaN if one of
   them is missing. */
double koksma__table_printed_slope(const koksma__table *table, const koksma__table_row *row);

/* *most: the largest number of sets that a pattern of the table has; *differ: whether the patterns that are not
   deterministic have different numbers of sets. */
koksma_status koksma__table_sets(koksma_study *study, const koksma__table *table, size_t *most, bool *differ);

#endif
