/* SPDX-License-Identifier: Apache-2.0 */
/* The columns of a table, and tables for other programs: CSV, and LaTeX. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "row_tables.h"

int cli_width_of(const char *text, size_t length)
{
    int width = 0;
    for (size_t i = 0; i < length; i++) {
        width += ((unsigned char)text[i] & 0xc0) != 0x80;
    }
    return width;
}

int cli_measure_columns(cli_block *b)
{
    int total = -CLI_GAP;
    for (size_t i = 0; i < b->columns; i++) {
        b->widths[i] = cli_width_of(b->cells[i].key, strlen(b->cells[i].key));
        for (size_t row = 0; row < b->rows; row++) {
            const char *text = cli_cell_at(b, row, i)->text;
            const int width = cli_width_of(text, strlen(text));
            b->widths[i] = b->widths[i] > width ? b->widths[i] : width;
        }
        total += b->widths[i] + CLI_GAP;
    }
    return total;
}

static bool is_common(const cli_block *b, size_t column)
{
    for (size_t row = 1; row < b->rows; row++) {
        if (strcmp(cli_cell_at(b, row, column)->text, b->cells[column].text) != 0) {
            return false;
        }
    }
    return true;
}

void cli_fit_columns(cli_block *b, int width)
{
    enum { LEAST = 28 };
    int least[CLI_MOST_COLUMNS], room = width + CLI_GAP;
    for (size_t i = 0; i < b->columns; i++) {
        const int key = cli_width_of(b->cells[i].key, strlen(b->cells[i].key)), natural = b->widths[i];
        least[i] = b->cells[i].kind == CLI_FIGURE || natural < LEAST ? natural : key > LEAST ? key : LEAST;
        b->states[i] = is_common(b, i) ? CLI_COMMON : least[i] + CLI_GAP > room ? CLI_LEFT_OUT : CLI_SHOWN;
        room -= b->states[i] == CLI_SHOWN ? least[i] + CLI_GAP : 0;
    }
    for (size_t i = 0; i < b->columns; i++) {
        const int more = b->widths[i] - least[i] < room ? b->widths[i] - least[i] : room;
        b->widths[i] = least[i] + more;
        room -= b->states[i] == CLI_SHOWN ? more : 0;
    }
}

/* ---- Tables for other programs ------------------------------------------------------------------------- */

/* A field of CSV (RFC 4180): in quotes where it needs them, and behind an apostrophe where a spreadsheet would run it, as
   koksma__csv_put has it. */
static void print_csv(const cli_cell *c, bool head)
{
    const char *text = head ? c->key : c->text;
    const bool formula = c->kind != CLI_FIGURE && strspn(text, "=+@-\t") && strcmp(text, "-") != 0;
    const char *quote = formula || strpbrk(text, ",\"\r\n") ? "\"" : "";
    printf("%s%s", quote, formula ? "'" : "");
    for (; *text; text++) {
        printf(*text == '"' ? "\"\"" : "%c", *text);
    }
    fputs(quote, stdout);
}

/* A cell of a LaTeX table: numbers in mathematics, with powers of ten; of texts the special characters escaped. */
static void print_latex(const cli_cell *c, bool head)
{
    static const char special[] = "\\~^<>";
    static const char *const command[] = {"\\textbackslash{}", "\\textasciitilde{}", "\\textasciicircum{}",
                                          "\\textless{}", "\\textgreater{}"};
    const char *text = head ? c->key : c->text, *power = strchr(text, 'e');
    if (c->kind == CLI_FIGURE && !head) {
        const int mantissa = (int)(power ? (size_t)(power - text) : strlen(text));
        printf(!strcmp(text, "-") ? "--"
               : power            ? "$%.*s \\times 10^{%d}$"
                                  : "$%.*s$",
               mantissa, text, power ? atoi(power + 1) : 0);
        return;
    }
    for (; *text; text++) {
        const char *at = strchr(special, *text);
        if (at) {
            fputs(command[at - special], stdout);
        } else {
            printf(strchr("#$%&_{}", *text) ? "\\%c" : "%c", *text);
        }
    }
}

static size_t column_of(const cli_block *b, const char *key)
{
    size_t i = 0;
    while (i < b->columns && strcmp(b->cells[i].key, key) != 0) {
        i++;
    }
    return i;
}

static bool same_cells(const cli_block *b, size_t row, size_t other, size_t columns)
{
    size_t i = 0;
    while (i < columns && !strcmp(cli_cell_at(b, row, i)->text, cli_cell_at(b, other, i)->text)) {
        i++;
    }
    return i == columns;
}

