/* SPDX-License-Identifier: Apache-2.0 */
/* Draws the curves of `koksma plot`: charts of rows, panels of points or spectra, and writes them to a picture file.
   */
#ifndef KOKSMA_CLI_CHARTS_H
#define KOKSMA_CLI_CHARTS_H

#include "curves.h"

enum { CLI_CHART_LABEL = 160 };

/* Memory for the curves of a chart: for each curve three arrays of `per` numbers (xs, ys, errors) and a label. */
typedef struct cli_chart_store {
    koksma_curve *curves;
    double *numbers;
    char (*labels)[CLI_CHART_LABEL];
    size_t n, per;
} cli_chart_store;

/* Allocates a store for n curves. Returns false when memory runs out. */
bool cli_open_store(cli_chart_store *s, size_t n, size_t per);
void cli_close_store(cli_chart_store *s);

/* Returns the arrays of the next curve: xs begin at [0], ys at [per], errors at [2 per]. */
double *cli_next_numbers(const cli_chart_store *s);

/* Adds the next curve to the store, with the first n numbers of each of its arrays. */
void cli_push_curve(cli_chart_store *s, size_t n, size_t colour, const char *label);

/* Computes the rows of all operands and makes a chart of them, with the axes of `curve`. The caller must close the
   store, even after a failure. Returns the exit code. */
int cli_chart_open(cli_curves *c, const cli_curve *curve, cli_chart_store *s, koksma_chart *chart);

/* Draws the rows of all operands in one chart, with the axes of the curve c->curve. Returns the exit code. */
int cli_draw_chart(cli_curves *c);

/* The three functions below write a picture to the file --output, headed by --title or else by `title`, which may be
   NULL, and return the exit code. */
int cli_write_figure(const cli_curves *c, const char *title, const koksma_cell *cells, size_t n);
int cli_write_chart(const cli_curves *c, const char *title, const koksma_chart *chart);
int cli_draw_panels(const cli_curves *c, const char *title, const koksma_panel *panels, size_t n);

/* Returns a source's text without "pattern:" at its beginning. */
const char *cli_label(const char *source);

/* Writes the title of a source to `text` and returns it: "SPEC, n = N" for a pattern, followed by ", d = DIM" above 2
   dimensions; the path for a file. */
const char *cli_title(const char *source, char text[CLI_CHART_LABEL]);

/* Chooses the colours of all operands: numbers[i] is the colour of operand i. */
void cli_colours(const cli_curves *c, size_t numbers[CLI_MAX_PANELS]);

#endif
