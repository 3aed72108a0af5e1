/* SPDX-License-Identifier: Apache-2.0 */
/* Published tables in a report: what images' and discrepancies' have in common. */
#ifndef KOKSMA_STUDY_REPORT_TABLES_H
#define KOKSMA_STUDY_REPORT_TABLES_H

#include "study/grid.h"
#include "study/report.h"
#include "study/tables.h"

/* The heads of the CSV's first columns, too. */
void koksma__table_begin(koksma__html *html, koksma__html *csv, const koksma__table *table);

/* The label and what is published; in the CSV the pattern besides. */
void koksma__table_begin_row(koksma__html *html, koksma__html *csv, const koksma__table *table,
                             const koksma__table_row *row);

/* A cell's mean with its interval, SD and largest value; and the heads of such. */
void koksma__table_csv_cell(koksma__html *csv, const koksma__cell *cell);
void koksma__table_csv_heads(koksma__html *csv, const char *of);

/* "0.0123 ± 0.0004" with so many digits: significant ones, or behind the point; no interval of one trial. */
void koksma__table_add_mean(koksma__html *html, const koksma__summary *mean, int digits, bool behind_point);

void koksma__table_add_number(koksma__html *html, double value, int digits, bool behind_point);

/* How the published mean goes with ours: it agrees or doesn't, or has a note; or there is none, or none of ours yet.
 */
void koksma__table_judge(koksma__html *html, koksma__tally *tally, const koksma__table *table,
                         const koksma__table_row *row, size_t trials, bool good, const char *text);

/* Ends the table: the CSV and the notes. */
void koksma__table_end(koksma__html *html, koksma__html *csv, const koksma__table *table);

koksma_status koksma__report_discrepancy_table(koksma_study *study, koksma__html *html, koksma__tally *tally,
                                               const koksma__table *table);
koksma_status koksma__report_image_table(koksma_study *study, koksma__html *html, koksma__tally *tally,
                                         const koksma__table *table);

/* Published means are of 100 sets; |z| below this is chance. */
static const double KOKSMA__AGREEMENT_Z = 2.6;

#endif
