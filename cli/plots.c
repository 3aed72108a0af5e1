/* SPDX-License-Identifier: Apache-2.0 */
#include "plots.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bounds.h"
#include "slope.h"
#include "source.h"

enum { MAX_SIZES = CLI_MAX_SIZES, PER_SOURCE = 3, LABEL = 160 };

const char *plot_label(const char *source)
{
    return strncmp(source, "pattern:", 8) == 0 ? source + 8 : source;
}

static int write_picture(const plot_job *j, koksma_status status, unsigned char *bytes, size_t n_bytes)
{
    if (!status) {
        status = koksma_plot_write(j->output, bytes, n_bytes);
        free(bytes);
    }
    return status ? cli_fail(j->curves.arguments, status) : CLI_YES;
}

int plot_panels(const plot_job *j, const koksma_panel *panels, size_t n)
{
    unsigned char *bytes = NULL;
    size_t n_bytes = 0;
    const koksma_status status = koksma_plot_panels(panels, n, (double)j->size, j->format, &bytes, &n_bytes);
    return write_picture(j, status, bytes, n_bytes);
}

int plot_chart(const plot_job *j, koksma_chart *chart)
{
    unsigned char *bytes = NULL;
    size_t n_bytes = 0;
    chart->size = (double)j->size;
    const koksma_status status = koksma_plot_chart(chart, j->format, &bytes, &n_bytes);
    return write_picture(j, status, bytes, n_bytes);
}

/* Room for the numbers of a chart's curves: three lists of `per` numbers each. */
typedef struct store {
    koksma_curve *curves;
    double *numbers;
    char (*labels)[LABEL];
    size_t n, per;
} store;

static bool open_store(store *s, size_t n, size_t per)
{
    *s = (store){calloc(n, sizeof(koksma_curve)), calloc(3 * n * per, sizeof(double)), calloc(n, LABEL), 0, per};
    return s->curves && s->numbers && s->labels;
}

static void close_store(store *s)
{
    free(s->curves);
    free(s->numbers);
    free(s->labels);
}

/* The next curve's lists: xs, ys and errors. */
static double *next_numbers(const store *s)
{
    return s->numbers + 3 * s->per * s->n;
}

static void push_curve(store *s, size_t n, size_t colour, const char *label)
{
    double *numbers = next_numbers(s);
    s->curves[s->n++] = (koksma_curve){.label = label,
                                       .n = n,
                                       .xs = numbers,
                                       .ys = numbers + s->per,
                                       .errors = numbers + 2 * s->per,
                                       .colour = colour};
}

int plot_radial(plot_job *j)
{
    const cli_arguments *arguments = j->curves.arguments;
    const bool anisotropy = !strcmp(j->curve, "anisotropy");
    store s;
    int code = open_store(&s, (size_t)arguments->n_operands, KOKSMA_SPECTRUM_MAX_HALF) ? CLI_YES : cli_no_memory();
    koksma_ring *rings = calloc(KOKSMA_SPECTRUM_MAX_HALF, sizeof *rings);
    for (int i = 0; i < arguments->n_operands && !code && rings; i++) {
        koksma_spectrum spectrum;
        code = cli_curves_spectrum(&j->curves, arguments->operands[i], 2, &spectrum);
        const koksma_status status = code ? KOKSMA_OK : koksma_spectrum_rings(&spectrum, rings);
        code = status ? cli_fail(arguments, status) : code;
        double *numbers = next_numbers(&s);
        for (int r = 0; r < spectrum.half && !code; r++) {
            numbers[r] = rings[r].frequency / sqrt(spectrum.points);
            numbers[s.per + (size_t)r] = anisotropy ? rings[r].anisotropy_db : rings[r].power;
            numbers[2 * s.per + (size_t)r] = anisotropy ? 0 : rings[r].standard_error;
        }
        push_curve(&s, code ? 0 : (size_t)spectrum.half, (size_t)i, plot_label(arguments->operands[i]));
        koksma_spectrum_fini(&spectrum);
    }
    if (!code && rings) {
        /* The variance of the mean of T random sets' powers, which are exponential, is 1/T along a ring. */
        koksma_chart chart = {.x_label = "frequency / sqrt(n)",
                              .y_label = anisotropy ? "anisotropy [dB]; dashed: of random points"
                                                    : "power, mean over rings; dashed: 1 of random points",
                              .curves = s.curves,
                              .n_curves = s.n,
                              .has_level = true,
                              .level = anisotropy ? -10 * log10((double)j->curves.trials) : 1};
        code = plot_chart(j, &chart);
    }
    free(rings);
    close_store(&s);
    return code;
}

