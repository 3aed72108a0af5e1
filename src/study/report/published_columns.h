/* SPDX-License-Identifier: Apache-2.0 */
/* Columns and cells that all published tables have in common. */
#ifndef KOKSMA_STUDY_REPORT_PUBLISHED_COLUMNS_H
#define KOKSMA_STUDY_REPORT_PUBLISHED_COLUMNS_H

#include "study/report/document.h"
#include "study/report/published_tables.h"

/* The section of a table up to its columns: "Table 1: title". */
void koksma__published_begin(koksma__document *d, const koksma__table *table);

/* Ends the table: its notes. The section stays open for what is said of it. */
void koksma__published_end(koksma__document *d, const koksma__table *table);

/* Label, pattern, and printed mean, SD and maximum: columns, and the cells of a row. group: the head above them. */
void koksma__published_columns(koksma__document *d, const char *group);
void koksma__published_row(koksma__document *d, const koksma__table *table, const koksma__table_row *row);

/* A number as printed, with its note; a dash where nothing is printed. */
void koksma__published_cell(koksma__document *d, const koksma__printed *printed, size_t note);

/* Writes a cell with our mean, the number of sets that it comes from (0: not shown), and the verdict on the
   published mean (NULL: none). */
void koksma__published_mean(koksma__document *d, const koksma__summary *mean, size_t sets,
                            const koksma__verdict *verdict);

/* A verdict in a cell of its own. */
void koksma__published_verdict(koksma__document *d, const koksma__verdict *verdict);

/* Sums over the z-values of a table: each may be within chance while all together are not, because all have one sign
   or all are large. Cells that differ for a known reason are left out. */
typedef struct koksma__z_sums {
    size_t count;
    double sum, squares;
} koksma__z_sums;

void koksma__published_add_z(koksma__z_sums *sums, const koksma__verdict *verdict, const koksma__cell *cell);

/* Says so, of two or more. */
void koksma__published_say_z(koksma__document *d, const koksma__z_sums *sums);

#endif
