/* SPDX-License-Identifier: Apache-2.0 */
/* Charts and panels of `koksma plot`: stores the rows of a curve as arrays of numbers, which the functions of
   koksma/plot.h draw. */
#include "curves.h"

#include "source.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *cli_label(const char *source)
{
    return strncmp(source, "pattern:", 8) == 0 ? source + 8 : source;
}

const char *cli_title(const char *source, char text[CLI_CHART_LABEL])
{
    const char *label = cli_label(source), *n = NULL, *dim = NULL;
    size_t length = strlen(label);
    for (const char *at = cli_source_is_pattern(source) ? strrchr(label, '@') : NULL;
         at && !dim;) { /* the loop finds the endings @N, or @N and @DIM */
        dim = n;
        n = at;
        length = (size_t)(at - label);
        while (at > label && at[-1] >= '0' && at[-1] <= '9') {
            at--;
        }
        at = at > label && at < n && at[-1] == '@' ? at - 1 : NULL;
    }
    snprintf(text, CLI_CHART_LABEL, "%.*s", (int)length, label);
    if (n) {
        const size_t used = strlen(text);
        const int digits = (int)strspn(n + 1, "0123456789");
        const bool plane = !dim || !strcmp(dim, "@2");
        snprintf(text + used, CLI_CHART_LABEL - used, ", n = %.*s%s%s", digits, n + 1,
                 plane ? "" : ", d = ", plane ? "" : dim + 1);
    }
    return text;
}

void cli_colours(const cli_curves *c, size_t numbers[CLI_MAX_PANELS])
{
    const char *labels[CLI_MAX_PANELS];
    for (int i = 0; i < c->arguments->n_operands; i++) {
        labels[i] = cli_label(c->arguments->operands[i]);
    }
    koksma_plot_colours(labels, (size_t)c->arguments->n_operands, numbers);
}

int cli_write_figure(const cli_curves *c, const char *title, const koksma_cell *cells, size_t n)
{
    const koksma_figure figure = {.title = cli_text(c->arguments, "title", title),
                                  .cells = cells,
                                  .n_cells = n,
                                  .width = c->width,
                                  .height = c->height,
                                  .wrap = true,
                                  .dark = c->dark};
    unsigned char *bytes = NULL;
    size_t n_bytes = 0;
    koksma_status status = koksma_plot_figure(&figure, c->format, &c->work.run, &bytes, &n_bytes);
    cli_work_end();
    status = status ? status : koksma_plot_write(c->output, bytes, n_bytes);
    free(bytes);
    return status ? cli_fail(c->arguments, status) : CLI_YES;
}

int cli_write_chart(const cli_curves *c, const char *title, const koksma_chart *chart)
{
    const koksma_cell cell = {.chart = chart};
    return cli_write_figure(c, title, &cell, 1);
}

int cli_draw_panels(const cli_curves *c, const char *title, const koksma_panel *panels, size_t n)
{
    koksma_cell cells[CLI_MAX_PANELS] = {{0}};
    for (size_t i = 0; i < n; i++) {
        cells[i].panel = &panels[i];
    }
    return cli_write_figure(c, title, cells, n);
}

bool cli_open_store(cli_chart_store *s, size_t n, size_t per)
{
    *s = (cli_chart_store){calloc(n, sizeof(koksma_curve)), calloc(3 * n * per, sizeof(double)),
                           calloc(n, CLI_CHART_LABEL), 0, per};
    return s->curves && s->numbers && s->labels;
}

void cli_close_store(cli_chart_store *s)
{
    free(s->curves);
    free(s->numbers);
    free(s->labels);
}

double *cli_next_numbers(const cli_chart_store *s)
{
    return s->numbers + 3 * s->per * s->n;
}

void cli_push_curve(cli_chart_store *s, size_t n, size_t colour, const char *label)
{
    double *numbers = cli_next_numbers(s);
    s->curves[s->n++] = (koksma_curve){.label = label,
                                       .n = n,
                                       .xs = numbers,
                                       .ys = numbers + s->per,
                                       .errors = numbers + 2 * s->per,
                                       .colour = colour};
}

/* A sink that appends each row to the arrays of the next curve in a chart store. */
typedef struct chart_sink {
    cli_sink sink;
    const cli_curve *curve;
    cli_chart_store *store;
    size_t n;
} chart_sink;

static void put_row(cli_sink *sink, const double *values)
{
    chart_sink *s = (chart_sink *)sink;
    double *numbers = cli_next_numbers(s->store) + s->n++;
    const size_t per = s->store->per;
    numbers[0] = s->curve->plot.x_per_root ? values[0] / sqrt(sink->points) : values[0];
    numbers[per] = values[s->curve->plot.y];
    numbers[2 * per] = s->curve->plot.error ? values[s->curve->plot.error] : 0;
}

int cli_chart_open(cli_curves *c, const cli_curve *curve, cli_chart_store *s, koksma_chart *chart)
{
    const cli_arguments *arguments = c->arguments;
    const size_t most = c->bins > KOKSMA_SPECTRUM_MAX_HALF ? c->bins : KOKSMA_SPECTRUM_MAX_HALF;
    size_t colours[CLI_MAX_PANELS];
    cli_colours(c, colours);
    int code = cli_open_store(s, (size_t)arguments->n_operands, most) ? CLI_YES : cli_no_memory();
    for (int i = 0; i < arguments->n_operands && !code; i++) {
        chart_sink sink = {.sink = {.row = put_row}, .curve = curve, .store = s};
        code = curve->compute(c, arguments->operands[i], &sink.sink);
        cli_push_curve(s, sink.n, colours[i], cli_title(arguments->operands[i], s->labels[s->n]));
    }
    *chart = (koksma_chart){.x_label = curve->plot.x_label,
                            .y_label = curve->plot.y_label,
                            .curves = s->curves,
                            .n_curves = s->n,
                            .has_level = curve->plot.level != NULL,
                            .level = curve->plot.level ? curve->plot.level(c) : 0};
    return code;
}

int cli_draw_chart(cli_curves *c)
{
    cli_chart_store s;
    koksma_chart chart;
    int code = cli_chart_open(c, c->curve, &s, &chart);
    code = code ? code : cli_write_chart(c, c->curve->plot.title, &chart);
    cli_close_store(&s);
    return code;
}
