/* SPDX-License-Identifier: Apache-2.0 */
/* Rows of results: JSON lines, printed when a row ends, or aligned text, printed after the last row, when the widths
   of the columns are known. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "aligned.h"
#include "cli.h"

/* Text rows are stored until the end, because a column is as wide as its widest cell. */
struct cli_rows {
    bool json, started, failed;
    cli_cell *cells; /* cells of all rows; a row ends at a cell with a NULL key */
    size_t n, capacity;
};

static int digits = CLI_DIGITS;
static bool is_long;

void cli_set_style(int n_digits, bool all_columns)
{
    digits = n_digits;
    is_long = all_columns;
}

static cli_rows no_rows = {.failed = true}; /* the object that replaces the rows when memory runs out; it ignores all
                                               cells */

cli_rows *cli_rows_open(bool json)
{
    cli_rows *rows = calloc(1, sizeof *rows);
    if (rows) {
        rows->json = json;
    }
    return rows ? rows : &no_rows;
}

/* A copy of a text as one line of valid UTF-8; NULL without memory. */
static char *one_line(const char *text)
{
    const size_t size = 4 * strlen(text) + 1;
    char *line = malloc(size);
    if (line) {
        strcpy(line, text);
        koksma_text_escape(line, size);
    }
    return line;
}

static void push(cli_rows *rows, const char *key, const char *text, bool is_number)
{
    if (rows->failed) {
        return;
    }
    if (rows->n == rows->capacity) {
        const size_t capacity = rows->capacity ? 2 * rows->capacity : 64;
        cli_cell *cells = realloc(rows->cells, capacity * sizeof *cells);
        if (!cells) {
            rows->failed = true;
            return;
        }
        rows->cells = cells;
        rows->capacity = capacity;
    }
    cli_cell *c = &rows->cells[rows->n++];
    *c = (cli_cell){key ? strdup(key) : NULL, text ? one_line(text) : NULL, is_number};
    rows->failed |= (key && !c->key) || (text && !c->text);
}

/* The number of bytes of the character of UTF-8 at `text`; 0 if there is none. koksma_text_escape changes all other
   bytes, and also control characters, which the caller treats before. */
static size_t character_length(const char *text)
{
    const unsigned char c = (unsigned char)*text;
    const size_t length = strnlen(text, c < 0x80 ? 1 : c < 0xe0 ? 2 : c < 0xf0 ? 3 : 4);
    char escaped[32] = "";
    memcpy(escaped, text, length);
    koksma_text_escape(escaped, sizeof escaped);
    return strlen(escaped) == length && !memcmp(escaped, text, length) ? length : 0;
}

/* Writes a text as the library's JSON has it: U+FFFD replaces bytes that are not UTF-8. All control characters are
   escaped, because terminals would execute them. */
static void json_text(const char *text)
{
    putchar('"');
    while (*text) {
        const unsigned char c = (unsigned char)text[0], next = (unsigned char)text[1];
        const bool high = c == 0xc2 && next >= 0x80 && next < 0xa0;
        size_t length = 1;
        if (c == '"' || c == '\\') {
            printf("\\%c", c);
        } else if (c < 0x20 || c == 0x7f || high) {
            printf("\\u%04x", high ? next : c);
            length = 1 + high;
        } else if ((length = character_length(text))) {
            printf("%.*s", (int)length, text);
        } else {
            fputs("\xef\xbf\xbd", stdout);
            length = 1;
        }
        text += length;
    }
    putchar('"');
}

static void json_key(cli_rows *rows, const char *key)
{
    if (!rows->started) {
        cli_work_end();
    }
    fputs(rows->started ? "," : "{", stdout);
    rows->started = true;
    json_text(key);
    putchar(':');
}

void cli_row_text(cli_rows *rows, const char *key, const char *value)
{
    if (rows->json) {
        json_key(rows, key);
        json_text(value);
    } else {
        push(rows, key, value, false);
    }
}

void cli_row_json(cli_rows *rows, const char *key, const char *json, const char *text)
{
    if (rows->json) {
        json_key(rows, key);
        fputs(json, stdout);
    } else {
        push(rows, key, text, false);
    }
}

const char *cli_number(double value, char text[CLI_NUMBER])
{
    const double size = fabs(value);
    const bool whole = size < 1e15 && (value == floor(value) || size >= pow(10, digits));
    if (!isfinite(value)) {
        strcpy(text, "-");
    } else if (whole) {
        snprintf(text, CLI_NUMBER, "%.0f", value + 0.0); /* + 0.0 turns -0 into 0 */
    } else {
        snprintf(text, CLI_NUMBER, "%.*g", digits, value);
    }
    return text;
}

void cli_row_number(cli_rows *rows, const char *key, double value)
{
    char text[CLI_NUMBER];
    if (rows->json) {
        json_key(rows, key);
        snprintf(text, sizeof text, isfinite(value) ? "%.17g" : "null", value);
        fputs(text, stdout);
    } else {
        push(rows, key, cli_number(value, text), true);
    }
}

void cli_row_whole(cli_rows *rows, const char *key, uint64_t value)
{
    char text[24];
    snprintf(text, sizeof text, "%llu", (unsigned long long)value);
    if (rows->json) {
        json_key(rows, key);
        fputs(text, stdout);
    } else {
        push(rows, key, text, true);
    }
}

void cli_row_flag(cli_rows *rows, const char *key, bool value)
{
    cli_row_json(rows, key, value ? "true" : "false", value ? "yes" : "no");
}

void cli_row_end(cli_rows *rows)
{
    if (rows->json) {
        if (rows->started) {
            puts("}");
            fflush(stdout);
        }
        rows->started = false;
    } else {
        push(rows, NULL, NULL, false);
    }
}

int cli_rows_close(cli_rows *rows)
{
    if (!rows->failed && !rows->json) {
        cli_work_end();
        cli_table_print(rows->cells, rows->n, is_long ? 0 : cli_terminal_width(STDOUT_FILENO));
    }
    const bool failed = rows->failed;
    for (size_t i = 0; i < rows->n; i++) {
        free(rows->cells[i].key);
        free(rows->cells[i].text);
    }
    free(rows->cells);
    if (rows != &no_rows) {
        free(rows);
    }
    return failed ? cli_no_memory() : CLI_YES;
}
