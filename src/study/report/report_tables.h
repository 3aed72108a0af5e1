/* SPDX-License-Identifier: Apache-2.0 */
/* Published tables in a report: what images' and discrepancies' have in common. */
#ifndef KOKSMA_STUDY_REPORT_REPORT_TABLES_H
#define KOKSMA_STUDY_REPORT_REPORT_TABLES_H

#include "study/report/published_tables.h"
#include "study/report/report.h"
#include "study/report/report_table.h"

/* The table's heading and the start of its element. */
void koksma__table_open(koksma__html *html, const koksma__table *table);

/* The same, and the heads of the CSV's first columns. */
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

/* A printed number, with the number of its note; a dash where nothing is printed. */
void koksma__table_add_printed(koksma__html *html, const koksma__printed *printed, size_t note);

/* How the printed mean goes with ours, counted in *agreement: as text, where the
   number (z, or per cent) may be left to a tooltip, and as a cell of its own. */
void koksma__table_add_judgement(koksma__html *html, koksma__agreement *agreement, const koksma__verdict *verdict,
                                 bool with_number);
void koksma__table_add_verdict(koksma__html *html, koksma__agreement *agreement, const koksma__verdict *verdict);

/* The z of a table taken together: many that are each within chance can be beyond it, all to one side or all large.
   Those of cells that differ for a known reason are left out. */
typedef struct koksma__z_sums {
    size_t count;
    double sum, squares;
} koksma__z_sums;

void koksma__table_add_z(koksma__z_sums *sums, const koksma__verdict *verdict, const koksma__cell *cell);
void koksma__table_end_z(koksma__html *html, const koksma__z_sums *sums);

/* Ends the table: the CSV and the notes. */
void koksma__table_end(koksma__html *html, koksma__html *csv, const koksma__table *table);

koksma_status koksma__report_discrepancy_table(koksma_study *study, koksma__html *html, koksma__agreement *agreement,
                                               const koksma__table *table);
koksma_status koksma__report_image_table(koksma_study *study, koksma__html *html, koksma__agreement *agreement,
                                         const koksma__table *table);

/* The patterns by their mean rank over the image tables of a plan, beside the overall order that is printed. */
koksma_status koksma__report_order(koksma_study *study, koksma__html *html, size_t part);

/* A table whose columns are numbers of points, with the slopes of its rows and a chart (report_sizes.c). */
koksma_status koksma__report_sizes_table(koksma_study *study, koksma__html *html, koksma__agreement *agreement,
                                         const koksma__table *table);

#endif
