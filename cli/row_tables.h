/* SPDX-License-Identifier: Apache-2.0 */
/* Rows with the same keys, as a table: shared by the text that people read and the tables for other programs. */
#ifndef CLI_ROW_TABLES_H
#define CLI_ROW_TABLES_H

#include <string.h>

#include "cli.h"

enum { CLI_MOST_COLUMNS = 64, CLI_GAP = 2 }; /* CLI_GAP: blanks between columns */

typedef enum cli_cell_kind { CLI_WORDS, CLI_FIGURE, CLI_LITERAL } cli_cell_kind; /* CLI_LITERAL: JSON as it stands */

typedef struct cli_cell {
    char *key, *text;
    cli_cell_kind kind;
} cli_cell;

typedef enum cli_column_state { CLI_SHOWN, CLI_COMMON, CLI_LEFT_OUT } cli_column_state;

typedef struct cli_block {
    const cli_cell *cells;
    size_t columns, rows;
    int widths[CLI_MOST_COLUMNS];
    cli_column_state states[CLI_MOST_COLUMNS];
} cli_block;

static inline const cli_cell *cli_cell_at(const cli_block *b, size_t row, size_t column)
{
    return &b->cells[row * (b->columns + 1) + column];
}

/* Returns the width of UTF-8 text in terminal columns: the number of bytes that begin a character. */
int cli_width_of(const char *text, size_t length);

/* Makes each column as wide as its widest text. Returns the total width of the columns. */
int cli_measure_columns(cli_block *b);

/* Chooses the columns that fit the width, and divides the width that remains among the columns of text. */
void cli_fit_columns(cli_block *b, int width);

/* Prints rows as CSV, or as a tabular of booktabs, which has the columns that a page shows as text; those that are the
   same in all rows, and those that don't fit, are comments. A tabular of measures has a row for each source and a column
   for each measure, unless `is_long`. first: the first table of the output. */
void cli_print_foreign(cli_block *b, bool latex, bool is_long, bool first);

#endif
