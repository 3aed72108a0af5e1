/* SPDX-License-Identifier: Apache-2.0 */
/* A table of a report, with its own CSV behind a link. */
#ifndef KOKSMA_STUDY_REPORT_REPORT_TABLE_H
#define KOKSMA_STUDY_REPORT_REPORT_TABLE_H

#include "stats/statistics.h"
#include "study/report/html.h"

/* ---- CSV (RFC 4180) ------------------------------------------------------------------------------------- */

/* Cells of a row; NaN is an empty one. */
void koksma__csv_text(koksma__html *csv, const char *text);
void koksma__csv_number(koksma__html *csv, double value);

/* Ends a row. */
void koksma__csv_row(koksma__html *csv);

/* Ends the last row, appends a link with the file inside, and frees it. */
void koksma__csv_close(koksma__html *csv, koksma__html *html, const char *name);

/* ---- Tables with their CSV ------------------------------------------------------------------------------- */

typedef struct koksma__grid {
    koksma__html *html, csv;
    char name[64];
    bool in_body, in_row;
} koksma__grid;

/* Heads come first, then rows; name is the CSV's file name without its ending. */
void koksma__grid_open(koksma__grid *grid, koksma__html *html, const char *name);
void koksma__grid_head(koksma__grid *grid, const char *text);
/* A column with an interval: in the CSV two more columns follow, low and high. */
void koksma__grid_head_interval(koksma__grid *grid, const char *text);
void koksma__grid_row(koksma__grid *grid);
void koksma__grid_text(koksma__grid *grid, const char *text);
void koksma__grid_number(koksma__grid *grid, double value, int digits);
void koksma__grid_interval(koksma__grid *grid, koksma__estimate estimate, int digits);
void koksma__grid_close(koksma__grid *grid);

#endif
