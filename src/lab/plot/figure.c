/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Figures: panels and charts in rows below a title; a row is broken into several lines if the width is too small. All
 * heights follow from the width: texts are measured, squares are as wide as their column, and axes have a fixed
 * aspect ratio. If the caller requests a smaller height, squares and axes shrink; if a larger one, axes grow.
 */
#include "plot/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/files.h"
#include "core/status.h"

enum { TITLE = 15, TOP = 6, CHART = 480, MIN_PANEL = 128, MIN_CHART = 300, WIDE = 960 };

static const double aspect = 0.5; /* height of a chart's axes over the width of the chart */

/* A line of cells side by side. */
typedef struct line {
    size_t first, n, columns;
    double title, texts, flexible; /* heights of the titles, of all texts, and of the squares or axes */
    bool charts;                   /* has at least one chart; charts can grow in height */
} line;

typedef struct layout {
    const koksma_figure *figure;
    const koksma_run *run;
    double width, title, fixed, flexible, growing;
    size_t n;
    line *lines;
} layout;

/* The next line of a figure: the cells from `first` on that belong to one row and fit into the width. A line that
   continues the row of the line `before` has as many columns as that line. */
static line find_line(const koksma_figure *f, size_t first, double width, const line *before)
{
    line l = {.first = first};
    double least = 0;
    size_t row = first;
    for (; row < f->n_cells && f->cells[row].row == f->cells[first].row; row++) {
        least = fmax(least, f->cells[row].chart ? MIN_CHART : MIN_PANEL);
        l.charts = l.charts || f->cells[row].chart;
    }
    const size_t in_row = row - first, most = least > 0 && width > least ? (size_t)(width / least) : 1;
    const size_t n_lines = (in_row + most - 1) / most;
    l.columns = before && f->cells[before->first].row == f->cells[first].row ? before->columns
                : f->wrap                                                    ? (in_row + n_lines - 1) / n_lines
                                                                             : in_row;
    l.n = in_row < l.columns ? in_row : l.columns;
    return l;
}

static void measure_line(const koksma_figure *f, line *l, double width)
{
    for (size_t i = l->first; i < l->first + l->n; i++) {
        const koksma_cell *c = &f->cells[i];
        l->title = fmax(l->title, c->chart ? 0 : koksma__panel_title(c->panel, width));
    }
    for (size_t i = l->first; i < l->first + l->n; i++) {
        const koksma_cell *c = &f->cells[i];
        l->texts = fmax(l->texts, c->chart ? koksma__chart_texts(c->chart, width)
                                           : l->title - koksma__panel_title(c->panel, width) +
                                                 koksma__panel_texts(c->panel, width));
        l->flexible = fmax(l->flexible, c->chart ? fmax(aspect * width, 40) : width);
    }
}

/* Computes all positions for a width; lines has capacity for one line for each cell. */
static void lay_out(layout *a, const koksma_figure *f, double width)
{
    *a = (layout){.figure = f, .run = a->run, .width = width, .lines = a->lines};
    a->title = (double)koksma__canvas_lines(NULL, 0, 0, width - 2 * TOP, TITLE, 0, f->title, (koksma__colour){0}) *
               koksma__line_height(TITLE);
    a->fixed = a->title + (a->title > 0 ? TOP : 0);
    for (size_t i = 0; i < f->n_cells; i += a->lines[a->n - 1].n) {
        line *l = &a->lines[a->n++];
        *l = find_line(f, i, width, i ? l - 1 : NULL);
        measure_line(f, l, width / (double)l->columns);
        a->fixed += l->texts;
        a->flexible += l->flexible;
        a->growing += l->charts ? l->flexible : 0;
    }
}

/* Fits squares and axes to a requested height: if it is too small for them, all shrink by the same factor; if it is
   larger, only charts grow. */
static koksma_status fit_height(layout *a, double asked)
{
    const double room = asked - a->fixed, more = room - a->flexible;
    KOKSMA__FAIL_IF(asked > 0 && room < 24 * (double)a->n, KOKSMA_ARGUMENT,
                    "a picture %g high: at this width the height must be at least %g", asked,
                    ceil(a->fixed + 24 * (double)a->n));
    for (size_t i = 0; i < a->n && asked > 0; i++) {
        double *height = &a->lines[i].flexible;
        *height *= more < 0 ? room / a->flexible : a->lines[i].charts ? 1 + more / a->growing : 1;
    }
    return KOKSMA_OK;
}

static koksma_status draw_line(koksma__canvas *canvas, const koksma__theme *theme, const layout *a, const line *l,
                               double y)
{
    const double width = a->width / (double)l->columns;
    for (size_t i = 0; i < l->n; i++) {
        const koksma_cell *c = &a->figure->cells[l->first + i];
        const double texts = c->chart ? koksma__chart_texts(c->chart, width) : l->texts;
        const koksma__box box = {(double)i * width, y, width, texts + l->flexible};
        KOKSMA__TRY(
            c->chart ? koksma__chart_draw(canvas, theme, c->chart, box)
                     : koksma__panel_draw(canvas, theme, c->panel, box, l->title, fmin(width, l->flexible), a->run));
    }
    return KOKSMA_OK;
}

