/* SPDX-License-Identifier: Apache-2.0 */
/* Pictures of curves: charts of rows, panels, and the file that they become. */
#ifndef KOKSMA_CLI_CHARTS_H
#define KOKSMA_CLI_CHARTS_H

#include "curves.h"

enum { CLI_CHART_LABEL = 160 };

/* Room for a chart's curves: for each three lists of `per` numbers (xs, ys, errors) and a label. */
typedef struct cli_chart_store {
    koksma_curve *curves;
    double *numbers;
    char (*labels)[CLI_CHART_LABEL];
    size_t n, per;
} cli_chart_store;

/* False when memory runs out. */
bool cli_open_store(cli_chart_store *s, size_t n, size_t per);
void cli_close_store(cli_chart_store *s);

/* The next curve's xs; its ys begin at [per], its errors at [2 per]. */
double *cli_next_numbers(const cli_chart_store *s);

/* The next curve has n of them. */
void cli_push_curve(cli_chart_store *s, size_t n, size_t colour, const char *label);

/* The rows of all operands as a chart by a curve's axes; the store is to be closed, also on failure. The exit code. */
int cli_chart_open(cli_curves *c, const cli_curve *curve, cli_chart_store *s, koksma_chart *chart);

/* Draws the rows of all operands in one chart, by the curve's axes; the exit code. */
int cli_draw_chart(cli_curves *c);

/* Write a picture into --output, below --title or else this one, which may be NULL; the exit code. */
int cli_write_figure(const cli_curves *c, const char *title, const koksma_cell *cells, size_t n);
int cli_write_chart(const cli_curves *c, const char *title, const koksma_chart *chart);
int cli_draw_panels(const cli_curves *c, const char *title, const koksma_panel *panels, size_t n);

/* A source without "pattern:", its n and its dimension. */
const char *cli_label(const char *source);

/* "SPEC, n = N", and of more dimensions than 2 ", d = DIM"; of a file its path. Returns text. */
const char *cli_title(const char *source, char text[CLI_CHART_LABEL]);

/* The colours of all operands, from the first on. */
void cli_colours(const cli_curves *c, size_t numbers[CLI_MAX_PANELS]);

#endif