int plot_pairs(plot_job *j)
{
    const cli_arguments *arguments = j->curves.arguments;
    const size_t bins = j->curves.bins;
    store s;
    koksma_tally *tallies = malloc(bins * sizeof *tallies);
    int code = open_store(&s, (size_t)arguments->n_operands, bins) && tallies ? CLI_YES : cli_no_memory();
    for (int i = 0; i < arguments->n_operands && !code; i++) {
        double r_max, *numbers = next_numbers(&s);
        memset(tallies, 0, bins * sizeof *tallies);
        code = cli_curves_pairs(&j->curves, arguments->operands[i], tallies, &r_max);
        for (size_t b = 0; b < bins && !code; b++) {
            numbers[b] = ((double)b + 0.5) * r_max / (double)bins;
            numbers[bins + b] = tallies[b].mean;
            numbers[2 * bins + b] = koksma_tally_error(&tallies[b]);
        }
        push_curve(&s, bins, (size_t)i, plot_label(arguments->operands[i]));
    }
    if (!code) {
        koksma_chart chart = {.x_label = "distance on the torus",
                              .y_label = "pair correlation; dashed: 1 of random points",
                              .curves = s.curves,
                              .n_curves = s.n,
                              .has_level = true,
                              .level = 1};
        code = plot_chart(j, &chart);
    }
    free(tallies);
    close_store(&s);
    return code;
}

/* --sizes, or powers of four from 16 (squares: patterns with cells have them) up to the source's n. */
static bool choose_sizes(const plot_job *j, size_t n, size_t *sizes, size_t *count)
{
    const char *text = cli_text(j->curves.arguments, "sizes", NULL);
    *count = 0;
    for (size_t k = 16; !text && k <= n; k *= 4) {
        sizes[(*count)++] = k;
    }
    while (text && *text) {
        char *end;
        const unsigned long long k = strtoull(text, &end, 10);
        if (*text < '0' || *text > '9' || k == 0 || (*end && *end != ',') || *count == MAX_SIZES) {
            cli_usage_error(j->curves.arguments, "--sizes %s: it takes up to %d numbers as in 16,64,256", text,
                            MAX_SIZES);
            return false;
        }
        sizes[(*count)++] = k;
        text = *end ? end + 1 : end;
    }
    return true;
}

/* A source's means over trials by size. */
typedef struct convergence {
    size_t sizes[MAX_SIZES], count;
    koksma_tally tallies[MAX_SIZES];
    cli_joint joint;
    size_t n_cut; /* values that are bounds, as the search was cut short */
} convergence;

/* Values over sets of n points: a pattern's own sets of n, the first n of a file. */
static int tally_sizes(plot_job *j, const koksma_spec *measure, const cli_source *source, const koksma_points *file,
                       convergence *c)
{
    koksma_status status = KOKSMA_OK;
    for (uint64_t t = 0; t < (file ? 1 : j->curves.trials) && !status; t++) {
        double values[MAX_SIZES];
        for (size_t i = 0; i < c->count && !status; i++) {
            koksma_points points = {0};
            koksma_value value = {0};
            if (!file) {
                status = koksma_points_init(&points, c->sizes[i], source->dim);
                status = status ? status
                                : koksma_generate(&source->spec, j->curves.seed + t, &j->curves.work.run, &points);
            }
            if (!status) {
                status = koksma_evaluate_prefixes(measure, file ? file : &points, &c->sizes[i], 1,
                                                  &j->curves.work.run, &value);
            }
            koksma_points_fini(&points);
            values[i] = value.value;
            c->n_cut += !status && cli_is_cut_short(measure, &value);
            if (!status) {
                koksma_tally_add(&c->tallies[i], value.value);
            }
        }
        if (!status) {
            cli_joint_add(&c->joint, c->count, values);
        }
    }
    cli_work_end(&j->curves.work);
    return status ? cli_fail(j->curves.arguments, status) : CLI_YES;
}

