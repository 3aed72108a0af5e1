/* SPDX-License-Identifier: Apache-2.0 */
/* Prints help texts in lines of at most 80 columns. */
#ifndef KOKSMA_CLI_PARAGRAPHS_H
#define KOKSMA_CLI_PARAGRAPHS_H

#include <stdbool.h>
#include <stddef.h>

enum { CLI_PARAGRAPH = 2048 };

/* Prints the words of `text` on stdout and ends the line. column: where the cursor is; indent: the column where
   further lines begin. */
void cli_fill(const char *text, size_t column, size_t indent);

/* Prints one usage of a synopsis like cli_fill, but keeps text in brackets, and an option with its argument, on one
   line. */
void cli_fill_use(const char *use, size_t column, size_t indent);

/* Returns whether a line begins with a word that ends in a colon. */
bool cli_is_heading(const char *line);

/* Copies the next paragraph of a text, as one line. A paragraph ends at an empty line, or before a line whose first
   word is a heading, "word:". *apart: whether an empty line precedes the paragraph. Returns the text that follows,
   or NULL past the end. */
const char *cli_next_paragraph(const char *text, char paragraph[CLI_PARAGRAPH], bool *apart);

#endif
