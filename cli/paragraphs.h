/* SPDX-License-Identifier: Apache-2.0 */
/* Help texts in lines of at most 80 columns. */
#ifndef KOKSMA_CLI_PARAGRAPHS_H
#define KOKSMA_CLI_PARAGRAPHS_H

#include <stdbool.h>
#include <stddef.h>

enum { CLI_PARAGRAPH = 2048 };

/* Prints words on stdout; `column` is where the cursor is, `indent` where further lines begin. Ends the line. */
void cli_fill(const char *text, size_t column, size_t indent);

/* One use in the words of a synopsis: what is in brackets, and an option with its argument, stays on a line. */
void cli_fill_use(const char *use, size_t column, size_t indent);

/* Whether a line begins with a word and a colon. */
bool cli_is_heading(const char *line);

/* The next paragraph of a text: its lines as one, up to an empty line or one whose first word is a heading, "word:".
   Returns what follows; NULL past the end. *apart: an empty line precedes it. */
const char *cli_next_paragraph(const char *text, char paragraph[CLI_PARAGRAPH], bool *apart);

#endif
