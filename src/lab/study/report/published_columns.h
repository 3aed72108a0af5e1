/* SPDX-License-Identifier: Apache-2.0 */
/* Columns and cells that all published tables of a report have in common. */
#ifndef KOKSMA_STUDY_REPORT_PUBLISHED_COLUMNS_H
#define KOKSMA_STUDY_REPORT_PUBLISHED_COLUMNS_H

#include "study/report/document.h"
#include "study/report/published_tables.h"

/* Begins the section of a table, with the heading "Table 1: title", and the table itself. */
void koksma__published_begin(koksma__document *d, const koksma__table *table);

/* Ends the table and writes its notes. The section stays open for further paragraphs. */
void koksma__published_end(koksma__document *d, const koksma__table *table);

/* Write the columns, or the cells of a row, for the label, the pattern, and the published mean, SD and maximum.
   group: the common head of the published numbers. */
void koksma__published_columns(koksma__document *d, const char *group);
void koksma__published_row(koksma__document *d, const koksma__table *table, const koksma__table_row *row);

/* Writes a cell with a number as published, and its note; a dash if the paper has no number there. */
void koksma__published_cell(koksma__document *d, const koksma__printed *printed, size_t note);

/* Writes a cell with our mean, the number of sets over which it is taken (0: not shown), and the verdict on the
   published mean (NULL: no verdict). */
void koksma__published_mean(koksma__document *d, const koksma__summary *mean, size_t sets,
                            const koksma__verdict *verdict);

/* Writes a cell that has a verdict only. */
void koksma__published_verdict(koksma__document *d, const koksma__verdict *verdict);

/* Sums over the z-values of a table. Chance may explain each z alone but not all of them together, for example if all
   have the same sign or all are large. Cells that differ for a known reason do not count. */
typedef struct koksma__z_sums {
    size_t count;
    double sum, squares;
} koksma__z_sums;

/* Adds the z-value of a cell to the sums, unless the cell differs for a known reason. */
void koksma__published_add_z(koksma__z_sums *sums, const koksma__verdict *verdict, const koksma__cell *cell);

/* Whether the means deviate to one side, or the values of z fail any of the two tests, each at 5 %: the sum over the
   root of their number, and the sum of squares. */
bool koksma__z_deviates(const koksma__z_sums *sums);
bool koksma__z_fails(const koksma__z_sums *sums);

/* Writes a paragraph on the z-values of a table together, if there are two or more. */
void koksma__published_say_z(koksma__document *d, const koksma__z_sums *sums);

#endif
