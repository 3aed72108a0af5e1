/* SPDX-License-Identifier: Apache-2.0 */
/*
 * convergence: a measure's mean over trials against n on logarithmic axes. A line is fitted by least squares to the
 * logarithms; the legend shows its slope and standard error. A dashed line has the slope that theory gives for the
 * pattern, or else the best slope that any points can have. The set of n points of a file consists of its first n
 * points.
 *
 * compare: a figure as in many papers on sampling: the points of each source, below them their mean power spectra, and
 * below these two charts with all sources, the radial means of the spectra and the convergence of a measure.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../curves.h"
#include "../measuring.h"
#include "../source.h"

enum { MAX_SIZES = KOKSMA_MAX_SIZES, PER_SOURCE = 3 };

/* Returns whether a pattern has a set of n points. Where memory ran out it may; measuring it then says so. */
static bool has_size(const cli_curves *c, const cli_source *source, size_t n)
{
    koksma_points points;
    koksma_status status = koksma_points_init(&points, n, source->dim);
    status = status ? status : koksma_generate(&source->spec, c->seed, &c->work.run, &points);
    koksma_points_fini(&points);
    return !status || status == KOKSMA_MEMORY;
}

/* Chooses the sizes of a source: those of --sizes, or else the powers of four from 16 to n, and n, as far as the source
   has a set; a file, whose points may be no sequence, has only its n. Patterns with cells need square numbers, and powers
   of four are squares. Returns false after an error. */
static bool choose_sizes(const cli_curves *c, const cli_source *source, measuring *j)
{
    const char *text = cli_text(c->args, "sizes", NULL);
    j->by_size = text || source->is_pattern;
    if (text) {
        return cli_sizes(c->args, "sizes", text, "", KOKSMA_MAX_COORDINATES, j->prefixes, &j->n_prefixes);
    }
    for (size_t k = 16; source->is_pattern && k < source->n; k *= 4) {
        j->prefixes[j->n_prefixes] = k;
        j->n_prefixes += has_size(c, source, k);
    }
    if (source->is_pattern && (j->n_prefixes == 0 || has_size(c, source, source->n))) {
        j->prefixes[j->n_prefixes++] = source->n;
    }
    return true;
}

/* Adds a dashed line with the slope -theory, through the first point of the fitted line. what: the name of this slope
   in the legend. */
static void push_slopes(cli_chart_store *s, const koksma_line *line, double theory, const char *what)
{
    const koksma_curve *values = &s->curves[s->n - 1];
    double *numbers = cli_next_numbers(s);
    const double first = values->xs[0], last = values->xs[values->n - 1];
    const double start = exp(line->intercept + line->slope * log(first));
    char *label = s->labels[s->n];
    if (!isfinite(theory)) {
        return;
    }
    snprintf(label, CLI_CHART_LABEL, "slope -%.4g: %s", theory, what);
    numbers[0] = first;
    numbers[1] = last;
    numbers[s->per] = start;
    numbers[s->per + 1] = start * pow(last / first, -theory);
    cli_push_curve(s, 2, 0, label);
    s->curves[s->n - 1].dashed = true;
    s->curves[s->n - 1].errors = NULL;
}

/* Appends the fitted slope of a source to its label in the legend, with its standard error, which comes from the
   trials or, for one set, which is all that a deterministic pattern has, from the residuals. */
static void label_slope(char *label, const fitted *v, const koksma_line *line)
{
    if (line) {
        CLI_APPEND(label, CLI_CHART_LABEL, ": slope %.3f %s %.3f%s", line->slope,
                   v->joint.count > 1 ? "±" : "by residuals ±", line->slope_error,
                   v->n_cut > 0 ? ", of lower bounds" : "");
    } else if (v->n_cut > 0) {
        CLI_APPEND(label, CLI_CHART_LABEL, ": lower bounds");
    }
}