/* Writes a value and its standard error, which has two digits, with as many decimals. */
static void put_error(char text[64], const char *value, const char *error)
{
    const double e = strtod(error, NULL);
    const int decimals = e > 0 ? 1 - (int)floor(log10(e)) : 0;
    if (e > 0 && decimals >= 0 && decimals <= 9) {
        snprintf(text, 64, "%.*f \\pm %.*f", decimals, strtod(value, NULL), decimals, e);
    } else {
        snprintf(text, 64, "%s", value);
    }
}

/* The table of a paper: a row for each source, a column for each measure, if every source has all of them. Returns the
   cells, to be freed with their texts from the column `keys` on; NULL if rows are no such table, or without memory. */
static cli_cell *widen(const cli_block *b, cli_block *wide)
{
    const size_t keys = column_of(b, "measure"), value = column_of(b, "value"),
                 error = column_of(b, "standard_error");
    size_t measures = 1;
    while (measures < b->rows && same_cells(b, measures, 0, keys)) {
        measures++;
    }
    bool fits = value < b->columns && column_of(b, "exact") == b->columns && column_of(b, "warp") == b->columns &&
                measures > 1 && b->rows % measures == 0 && keys + measures <= CLI_MOST_COLUMNS;
    for (size_t row = 0; fits && row < b->rows; row++) {
        fits = same_cells(b, row, row - row % measures, keys) &&
               !strcmp(cli_cell_at(b, row, keys)->text, cli_cell_at(b, row % measures, keys)->text);
    }
    *wide = (cli_block){.columns = keys + measures, .rows = b->rows / measures};
    cli_cell *cells = fits ? calloc(wide->rows * (wide->columns + 1), sizeof *cells) : NULL;
    wide->cells = cells;
    for (size_t row = 0; cells && row < b->rows; row++) {
        cli_cell *to = &cells[row / measures * (wide->columns + 1)];
        char text[64];
        put_error(text, cli_cell_at(b, row, value)->text, error < b->columns ? cli_cell_at(b, row, error)->text : "");
        memcpy(to, cli_cell_at(b, row, 0), keys * sizeof *to);
        to[keys + row % measures] = (cli_cell){cli_cell_at(b, row, keys)->text, strdup(text), CLI_FIGURE};
    }
    return cells;
}

static void print(cli_block *b, bool latex, bool is_long, bool first)
{
    enum { PAGE = 90 };
    if (latex) {
        printf("%s", first ? "% needs \\usepackage{booktabs}\n" : "");
        if (cli_measure_columns(b) > PAGE && b->rows > 1 && !is_long) {
            cli_fit_columns(b, PAGE);
        }
        for (size_t i = 0; i < b->columns; i++) {
            if (b->states[i] != CLI_SHOWN) {
                const bool common = b->states[i] == CLI_COMMON;
                printf("%% %s%s %s\n", common ? "" : "with --long: ", b->cells[i].key,
                       common ? b->cells[i].text : "");
            }
        }
        printf("\\begin{tabular}{");
        for (size_t i = 0; i < b->columns; i++) {
            printf("%s", b->states[i] != CLI_SHOWN ? "" : b->cells[i].kind == CLI_FIGURE ? "r" : "l");
        }
        puts("}\n\\toprule");
    }
    for (size_t row = 0; row <= b->rows; row++) {
        bool begun = false;
        for (size_t i = 0; i < b->columns; i++) {
            if (b->states[i] == CLI_SHOWN) {
                fputs(!begun ? "" : latex ? " & " : ",", stdout);
                (latex ? print_latex : print_csv)(cli_cell_at(b, row ? row - 1 : 0, i), !row);
                begun = true;
            }
        }
        puts(!latex ? "" : row ? " \\\\" : " \\\\\n\\midrule");
    }
    if (latex) {
        puts("\\bottomrule\n\\end{tabular}");
    }
}

void cli_print_foreign(cli_block *b, bool latex, bool is_long, bool first)
{
    cli_block wide;
    const size_t keys = column_of(b, "measure");
    cli_cell *cells = latex && !is_long ? widen(b, &wide) : NULL;
    if (!first) {
        putchar('\n'); /* columns change: another table */
    }
    if (!cells) {
        print(b, latex, is_long, first);
        return;
    }
    if (column_of(b, "standard_error") < b->columns) {
        puts("% means and standard errors; --long prints a row for each mean, with its trials");
    }
    print(&wide, latex, is_long, first);
    for (size_t row = 0; row < wide.rows; row++) {
        for (size_t i = keys; i < wide.columns; i++) {
            free(cells[row * (wide.columns + 1) + i].text);
        }
    }
    free(cells);
}
