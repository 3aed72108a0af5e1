/* SPDX-License-Identifier: Apache-2.0 */
/* Rows of results: JSON lines, printed when a row ends, or aligned text, printed after the last row, when the widths
   of the columns are known. */
#include "row_tables.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Prints rows as aligned text. Consecutive rows with the same keys form a block, with its own header and column widths. A
   block that is wider than the terminal is made narrower: one of one row is printed as one line per key; in others columns
   with the same text in all rows go into a line above the table. Of the remaining columns those that fit are kept from
   left to right; a column of text needs at least 28 characters and continues longer texts on further lines. A line below
   the table names the columns that are left out. */

static int digits = CLI_DIGITS;
static bool all_columns;
static int format = CLI_TEXT;

/* Returns how many bytes of text go on a line of `width` columns: all of them, or those up to the last blank, comma
   or @ that fits, or as many characters as fit. */
static size_t line_of(const char *text, int width)
{
    size_t end = 0, good = 0;
    for (int used = 0; text[end]; end++) {
        used += ((unsigned char)text[end] & 0xc0) != 0x80;
        good = text[end] == ' ' || text[end] == '@' ? end : good;
        if (used > width) {
            return good ? good : end;
        }
        good = text[end] == ',' ? end + 1 : good;
    }
    return end;
}

/* One cell of an output line: the text that remains to be printed, the column's width, and whether the text is
   right-aligned. */
typedef struct piece {
    const char *text;
    int width;
    bool right;
} piece;

/* Prints one row on as many lines as its longest text needs, without trailing blanks. */
static void print_row(piece *pieces, size_t n)
{
    for (bool more = true; more;) {
        int blanks = 0;
        more = false;
        for (size_t i = 0; i < n; i++) {
            piece *p = &pieces[i];
            const size_t length = line_of(p->text, p->width);
            const int rest = p->width - cli_width_of(p->text, length);
            if (length > 0) {
                printf("%*s%.*s", blanks + (p->right ? rest : 0), "", (int)length, p->text);
                blanks = 0;
            }
            blanks += CLI_GAP + (length > 0 && p->right ? 0 : rest);
            p->text += length + strspn(p->text + length, " ");
            more = more || *p->text;
        }
        putchar('\n');
    }
}

/* Prints the columns in state `which` as a list "key text, key text" (CLI_COMMON, with the texts of the first row) or
   "key, key" (CLI_LEFT_OUT, after `begin`). */
static void print_list(const cli_block *b, const char *begin, cli_column_state which, int width)
{
    int column = 0;
    for (size_t i = 0; i < b->columns; i++) {
        const char *key = b->cells[i].key, *text = which == CLI_COMMON ? b->cells[i].text : "";
        if (b->states[i] != which) {
            continue;
        }
        const int length = cli_width_of(key, strlen(key)) + 1 + cli_width_of(text, strlen(text));
        if (column > 0 && column + 2 + length >= width) {
            puts(",");
            column = 0;
        }
        const char *before = column > 0 ? ", " : which == CLI_LEFT_OUT && *begin ? begin : "";
        column += printf("%s%s%s", before, key, *text ? " " : "");
        begin = "";
        if (column + length > width) {
            putchar('\n');
            print_row(&(piece){text, width, false}, 1);
            column = 0;
        } else {
            column += printf("%s", text);
        }
    }
    printf(column > 0 ? "\n" : "");
}

/* Prints a row as one line per key. */
static void print_record(const cli_block *b, int width)
{
    int keys = 0;
    for (size_t i = 0; i < b->columns; i++) {
        const int length = cli_width_of(b->cells[i].key, strlen(b->cells[i].key));
        keys = length > keys ? length : keys;
    }
    for (size_t i = 0; i < b->columns; i++) {
        print_row((piece[]){{b->cells[i].key, keys, false}, {b->cells[i].text, width - keys - CLI_GAP, false}}, 2);
    }
}