static int add_convergence(cli_curves *c, const koksma_spec *measure, const char *text, size_t colour,
                           cli_chart_store *s)
{
    cli_source source;
    double *numbers = cli_next_numbers(s);
    char *label = s->labels[s->n];
    koksma_line line;
    int dim = 0, code = cli_source_open(c->args, text, &source);
    measuring j = {.args = c->args,
                   .measures = {*measure},
                   .n_measures = 1,
                   .seed = c->seed,
                   .trials = c->trials,
                   .own_sets = true,
                   .work = c->work};
    cli_work_unknown(&c->work, "convergence"); /* the largest sets take most of the time */
    code = code || choose_sizes(c, &source, &j) ? code : CLI_USAGE;
    code = code || measuring_open(&j) ? code : cli_no_memory();
    code = code ? code : measuring_tally(&j, text, &dim);
    for (size_t i = 0; i < j.n_prefixes && !code; i++) {
        numbers[i] = (double)j.prefixes[i];
        numbers[s->per + i] = j.tallies[i].values.mean;
        numbers[2 * s->per + i] = koksma_tally_error(&j.tallies[i].values);
    }
    if (!code) {
        const bool is_fitted = koksma_joint_line(&j.fits[0].joint, j.n_prefixes, numbers, numbers + s->per, &line);
        char *n = strstr(cli_title(text, label), ", n = "), *d = n ? strstr(n, ", d = ") : NULL;
        if (n) { /* the x axis shows n */
            memmove(n, d ? d : "", d ? strlen(d) + 1 : 1);
        }
        label_slope(label, &j.fits[0], is_fitted ? &line : NULL);
        cli_tell_cuts(c->args, text, j.fits[0].n_cut);
        cli_push_curve(s, j.n_prefixes, colour, label);
        s->curves[s->n - 1].marks = true;
        const double rate = source.is_pattern ? koksma_rate(&source.spec, measure->measure, dim) : (double)NAN;
        const bool known = isfinite(rate);
        if (is_fitted) {
            push_slopes(s, &line, known ? rate : koksma_best_rate(measure->measure, dim),
                        known ? "theory, without logarithms" : "fastest possible decay, without logarithms");
        }
    }
    measuring_close(&j);
    return code;
}

typedef struct convergence {
    cli_chart_store store; /* the caller closes it, also after a failure */
    char title[160], y_label[160];
    koksma_chart chart;
} convergence;

/* Evaluates --measure for all operands at --sizes and makes the chart. Returns the exit code. */
static int open_convergence(cli_curves *c, convergence *v)
{
    const cli_args *args = c->args;
    const int n = args->n_operands;
    size_t colours[CLI_MAX_PANELS];
    koksma_spec measure;
    char text[KOKSMA_MAX_SPEC];
    *v = (convergence){0};
    const koksma_status status = koksma_measure_spec(cli_text(args, "measure", "l2-star"), &measure);
    int code = status                                                         ? cli_fail(args, status)
               : cli_open_store(&v->store, PER_SOURCE * (size_t)n, MAX_SIZES) ? CLI_YES
                                                                              : cli_no_memory();
    cli_colours(c, colours);
    for (int i = 0; i < n && !code; i++) {
        code = add_convergence(c, &measure, args->operands[i], colours[i], &v->store);
    }
    if (!code) {
        koksma_spec_text(&measure, text);
        snprintf(v->title, sizeof v->title, "Convergence of %.120s", text);
        snprintf(v->y_label, sizeof v->y_label, c->trials > 1 ? "%.120s, mean of %llu sets of a pattern" : "%.120s",
                 text, (unsigned long long)c->trials);
        v->chart = (koksma_chart){.x_label = "n",
                                  .y_label = v->y_label,
                                  .log_x = true,
                                  .log_y = true,
                                  .curves = v->store.curves,
                                  .n_curves = v->store.n};
    }
    return code;
}

static int draw(cli_curves *c)
{
    convergence v;
    int code = open_convergence(c, &v);
    code = code ? code : cli_write_chart(c, v.title, &v.chart);
    cli_close_store(&v.store);
    return code;
}