static koksma_status draw(const layout *a, double height, koksma_plot_format format, unsigned char **bytes, size_t *n)
{
    const koksma_figure *f = a->figure;
    const koksma__theme *theme = koksma__theme_of(f->dark);
    const koksma_cell *first = &f->cells[0];
    const char *name = f->title ? f->title : first->chart ? first->chart->title : first->panel->title;
    koksma__canvas *canvas;
    koksma_status status = koksma__canvas_open(format, a->width, height > 0 ? height : ceil(a->fixed + a->flexible),
                                               name, theme->paper, &canvas);
    KOKSMA__TRY(status);
    koksma__canvas_lines(canvas, a->width / 2, TOP + TITLE, a->width - 2 * TOP, TITLE, 0.5, f->title, theme->ink);
    double y = a->title > 0 ? a->title + TOP : 0;
    for (size_t i = 0; i < a->n && !status; i++) {
        status = draw_line(canvas, theme, a, &a->lines[i], y);
        y += a->lines[i].texts + a->lines[i].flexible;
    }
    if (!status) {
        return canvas->draw->close(canvas, bytes, n);
    }
    canvas->draw->close(canvas, NULL, NULL);
    *bytes = NULL; /* the caller may free it */
    *n = 0;
    return status;
}

koksma_status koksma__figure_size(koksma_plot_format format, double asked, double fallback, double *size)
{
    KOKSMA__FAIL_IF(format != KOKSMA_PLOT_SVG && format != KOKSMA_PLOT_PDF && format != KOKSMA_PLOT_PNG,
                    KOKSMA_ARGUMENT, "%d is not a format of plots", (int)format);
    *size = asked == 0 ? fallback : asked;
    return *size >= KOKSMA_PLOT_MIN_SIZE && *size <= KOKSMA_PLOT_MAX_SIZE
               ? KOKSMA_OK
               : koksma__fail(KOKSMA_ARGUMENT, "a picture of size %g: the size must be %d to %d", asked,
                              KOKSMA_PLOT_MIN_SIZE, KOKSMA_PLOT_MAX_SIZE);
}

/* Checks the cells, and sets the default width, that of the widest row. */
static koksma_status check_cells(const koksma_figure *f, double *width)
{
    koksma_status status = koksma__array_check("figure->cells", f->cells, f->n_cells, sizeof *f->cells);
    double row = 0, widest = 0;
    *width = 0;
    for (size_t i = 0; i < f->n_cells && !status; i++) {
        const koksma_cell *c = &f->cells[i];
        status = c->chart   ? koksma__chart_check(c->chart)
                 : c->panel ? koksma__panel_check(c->panel)
                            : koksma__fail(KOKSMA_ARGUMENT, "figure->cells[%zu] has neither a panel nor a chart", i);
        if (!status) {
            const double own = c->chart ? CHART : koksma__panel_side(c->panel);
            row = own + (i > 0 && c->row == c[-1].row ? row : 0);
            widest = fmax(widest, own);
            *width = fmax(*width, row);
        }
    }
    *width = f->wrap ? fmin(*width, fmax(widest, WIDE)) : *width;
    return status;
}

koksma_status koksma_plot_figure(const koksma_figure *figure, koksma_plot_format format, const koksma_run *run,
                                 unsigned char **bytes, size_t *n_bytes)
{
    KOKSMA__REQUIRE(figure, bytes, n_bytes);
    KOKSMA__REQUIRE_RUN(run);
    double width = 0, height = 0;
    koksma_status status = figure->n_cells
                               ? check_cells(figure, &width)
                               : koksma__fail(KOKSMA_ARGUMENT, "a figure without cells: it must have 1 or more");
    status = status ? status : koksma__figure_size(format, figure->width, fmin(width, KOKSMA_PLOT_MAX_SIZE), &width);
    if (!status && figure->height != 0) {
        status = koksma__figure_size(format, figure->height, 0, &height);
    }
    layout a = {.run = run, .lines = status ? NULL : calloc(figure->n_cells, sizeof(line))};
    if (!status && !a.lines) {
        status = koksma__fail_memory(figure->n_cells * sizeof(line));
    }
    if (!status) {
        lay_out(&a, figure, width);
        status = fit_height(&a, height);
    }
    if (!status && a.fixed + a.flexible > KOKSMA_PLOT_MAX_SIZE) {
        status = koksma__fail(KOKSMA_ARGUMENT, "a picture %g wide and %g high: each is up to %d", width,
                              a.fixed + a.flexible, KOKSMA_PLOT_MAX_SIZE);
    }
    status = status ? status : draw(&a, height, format, bytes, n_bytes);
    free(a.lines);
    return status;
}

koksma_status koksma_plot_scatter(const koksma_points *points, const koksma_scatter_options *options,
                                  koksma_plot_format format, unsigned char **bytes, size_t *size)
{
    KOKSMA__REQUIRE(points, bytes, size);
    static const koksma_scatter_options plain = {0};
    options = options ? options : &plain;
    const koksma_panel panel = {.points = points, .scatter = *options, .caption = options->caption};
    const koksma_cell cell = {.panel = &panel};
    const koksma_figure figure = {.cells = &cell, .n_cells = 1, .width = options->size};
    return koksma_plot_figure(&figure, format, NULL, bytes, size);
}

koksma_status koksma_plot_format_of(const char *path, koksma_plot_format *format)
{
    KOKSMA__REQUIRE(path, format);
    static const char *const endings[] = {".svg", ".pdf", ".png"};
    const size_t length = strlen(path);
    for (int i = 0; i < 3; i++) {
        if (length > 4 && !strcmp(path + length - 4, endings[i])) {
            *format = (koksma_plot_format)i;
            return KOKSMA_OK;
        }
    }
    return koksma__fail(KOKSMA_ARGUMENT, "%s: a picture's name ends in .svg, .pdf or .png",
                        *path ? path : "the path is empty");
}

koksma_status koksma_plot_write(const char *path, const unsigned char *bytes, size_t size)
{
    KOKSMA__REQUIRE(path, bytes);
    const koksma_status status = koksma__array_check("bytes", bytes, size, 1);
    return status ? status : koksma__atomic_put(NULL, path, bytes, size);
}