/* Prints the shown columns of a row; row SIZE_MAX is the header. */
static void print_columns(const cli_block *b, size_t row)
{
    piece pieces[CLI_MOST_COLUMNS];
    size_t n = 0;
    for (size_t i = 0; i < b->columns; i++) {
        const cli_cell *c = cli_cell_at(b, row == SIZE_MAX ? 0 : row, i);
        if (b->states[i] == CLI_SHOWN) {
            pieces[n++] = (piece){row == SIZE_MAX ? c->key : c->text, b->widths[i], c->kind == CLI_FIGURE};
        }
    }
    if (n > 0) {
        print_row(pieces, n);
    }
}

static void print_block(cli_block *b, int width)
{
    if (cli_measure_columns(b) > width && width > 0) {
        if (b->rows == 1) {
            print_record(b, width);
            return;
        }
        cli_fit_columns(b, width);
        print_list(b, "", CLI_COMMON, width);
    }
    for (size_t row = 0; row <= b->rows; row++) {
        print_columns(b, row - 1);
    }
    print_list(b, "with --long: ", CLI_LEFT_OUT, width);
}

static size_t columns_of(const cli_cell *row, size_t n)
{
    size_t columns = 0;
    while (columns < n && row[columns].key) {
        columns++;
    }
    if (columns > CLI_MOST_COLUMNS) {
        abort(); /* a command made a row of too many columns, which is a bug */
    }
    return columns;
}

/* Returns whether the cells begin with a row that has the same keys as the row `other`. */
static bool same_keys(const cli_cell *row, size_t n, const cli_cell *other, size_t columns)
{
    for (size_t i = 0; i < columns; i++) {
        if (i >= n || !row[i].key || strcmp(row[i].key, other[i].key) != 0) {
            return false;
        }
    }
    return columns < n && !row[columns].key;
}

/* Prints n cells as rows; a cell with a NULL key ends a row. width: the number of columns that rows may take, 0 for
   no limit. */
static void print_table(const cli_cell *cells, size_t n, int width)
{
    for (size_t start = 0, end; start < n; start = end) {
        cli_block b = {.cells = &cells[start], .columns = columns_of(&cells[start], n - start)};
        for (end = start; same_keys(&cells[end], n - end, b.cells, b.columns); b.rows++) {
            end += b.columns + 1;
        }
        if (format == CLI_TEXT) {
            print_block(&b, width);
        } else {
            cli_print_foreign(&b, format == CLI_LATEX, all_columns, start == 0);
        }
    }
}

/* ---- The rows of a command ----------------------------------------------------------------------------- */

/* The rows of the table that is printed. Of text all are stored until the end, because a column is as wide as its widest
   cell; of JSON those of one row. */
static struct {
    bool failed;
    cli_cell *cells; /* a row ends at a cell with a NULL key */
    size_t n, capacity;
} stored;

void cli_set_style(int n_digits, bool show_all)
{
    digits = n_digits;
    all_columns = show_all;
}

void cli_set_format(int row_format)
{
    format = row_format;
}

