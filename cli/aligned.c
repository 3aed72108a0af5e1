/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Prints rows as aligned text. Consecutive rows with the same keys form a block, which has its own header and column
 * widths. A block that is wider than the terminal is made narrower in these steps. A block of one row is printed as
 * one line per key. In other blocks columns with the same text in all rows go into a line above the table. Of the
 * remaining columns, those that fit are kept from left to right; a column of text needs at least LEAST characters and
 * continues longer texts on further lines. A line below the table names the columns that are left out.
 */
#include "aligned.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { MOST = 64, LEAST = 28, GAP = 2, NARROWEST = 40, USUAL = 80 };

typedef enum state { SHOWN, COMMON, LEFT_OUT } state;

typedef struct block {
    const cli_cell *cells;
    size_t columns, rows;
    int widths[MOST];
    state states[MOST];
} block;

int cli_terminal_width(int stream)
{
    struct winsize size = {0};
    if (!isatty(stream)) {
        return 0;
    }
    const char *wish = getenv("COLUMNS");
    int width = wish ? atoi(wish) : 0;
    width = width > 0 ? width : ioctl(stream, TIOCGWINSZ, &size) || !size.ws_col ? USUAL : size.ws_col;
    return width > NARROWEST ? width : NARROWEST;
}

static const cli_cell *cell_at(const block *b, size_t row, size_t column)
{
    return &b->cells[row * (b->columns + 1) + column];
}

/* Returns the width of UTF-8 text in terminal columns: the number of bytes that begin a character. */
static int width_of(const char *text, size_t length)
{
    int width = 0;
    for (size_t i = 0; i < length; i++) {
        width += ((unsigned char)text[i] & 0xc0) != 0x80;
    }
    return width;
}

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
            const int rest = p->width - width_of(p->text, length);
            if (length > 0) {
                printf("%*s%.*s", blanks + (p->right ? rest : 0), "", (int)length, p->text);
                blanks = 0;
            }
            blanks += GAP + (length > 0 && p->right ? 0 : rest);
            p->text += length + strspn(p->text + length, " ");
            more = more || *p->text;
        }
        putchar('\n');
    }
}

/* Prints the columns in state `which` as a list "key text, key text" (COMMON, with the texts of the first row) or
   "key, key" (LEFT_OUT, after `begin`). */
static void print_list(const block *b, const char *begin, state which, int width)
{
    int column = 0;
    for (size_t i = 0; i < b->columns; i++) {
        const char *key = b->cells[i].key, *text = which == COMMON ? b->cells[i].text : "";
        if (b->states[i] != which) {
            continue;
        }
        const int length = width_of(key, strlen(key)) + 1 + width_of(text, strlen(text));
        if (column > 0 && column + 2 + length >= width) {
            puts(",");
            column = 0;
        }
        const char *before = column > 0 ? ", " : which == LEFT_OUT && *begin ? begin : "";
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
static void print_record(const block *b, int width)
{
    int keys = 0;
    for (size_t i = 0; i < b->columns; i++) {
        const int length = width_of(b->cells[i].key, strlen(b->cells[i].key));
        keys = length > keys ? length : keys;
    }
    for (size_t i = 0; i < b->columns; i++) {
        print_row((piece[]){{b->cells[i].key, keys, false}, {b->cells[i].text, width - keys - GAP, false}}, 2);
    }
}

/* Makes each column as wide as its widest text. Returns the total width of the columns. */
static int measure_columns(block *b)
{
    int total = -GAP;
    for (size_t i = 0; i < b->columns; i++) {
        b->widths[i] = width_of(b->cells[i].key, strlen(b->cells[i].key));
        for (size_t row = 0; row < b->rows; row++) {
            const char *text = cell_at(b, row, i)->text;
            const int width = width_of(text, strlen(text));
            b->widths[i] = b->widths[i] > width ? b->widths[i] : width;
        }
        total += b->widths[i] + GAP;
    }
    return total;
}

static bool is_common(const block *b, size_t column)
{
    for (size_t row = 1; row < b->rows; row++) {
        if (strcmp(cell_at(b, row, column)->text, b->cells[column].text) != 0) {
            return false;
        }
    }
    return true;
}

/* Chooses the columns that fit the width, and divides the width that remains among the columns of text. */
static void fit(block *b, int width)
{
    int least[MOST], room = width + GAP;
    for (size_t i = 0; i < b->columns; i++) {
        const int key = width_of(b->cells[i].key, strlen(b->cells[i].key)), natural = b->widths[i];
        least[i] = b->cells[i].is_number || natural < LEAST ? natural : key > LEAST ? key : LEAST;
        b->states[i] = is_common(b, i) ? COMMON : least[i] + GAP > room ? LEFT_OUT : SHOWN;
        room -= b->states[i] == SHOWN ? least[i] + GAP : 0;
    }
    for (size_t i = 0; i < b->columns; i++) {
        const int more = b->widths[i] - least[i] < room ? b->widths[i] - least[i] : room;
        b->widths[i] = least[i] + more;
        room -= b->states[i] == SHOWN ? more : 0;
    }
}

/* Prints the shown columns of a row; row SIZE_MAX is the header. */
static void print_columns(const block *b, size_t row)
{
    piece pieces[MOST];
    size_t n = 0;
    for (size_t i = 0; i < b->columns; i++) {
        const cli_cell *c = cell_at(b, row == SIZE_MAX ? 0 : row, i);
        if (b->states[i] == SHOWN) {
            pieces[n++] = (piece){row == SIZE_MAX ? c->key : c->text, b->widths[i], c->is_number};
        }
    }
    if (n > 0) {
        print_row(pieces, n);
    }
}

static void print_block(block *b, int width)
{
    if (measure_columns(b) > width && width > 0) {
        if (b->rows == 1) {
            print_record(b, width);
            return;
        }
        fit(b, width);
        print_list(b, "", COMMON, width);
    }
    for (size_t row = 0; row <= b->rows; row++) {
        print_columns(b, row - 1);
    }
    print_list(b, "with --long: ", LEFT_OUT, width);
}

static size_t columns_of(const cli_cell *row, size_t n)
{
    size_t columns = 0;
    while (columns < n && row[columns].key) {
        columns++;
    }
    if (columns > MOST) {
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

void cli_table_print(const cli_cell *cells, size_t n, int width)
{
    for (size_t start = 0, end; start < n; start = end) {
        block b = {.cells = &cells[start], .columns = columns_of(&cells[start], n - start)};
        for (end = start; same_keys(&cells[end], n - end, b.cells, b.columns); b.rows++) {
            end += b.columns + 1;
        }
        print_block(&b, width);
    }
}
