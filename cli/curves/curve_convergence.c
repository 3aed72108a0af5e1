/* SPDX-License-Identifier: Apache-2.0 */
/*
 * convergence: a measure's mean over trials against n on logarithmic axes. A line is fitted by least squares to the
 * logarithms; the legend shows its slope and standard error. A dashed line has the slope that theory gives for the
 * pattern, or else the best slope that any points can have. The set of n points of a file consists of its first n
 * points.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../curves.h"
#include "../measuring.h"
#include "../source.h"

enum { MAX_SIZES = KOKSMA_MAX_SIZES, PER_SOURCE = 3 };

/* Returns whether a source has a set of n points. A file is taken to have one, its first n points. */
static bool has_size(const cli_curves *c, const cli_source *source, size_t n)
{
    koksma_points points = {0};
    const bool has = !source->is_pattern || (!koksma_points_init(&points, n, source->dim) &&
                                             !koksma_generate(&source->spec, c->seed, &c->work.run, &points));
    koksma_points_fini(&points);
    return has;
}

/* Chooses the sizes of a source: those of --sizes, or else the powers of four from 16 to n, and n, as far as the source
   has a set; a file, whose points may be no sequence, has only n. Patterns with cells need square numbers, and powers of
   four are squares. Returns false after an error. */
static bool choose_sizes(const cli_curves *c, const cli_source *source, size_t n, size_t *sizes, size_t *count)
{
    const char *text = cli_text(c->arguments, "sizes", NULL);
    *count = 0;
    for (size_t k = 16; !text && source->is_pattern && k < n; k *= 4) {
        sizes[*count] = k;
        *count += has_size(c, source, k);
    }
    if (!text && (*count == 0 || has_size(c, source, n))) {
        sizes[(*count)++] = n;
    }
    return !text || cli_sizes(c->arguments, "sizes", text, "", KOKSMA_MAX_COORDINATES, sizes, count);
}

/* Running statistics of a source's values over the trials, for each size. */
typedef struct means {
    size_t sizes[MAX_SIZES], count;
    koksma_tally tallies[MAX_SIZES];
    koksma_joint joint;
    size_t n_cut; /* values that are only bounds because the search was cut short */
} means;

/* Evaluates the measure on sets of all sizes: a pattern makes a set of n points for each n, a file has its first n
   points. Returns the exit code. */
static int tally_sizes(cli_curves *c, const koksma_spec *measure, const cli_source *source, const koksma_points *file,
                       means *v)
{
    koksma_status status = KOKSMA_OK;
    cli_work_unknown(&c->work, "convergence"); /* the largest sets take most of the time */
    for (uint64_t t = 0; t < (file ? 1 : c->trials) && !status; t++) {
        double values[MAX_SIZES];
        for (size_t i = 0; i < v->count && !status; i++) {
            koksma_points points = {0};
            koksma_value value = {0};
            if (!file) {
                status = koksma_points_init(&points, v->sizes[i], source->dim);
                status = status ? status : koksma_generate(&source->spec, c->seed + t, &c->work.run, &points);
            }
            if (!status) {
                status =
                    koksma_evaluate_prefixes(measure, file ? file : &points, &v->sizes[i], 1, &c->work.run, &value);
            }
            koksma_points_fini(&points);
            values[i] = value.value;
            v->n_cut += !status && cli_is_cut_short(measure, &value);
            if (!status) {
                koksma_tally_add(&v->tallies[i], value.value);
            }
        }
        if (!status && (t == 0 || !koksma_has_one_set(&source->spec))) {
            koksma_joint_add(&v->joint, v->count, values);
        }
    }
    cli_work_end();
    return status ? cli_fail(c->arguments, status) : CLI_YES;
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
static void label_slope(char *label, const means *v, const koksma_line *line)
{
    const size_t used = strlen(label);
    const char *error = v->joint.count > 1 ? "±" : "by residuals ±";
    const char *bounds = v->n_cut > 0 ? ", of lower bounds" : "";
    if (line) {
        snprintf(label + used, CLI_CHART_LABEL - used, ": slope %.3f %s %.3f%s", line->slope, error,
                 line->slope_error, bounds);
    } else if (v->n_cut > 0) {
        snprintf(label + used, CLI_CHART_LABEL - used, ": lower bounds");
    }
}

static int add_convergence(cli_curves *c, const koksma_spec *measure, const char *text, size_t colour,
                           cli_chart_store *s)
{
    cli_source source;
    koksma_points file = {0};
    double *numbers = cli_next_numbers(s);
    char *label = s->labels[s->n];
    means *v = calloc(1, sizeof *v);
    int code = v ? cli_source_open(c->arguments, text, &source) : cli_no_memory();
    if (!code && !source.is_pattern) {
        code = cli_source_points(c->arguments, text, 0, &c->work.run, &file);
    }
    if (!code && !choose_sizes(c, &source, source.is_pattern ? source.n : file.n, v->sizes, &v->count)) {
        code = CLI_USAGE;
    }
    code = code ? code : tally_sizes(c, measure, &source, source.is_pattern ? NULL : &file, v);
    const int dim = code ? 0 : source.is_pattern ? source.dim : file.dim;
    koksma_points_fini(&file);
    if (code) {
        free(v);
        return code;
    }
    for (size_t i = 0; i < v->count; i++) {
        numbers[i] = (double)v->sizes[i];
        numbers[s->per + i] = v->tallies[i].mean;
        numbers[2 * s->per + i] = koksma_tally_error(&v->tallies[i]);
    }
    koksma_line line;
    const bool fitted = koksma_joint_line(&v->joint, v->count, numbers, numbers + s->per, &line);
    char *n = strstr(cli_title(text, label), ", n = "), *d = n ? strstr(n, ", d = ") : NULL;
    if (n) { /* the x axis shows n */
        memmove(n, d ? d : "", d ? strlen(d) + 1 : 1);
    }
    label_slope(label, v, fitted ? &line : NULL);
    cli_tell_cuts(c->arguments, text, v->n_cut);
    const size_t count = v->count;
    free(v);
    cli_push_curve(s, count, colour, label);
    s->curves[s->n - 1].marks = true;
    if (fitted) {
        const double rate = source.is_pattern ? koksma_rate(&source.spec, measure->measure, dim) : (double)NAN;
        const bool known = isfinite(rate);
        push_slopes(s, &line, known ? rate : koksma_best_rate(measure->measure, dim),
                    known ? "theory, without logarithms" : "fastest possible decay, without logarithms");
    }
    return CLI_YES;
}

int cli_convergence_open(cli_curves *c, cli_convergence *v)
{
    const cli_arguments *arguments = c->arguments;
    const int n = arguments->n_operands;
    size_t colours[CLI_MAX_PANELS];
    koksma_spec measure;
    char text[KOKSMA_MAX_SPEC];
    *v = (cli_convergence){0};
    const koksma_status status = koksma_measure_spec(cli_text(arguments, "measure", "l2-star"), &measure);
    int code = status                                                         ? cli_fail(arguments, status)
               : cli_open_store(&v->store, PER_SOURCE * (size_t)n, MAX_SIZES) ? CLI_YES
                                                                              : cli_no_memory();
    cli_colours(c, colours);
    for (int i = 0; i < n && !code; i++) {
        code = add_convergence(c, &measure, arguments->operands[i], colours[i], &v->store);
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
    cli_convergence v;
    int code = cli_convergence_open(c, &v);
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