/* Adds a cell, whose text becomes one line of valid UTF-8, unless it is one of JSON. */
static void push(const char *key, const char *text, cli_cell_kind kind)
{
    if (stored.n == stored.capacity && !stored.failed) {
        const size_t capacity = stored.capacity ? 2 * stored.capacity : 64;
        cli_cell *cells = realloc(stored.cells, capacity * sizeof *cells);
        stored.failed = !cells;
        stored.cells = cells ? cells : stored.cells;
        stored.capacity = cells ? capacity : stored.capacity;
    }
    const size_t size = text ? 4 * strlen(text) + 1 : 0;
    cli_cell cell = {key ? strdup(key) : NULL, text ? malloc(size) : NULL, kind};
    if (stored.failed || (key && !cell.key) || (text && !cell.text)) {
        stored.failed = true;
        free(cell.key);
        free(cell.text);
        return;
    }
    if (text) {
        strcpy(cell.text, text);
    }
    if (text && format != CLI_JSON) {
        koksma_text_escape(cell.text, size);
    }
    stored.cells[stored.n++] = cell;
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

void cli_row_json(const char *key, const char *json, const char *text)
{
    push(key, format == CLI_JSON ? json : text, CLI_LITERAL);
}

void cli_row_text(const char *key, const char *value)
{
    if (value) {
        push(key, value, CLI_WORDS);
    } else {
        cli_row_json(key, "null", "-");
    }
}

const char *cli_number(double value, char text[CLI_NUMBER])
{
    const double size = fabs(value);
    const bool whole = size < 1e15 && (value == floor(value) || size >= pow(10, digits) - 0.5);
    if (!isfinite(value)) {
        strcpy(text, "-");
    } else if (whole) {
        snprintf(text, CLI_NUMBER, "%.0f", value + 0.0); /* + 0.0 turns -0 into 0 */
    } else {
        snprintf(text, CLI_NUMBER, "%.*g", digits, value);
    }
    return text;
}

void cli_row_number(const char *key, double value)
{
    char text[CLI_NUMBER];
    const bool whole = format == CLI_JSON || format == CLI_CSV;
    snprintf(text, sizeof text, "%.17g", value);
    push(key,
         !whole               ? cli_number(value, text)
         : isfinite(value)    ? text
         : format == CLI_JSON ? "null"
                              : "",
         CLI_FIGURE);
}

/* Adds the cell of one conversion of cli_row. */
static void put_field(const char *key, const char *conversion, va_list *list)
{
    char number[CLI_NUMBER];
    const char type = conversion[strcspn(conversion, "sgdu")];
    if (type == 's') {
        cli_row_text(key, va_arg(*list, const char *));
    } else if (type == 'g') {
        cli_row_number(key, va_arg(*list, double));
    } else {
        !strncmp(conversion, "%zu", 3)    ? snprintf(number, sizeof number, "%zu", va_arg(*list, size_t))
        : !strncmp(conversion, "%llu", 4) ? snprintf(number, sizeof number, "%llu", va_arg(*list, unsigned long long))
        : !strncmp(conversion, "%lld", 4) ? snprintf(number, sizeof number, "%lld", va_arg(*list, long long))
                                          : snprintf(number, sizeof number, "%d", va_arg(*list, int));
        push(key, number, CLI_FIGURE);
    }
}

void cli_row(const char *fields, ...)
{
    va_list list;
    va_start(list, fields);
    for (const char *at = fields; *at && *at != '\n'; at += strspn(at, " ")) {
        char key[64];
        const size_t length = strcspn(at, " ");
        snprintf(key, sizeof key, "%.*s", (int)length, at);
        at += length + 1;
        if (key[length - 1] == '?') {
            const int value = va_arg(list, int);
            key[length - 1] = '\0';
            cli_row_json(key, value < 0 ? "null" : value ? "true" : "false", value < 0 ? "-" : value ? "yes" : "no");
        } else {
            put_field(key, at, &list);
        }
        at += strcspn(at, " \n");
    }
    va_end(list);
    if (fields[strlen(fields) - 1] == '\n') {
        cli_row_end();
    }
}

static void free_cells(void)
{
    for (size_t i = 0; i < stored.n; i++) {
        free(stored.cells[i].key);
        free(stored.cells[i].text);
    }
    stored.n = 0;
}

void cli_row_end(void)
{
    if (format != CLI_JSON) {
        push(NULL, NULL, CLI_WORDS);
    } else if (!stored.failed && stored.n) {
        cli_work_end();
        for (size_t i = 0; i < stored.n; i++) {
            putchar(i ? ',' : '{');
            json_text(stored.cells[i].key);
            putchar(':');
            if (stored.cells[i].kind == CLI_WORDS) {
                json_text(stored.cells[i].text);
            } else {
                fputs(stored.cells[i].text, stdout);
            }
        }
        puts("}");
        fflush(stdout);
        free_cells();
    }
}

int cli_rows_close(int code)
{
    if (!stored.failed && format != CLI_JSON) {
        cli_work_end();
        print_table(stored.cells, stored.n,
                    all_columns || format != CLI_TEXT ? 0 : cli_terminal_width(STDOUT_FILENO));
    }
    free_cells();
    free(stored.cells);
    stored.cells = NULL;
    stored.capacity = 0;
    return stored.failed && code <= CLI_NO ? cli_no_memory() : code;
}
