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

/* The columns of a stream's terminal, or those of COLUMNS there; 0: it is no terminal. */
int cli_terminal_width(int stream);

/* A row ends at a cell with a NULL key. width: 0 for as wide as it is. */
void cli_table_print(const cli_cell *cells, size_t n, int width);

#endif