const cli_curve cli_curve_convergence = {
    .name = "convergence",
    .meaning =
        "the mean of a measure over trials against n on logarithmic axes, with the fitted slope and its standard "
        "error, from the trials or, for the one set of a deterministic pattern, from the residuals; a dashed line "
        "has the slope that theory gives for the pattern, or else the best possible slope; "
        "a file is measured by its first n points",
    .cite = "-",
    .plot = {.options = "measure sizes trials", .draw = draw, .mixes_files = true},
};

/* ---- compare ------------------------------------------------------------------------------------------------- */

enum { TRIALS = 10 };

typedef struct comparison {
    koksma_points points[CLI_MAX_PANELS];
    koksma_spectrum spectra[CLI_MAX_PANELS];
    koksma_panel panels[2][CLI_MAX_PANELS];
    char titles[CLI_MAX_PANELS][CLI_CHART_LABEL];
} comparison;

/* Prepares the panels of points and of power spectra for all sources. Returns the exit code. */
static int open_panels(cli_curves *c, comparison *m)
{
    size_t colours[CLI_MAX_PANELS];
    int code = CLI_YES;
    cli_colours(c, colours);
    for (int i = 0; i < c->args->n_operands && !code; i++) {
        const char *source = c->args->operands[i];
        struct stat info;
        const bool in_file = !cli_source_is_pattern(source) && !stat(source, &info);
        if (!strcmp(source, "-") || (in_file && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode))) {
            return cli_error(c->args,
                             "%s: %s reads its sources more than once, so it needs files instead of stdin and pipes",
                             source, c->curve->name);
        }
        cli_title(source, m->titles[i]);
        m->panels[0][i] = (koksma_panel){.points = &m->points[i], .title = m->titles[i], .swatch = 1 + colours[i]};
        m->panels[1][i] = (koksma_panel){.spectrum = &m->spectra[i], .title = m->titles[i], .swatch = 1 + colours[i]};
        code = cli_source_points(c->args, source, c->seed, &c->work.run, &m->points[i]);
        code = code ? code : cli_curves_spectrum(c, source, 2, &m->spectra[i]);
    }
    return code;
}

static int draw_comparison(cli_curves *c)
{
    const size_t n = (size_t)c->args->n_operands;
    comparison m = {0};
    convergence v = {0};
    cli_chart_store rings = {0};
    koksma_chart radial = {0};
    koksma_cell cells[2 * CLI_MAX_PANELS + 2] = {{0}};
    c->trials = cli_flag(c->args, "trials") ? c->trials : TRIALS;
    int code = open_panels(c, &m);
    code = code ? code : cli_chart_open(c, &cli_curve_rings, &rings, &radial);
    code = code ? code : open_convergence(c, &v);
    for (size_t i = 0; i < 2 * n; i++) {
        cells[i] = (koksma_cell){.panel = &m.panels[i / n][i % n], .row = i / n};
    }
    radial.title = cli_curve_rings.plot.title;
    v.chart.title = v.title;
    cells[2 * n] = (koksma_cell){.chart = &radial, .row = 2};
    cells[2 * n + 1] = (koksma_cell){.chart = &v.chart, .row = 2};
    code = code ? code : cli_write_figure(c, "Points, power spectra and convergence", cells, 2 * n + 2);
    for (size_t i = 0; i < n; i++) {
        koksma_points_fini(&m.points[i]);
        koksma_spectrum_fini(&m.spectra[i]);
    }
    cli_close_store(&rings);
    cli_close_store(&v.store);
    return code;
}

const cli_curve cli_curve_compare = {
    .name = "compare",
    .meaning = "compares several sources in one figure: their points, power spectra, radial means of the spectra, "
               "and convergence of a measure; the means are over 10 sets unless --trials is given",
    .cite = "-",
    .plot = {.options = "half exact measure sizes trials", .draw = draw_comparison, .mixes_files = true},
};
