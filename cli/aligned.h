/* SPDX-License-Identifier: Apache-2.0 */
/* Prints rows of cells as aligned text, within the width of a terminal. */
#ifndef KOKSMA_CLI_ALIGNED_H
#define KOKSMA_CLI_ALIGNED_H

#include <stdbool.h>
#include <stddef.h>

typedef struct cli_cell {
    char *key, *text;
    bool is_number;
} cli_cell;

/* Returns the width of the terminal that the file descriptor `stream` is connected to, in columns (the environment
   variable COLUMNS overrides it), or 0 if the descriptor is no terminal. */
int cli_terminal_width(int stream);

/* Prints n cells as rows; a cell with a NULL key ends a row. width: the number of columns that rows may take, 0 for
   no limit. */
void cli_table_print(const cli_cell *cells, size_t n, int width);

#endif
