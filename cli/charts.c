/* SPDX-License-Identifier: Apache-2.0 */
/* Charts and panels of `koksma plot`: rows of a curve are stored as lists of numbers, which koksma/plot.h draws. */
#include "charts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *cli_label(const char *source)
{
    return strncmp(source, "pattern:", 8) == 0 ? source + 8 : source;
}

static int write_picture(const cli_curves *c, koksma_status status, unsigned char *bytes, size_t n_bytes)
{
    if (!status) {
        status = koksma_plot_write(c->output, bytes, n_bytes);
        free(bytes);
    }
    return status ? cli_fail(c->arguments, status) : CLI_YES;
}

int cli_draw_panels(const cli_curves *c, const koksma_panel *panels, size_t n)
{
    unsigned char *bytes = NULL;
    size_t n_bytes = 0;
    const koksma_status status = koksma_plot_panels(panels, n, (double)c->size, c->format, &bytes, &n_bytes);
    return write_picture(c, status, bytes, n_bytes);
}

int cli_write_chart(const cli_curves *c, koksma_chart *chart)
{
    unsigned char *bytes = NULL;
    size_t n_bytes = 0;
    chart->size = (double)c->size;
    const koksma_status status = koksma_plot_chart(chart, c->format, &bytes, &n_bytes);
    return write_picture(c, status, bytes, n_bytes);
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

/* Rows become numbers of the next curve. */
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

int cli_draw_chart(cli_curves *c)
{
    const cli_arguments *arguments = c->arguments;
    cli_chart_store s;
    const size_t most = c->bins > KOKSMA_SPECTRUM_MAX_HALF ? c->bins : KOKSMA_SPECTRUM_MAX_HALF;
    int code = cli_open_store(&s, (size_t)arguments->n_operands, most) ? CLI_YES : cli_no_memory();
    for (int i = 0; i < arguments->n_operands && !code; i++) {
        chart_sink sink = {.sink = {.row = put_row}, .curve = c->curve, .store = &s};
        code = c->curve->compute(c, arguments->operands[i], &sink.sink);
        cli_push_curve(&s, sink.n, (size_t)i, cli_label(arguments->operands[i]));
    }
    if (!code) {
        koksma_chart chart = {.x_label = c->curve->plot.x_label,
                              .y_label = c->curve->plot.y_label,
                              .curves = s.curves,
                              .n_curves = s.n,
                              .has_level = c->curve->plot.level != NULL,
                              .level = c->curve->plot.level ? c->curve->plot.level(c) : 0};
        code = cli_write_chart(c, &chart);
    }
    cli_close_store(&s);
    return code;
}