/* The fitted slope for the legend; the slope of theory through the fit's first point, dashed. */
static void push_slopes(store *s, const koksma_line *line, double theory, const char *what)
{
    const koksma_curve *values = &s->curves[s->n - 1];
    double *numbers = next_numbers(s);
    const double first = values->xs[0], last = values->xs[values->n - 1];
    const double start = exp(line->intercept + line->slope * log(first));
    char *label = s->labels[s->n];
    if (!isfinite(theory)) {
        return;
    }
    snprintf(label, LABEL, "slope -%.4g: %s", theory, what);
    numbers[0] = first;
    numbers[1] = last;
    numbers[s->per] = start;
    numbers[s->per + 1] = start * pow(last / first, -theory);
    push_curve(s, 2, 0, label);
    s->curves[s->n - 1].dashed = true;
    s->curves[s->n - 1].errors = NULL;
}

/* What the legend says of a source: its slope, with the trials' standard error or one set's residuals. */
static void label_slope(char *label, const convergence *c, const koksma_line *line)
{
    const size_t used = strlen(label);
    const char *error = c->joint.count > 1 ? "+-" : "by residuals +-";
    const char *bounds = c->n_cut > 0 ? ", of lower bounds" : "";
    if (line) {
        snprintf(label + used, LABEL - used, ": slope %.3f %s %.3f%s", line->slope, error, line->slope_error, bounds);
    } else if (c->n_cut > 0) {
        snprintf(label + used, LABEL - used, ": lower bounds");
    }
}

static int add_convergence(plot_job *j, const koksma_spec *measure, const char *text, size_t colour, store *s)
{
    cli_source source;
    koksma_points file = {0};
    double *numbers = next_numbers(s);
    char *label = s->labels[s->n];
    convergence *c = calloc(1, sizeof *c);
    int code = c ? cli_source_open(j->curves.arguments, text, &source) : cli_no_memory();
    if (!code && !source.is_pattern) {
        code = cli_source_points(j->curves.arguments, text, 0, &j->curves.work.run, &file);
    }
    if (!code && !choose_sizes(j, source.is_pattern ? source.n : file.n, c->sizes, &c->count)) {
        code = CLI_USAGE;
    }
    code = code ? code : tally_sizes(j, measure, &source, source.is_pattern ? NULL : &file, c);
    const int dim = code ? 0 : source.is_pattern ? source.dim : file.dim;
    koksma_points_fini(&file);
    if (code) {
        free(c);
        return code;
    }
    for (size_t i = 0; i < c->count; i++) {
        numbers[i] = (double)c->sizes[i];
        numbers[s->per + i] = c->tallies[i].mean;
        numbers[2 * s->per + i] = koksma_tally_error(&c->tallies[i]);
    }
    koksma_line line;
    const bool fitted = cli_slope(c->count, numbers, numbers + s->per, &c->joint, &line);
    snprintf(label, LABEL, "%.80s", plot_label(text));
    label_slope(label, c, fitted ? &line : NULL);
    cli_tell_cuts(j->curves.arguments, text, c->n_cut);
    const size_t count = c->count;
    free(c);
    push_curve(s, count, colour, label);
    s->curves[s->n - 1].marks = true;
    if (fitted) {
        const double rate = source.is_pattern ? koksma_rate(&source.spec, measure->measure, dim) : (double)NAN;
        const bool known = isfinite(rate);
        push_slopes(s, &line, known ? rate : koksma_best_rate(measure->measure, dim),
                    known ? "theory, without logarithms" : "no points are faster, logarithms aside");
    }
    return CLI_YES;
}

int plot_convergence(plot_job *j)
{
    const cli_arguments *arguments = j->curves.arguments;
    koksma_spec measure;
    char y_label[KOKSMA_MAX_SPEC + 64];
    store s;
    koksma_status status = koksma_measure_spec(cli_text(arguments, "measure", "l2-star"), &measure);
    if (status) {
        return cli_fail(arguments, status);
    }
    int code = open_store(&s, PER_SOURCE * (size_t)arguments->n_operands, MAX_SIZES) ? CLI_YES : cli_no_memory();
    for (int i = 0; i < arguments->n_operands && !code; i++) {
        code = add_convergence(j, &measure, arguments->operands[i], (size_t)i, &s);
    }
    if (!code) {
        koksma_spec_text(&measure, y_label);
        if (j->curves.trials > 1) {
            const size_t used = strlen(y_label);
            snprintf(y_label + used, sizeof y_label - used, ", mean of %llu sets",
                     (unsigned long long)j->curves.trials);
        }
        koksma_chart chart = {
            .x_label = "n", .y_label = y_label, .log_x = true, .log_y = true, .curves = s.curves, .n_curves = s.n};
        code = plot_chart(j, &chart);
    }
    close_store(&s);
    return code;
}
