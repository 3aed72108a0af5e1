/* SPDX-License-Identifier: Apache-2.0 */
/* Curves: checks the options that each takes, and computes the means over sets that curves consist of. */
#include "curves.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "source.h"

/* Some of the curves. */
typedef struct choice {
    cli_curve_list list;
    const char *option;
} choice;

static const char *chosen_name(const void *table, size_t i)
{
    const choice *of = table;
    const cli_curve *curve;
    for (size_t k = 0; (curve = cli_curve_at(k)); k++) {
        const char *options = cli_curve_options(curve, of->list);
        if (options && (!of->option || cli_has_word(options, of->option)) && !i--) {
            return curve->name;
        }
    }
    return NULL;
}

const char *cli_curve_names(cli_curve_list list, const char *option, const char *comma, const char *last, char *text,
                            size_t size)
{
    return cli_join(chosen_name, &(choice){list, option}, comma, last, text, size);
}

/* Returns false, after an error, if an option is given that other curves take but this one does not. */
static bool options_fit(const cli_args *args, const cli_curve *curve, cli_curve_list list, const char *before)
{
    for (const cli_option *o = args->command->options; o->name; o++) {
        char names[256];
        cli_curve_names(list, o->name, ", ", " or ", names, sizeof names);
        if (cli_flag(args, o->name) && *names && !cli_has_word(cli_curve_options(curve, list), o->name)) {
            return !cli_error(args, "--%s goes with %s%s", o->name, before, names);
        }
    }
    return true;
}

bool cli_curves_begin(const cli_args *args, const cli_curve *curve, cli_curve_list list, const char *before,
                      cli_curves *c)
{
    *c = (cli_curves){.args = args, .curve = curve, .output = cli_text(args, "output", NULL)};
    c->method = cli_flag(args, "exact") ? KOKSMA_SPECTRUM_EXACT : KOKSMA_SPECTRUM_FAST;
    return options_fit(args, curve, list, before) && cli_trials(args, 1, 1000000000, &c->seed, &c->trials) &&
           cli_whole(args, "half", 0, 1, KOKSMA_SPECTRUM_MAX_HALF, &c->half) &&
           cli_whole(args, "bins", 100, 1, 1000000, &c->bins) && cli_real(args, "r-max", 0, 1e-6, 0.5, &c->r_max) &&
           cli_work_begin(args, "curves", &c->work);
}

int cli_curves_each_set(cli_curves *c, const char *source,
                        koksma_status (*add)(cli_curves *c, const koksma_points *points, void *context),
                        void *context)
{
    cli_source opened;
    int code = cli_source_open(c->args, source, &opened);
    const uint64_t sets = code || opened.is_pattern ? c->trials : 1; /* a file has only one set */
    const size_t all = (size_t)c->args->n_operands * c->trials;
    for (uint64_t t = 0; t < sets && !code; t++) {
        koksma_points points;
        cli_work_unknown(&c->work, "points");
        code = cli_source_points(c->args, source, c->seed + t, &c->work.run, &points);
        if (!code) {
            c->work.what = "curves";
            cli_work_part(&c->work, c->n_sets < all ? c->n_sets : all - 1, all);
            c->n_sets++;
            const koksma_status status = add(c, &points, context);
            cli_work_end();
            code = status              ? cli_fail(c->args, status)
                   : cli_interrupted() ? koksma_status_exit_code(KOKSMA_INTERRUPTED)
                                       : CLI_YES;
        }
        koksma_points_fini(&points);
    }
    return code;
}

typedef struct spectrum_sum {
    koksma_spectrum *spectrum;
    double per_root;
} spectrum_sum;

static koksma_status add_spectrum(cli_curves *c, const koksma_points *points, void *context)
{
    const spectrum_sum *s = context;
    koksma_status status = KOKSMA_OK;
    if (s->spectrum->sets == 0) {
        const double wish = fmin(ceil(s->per_root * sqrt((double)points->n)), CLI_DEFAULT_HALF);
        status = koksma_spectrum_init(s->spectrum, c->half ? (int)c->half : (int)wish);
    }
    return status ? status : koksma_spectrum_add(s->spectrum, points, c->method, &c->work.run);
}

int cli_curves_spectrum(cli_curves *c, const char *source, double per_root, koksma_spectrum *out)
{
    *out = (koksma_spectrum){0};
    spectrum_sum s = {out, per_root};
    return cli_curves_each_set(c, source, add_spectrum, &s);
}

/* ---- Charts and panels: the rows of a curve as arrays of numbers, which the functions of koksma/plot.h draw --------- */

const char *cli_title(const char *source, char text[CLI_CHART_LABEL])
{
    char spec[KOKSMA_MAX_SPEC];
    size_t n;
    int dim;
    if (!cli_source_is_pattern(source) || !cli_split(source, spec, &n, &dim)) {
        snprintf(text, CLI_CHART_LABEL, "%.*s", CLI_CHART_LABEL - 1, cli_spec_in(source));
    } else {
        snprintf(text, CLI_CHART_LABEL, dim == 2 ? "%.120s, n = %zu" : "%.120s, n = %zu, d = %d", spec, n, dim);
    }
    return text;
}

void cli_colours(const cli_curves *c, size_t numbers[CLI_MAX_PANELS])
{
    const char *labels[CLI_MAX_PANELS];
    for (int i = 0; i < c->args->n_operands; i++) {
        labels[i] = cli_spec_in(c->args->operands[i]);
    }
    koksma_plot_colours(labels, (size_t)c->args->n_operands, numbers);
}

int cli_write_figure(const cli_curves *c, const char *title, const koksma_cell *cells, size_t n)
{
    const koksma_figure figure = {.title = cli_text(c->args, "title", title),
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
    return status ? cli_fail(c->args, status) : CLI_YES;
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
    const cli_args *args = c->args;
    const size_t most = c->bins > KOKSMA_SPECTRUM_MAX_HALF ? c->bins : KOKSMA_SPECTRUM_MAX_HALF;
    size_t colours[CLI_MAX_PANELS];
    cli_colours(c, colours);
    int code = cli_open_store(s, (size_t)args->n_operands, most) ? CLI_YES : cli_no_memory();
    for (int i = 0; i < args->n_operands && !code; i++) {
        chart_sink sink = {.sink = {.row = put_row}, .curve = curve, .store = s};
        code = curve->compute(c, args->operands[i], &sink.sink);
        cli_push_curve(s, sink.n, colours[i], cli_title(args->operands[i], s->labels[s->n]));
    }
    *chart = (koksma_chart){.x_label = curve->plot.x_label,
                            .y_label = curve->plot.y_label,
                            .curves = s->curves,
                            .n_curves = s->n,
                            .has_level = curve->plot.level != 0,
                            .level = isnan(curve->plot.level) ? -10 * log10((double)c->trials) : curve->plot.level};
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
