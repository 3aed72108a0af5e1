/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Aligned text of rows. Rows with the same keys in a run are a block, with a header and columns of its own. A block that
 * is wider than the terminal is made to fit, in this order: a single row is printed as a line for each key; columns
 * that are equal in all rows go into a line above; columns are taken from the left as long as they fit, text with at
 * least LEAST columns, in several lines where it is longer; and what is left out is named below.
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

/* Columns of a terminal: bytes of UTF-8 that begin a character. */
static int width_of(const char *text, size_t length)
{
    int width = 0;
    for (size_t i = 0; i < length; i++) {
        width += ((unsigned char)text[i] & 0xc0) != 0x80;
    }
    return width;
}

/* The bytes of text that go on a line: all, or up to the last blank, comma or @ that fits, or what fits. */
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

/* A cell of a line: what is left of its text, and how it is set. */
typedef struct piece {
    const char *text;
    int width;
    bool right;
} piece;

/* One row, in as many lines as its longest text takes. No line ends in blanks. */
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

/* "a x, b y" of the columns of a state, with the texts of the first row or without. */
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

/* A row as a line for each key. */
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

/* The columns that are as wide as their widest text; what they take together. */
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

/* Chooses columns, and shares the width among those of text. */
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

/* Row SIZE_MAX: the header. */
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
        abort(); /* a mistake in the program */
    }
    return columns;
}

/* Whether the cells are a row with the keys of another one. */
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
