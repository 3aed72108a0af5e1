/* SPDX-License-Identifier: Apache-2.0 */
/* Prints help texts in lines of at most 80 columns, with as many words on a line as fit. A non-breaking blank is
   stored as TIED until it is printed. */
#include "cli.h"

#include <stdio.h>
#include <string.h>

enum { WIDTH = 80, TIED = '\x1f' };

static void put(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        putchar(text[i] == TIED ? ' ' : text[i]);
    }
}

/* Returns how many bytes of a word go on the current line, which has `room` columns left: those up to the last '|'
   that fits, or all. */
static size_t beginning(const char *word, size_t length, size_t room)
{
    for (size_t i = room < length ? room : 0; i > 0; i--) {
        if (word[i - 1] == '|') {
            return i;
        }
    }
    return length;
}

void cli_fill(const char *text, size_t column, size_t indent)
{
    bool first = true; /* the next word is the first of its line */
    for (const char *at = text + strspn(text, " "); *at;) {
        const size_t length = strcspn(at, " ");
        if (!first && column + 1 + length > WIDTH) {
            first = true;
            printf("\n%*s", (int)(column = indent), "");
        } else if (!first) {
            putchar(' ');
            column++;
        }
        const size_t part = beginning(at, length, column < WIDTH ? WIDTH - column : 0);
        put(at, part);
        at += part + strspn(at + part, " ");
        column += part;
        first = false;
        if (part < length) {
            first = true;
            printf("\n%*s", (int)(column = indent), "");
        }
    }
    putchar('\n');
}

void cli_fill_use(const char *use, size_t column, size_t indent)
{
    char tied[CLI_PARAGRAPH];
    int depth = 0;
    bool option = false; /* the current word is an option or its argument */
    size_t i = 0;
    for (; use[i] && use[i] != '\n' && i + 1 < sizeof tied; i++) {
        depth += (use[i] == '[') - (use[i] == ']');
        option = use[i] == '-' && (i == 0 || use[i - 1] == ' ') ? true : option;
        tied[i] = use[i] == ' ' && (depth > 0 || option) ? (char)TIED : use[i];
        option = use[i] == ' ' ? false : option;
    }
    tied[i] = '\0';
    cli_fill(tied, column, indent);
}

bool cli_is_heading(const char *line)
{
    const size_t length = strcspn(line, " \n");
    return length > 1 && line[length - 1] == ':';
}

const char *cli_next_paragraph(const char *text, char paragraph[CLI_PARAGRAPH], bool *apart)
{
    *apart = *text == '\n';
    text += strspn(text, "\n");
    if (!*text) {
        return NULL;
    }
    size_t used = 0;
    do {
        const size_t length = strcspn(text, "\n");
        used +=
            (size_t)snprintf(paragraph + used, CLI_PARAGRAPH - used, "%s%.*s", used ? " " : "", (int)length, text);
        text += length + (text[length] == '\n');
    } while (*text && *text != '\n' && !cli_is_heading(text) && used < CLI_PARAGRAPH - 256);
    return text;
}
