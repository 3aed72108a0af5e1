/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Estimates of integrals from replicates: one row for each step of koksma_integrate_to. Without --tolerance there is one
 * step, of the size that the operand gives. With it the steps are the path to the tolerance, and a row tells how it
 * ended. Where the integral is known, the rows have the difference from it, and whether the interval holds it.
 */
#include "integrating.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { REPLICATES = 15, MOST_REPLICATES = 100000, DIGITS = 9 };

static const char *const names[] = {"tolerance",  "estimator", "interval", "replicates",
                                    "confidence", "range",     "with"};

typedef struct estimating {
    const cli_arguments *arguments;
    cli_work work;
    cli_rows *rows;
    cli_source source; /* of the present rows */
    koksma_tolerance_options options;
    size_t searches; /* that were begun */
    bool to_tolerance, has_range;
    koksma_values_command command; /* command.command: NULL without --with */
    bool missed;                   /* a tolerance was not reached */
} estimating;

bool cli_estimates(const cli_arguments *arguments)
{
    bool any = cli_flag(arguments, "relative") || cli_text(arguments, "max-points", NULL) ||
               cli_text(arguments, "resume", NULL);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        any = any || cli_text(arguments, names[i], NULL);
    }
    return any;
}

/* Reads "LOW,HIGH". */
static bool read_range(estimating *e)
{
    const char *text = cli_text(e->arguments, "range", NULL);
    char *end = NULL;
    if (!text) {
        return true;
    }
    koksma_estimate_options *o = &e->options.estimate;
    e->has_range = true;
    o->lowest = strtod(text, &end);
    bool good = end != text && *end == ',';
    if (good) {
        text = end + 1;
        o->highest = strtod(text, &end);
        good = end != text && !*end && isfinite(o->lowest) && isfinite(o->highest) && o->lowest < o->highest;
    }
    if (!good) {
        cli_usage_error(e->arguments, "--range %s: it takes two numbers, the lower one first, such as 0,1",
                        cli_text(e->arguments, "range", NULL));
    }
    return good;
}

/* Reads the options. Returns false after an error. */
static bool read_options(estimating *e)
{
    const cli_arguments *arguments = e->arguments;
    koksma_tolerance_options *o = &e->options;
    double tolerance = 0;
    uint64_t replicates;
    e->to_tolerance = cli_text(arguments, "tolerance", NULL);
    e->command = (koksma_values_command){.command = cli_text(arguments, "with", NULL), .run = &e->work.run};
    o->estimate.estimator = cli_text(arguments, "estimator", NULL);
    o->estimate.interval = cli_text(arguments, "interval", NULL);
    if (!e->to_tolerance &&
        !cli_refuse(arguments, "relative max-points resume", "has an effect only with --tolerance")) {
        return false;
    }
    if (!cli_refuse(arguments, "trials", "has no effect on estimates; their number of sets is --replicates") ||
        !cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &o->seed) ||
        !cli_real(arguments, "tolerance", 0, 1e-300, 1e300, &tolerance) ||
        !cli_real(arguments, "confidence", 0.95, 1e-9, 1 - 1e-12, &o->estimate.confidence) ||
        !cli_real(arguments, "exec-seconds", 60, 1e-3, 86400, &e->command.seconds) ||
        !cli_whole(arguments, "replicates", e->to_tolerance ? 0 : REPLICATES, 2, MOST_REPLICATES, &replicates) ||
        !cli_whole(arguments, "max-points", 0, 2, UINT64_C(1) << 40, &o->most_points) || !read_range(e) ||
        (replicates > 1 && !cli_seeds_fit(arguments, o->seed, replicates))) {
        return false;
    }
    if (o->estimate.confidence < 0.5 && !cli_given(arguments, "quiet")) {
        cli_say("integrate",
                "warning: --confidence %g: the interval misses the integral more often than not; 0.95 is 95 %%",
                o->estimate.confidence);
    }
    o->replicates = (size_t)replicates;
    o->resume = cli_text(arguments, "resume", NULL);
    if (!cli_text(arguments, "digits", NULL)) { /* those of an estimate, which has more than its error */
        cli_set_style(DIGITS, cli_flag(arguments, "long"));
    }
    *(cli_flag(arguments, "relative") ? &o->relative : &o->absolute) = tolerance;
    return true;
}

/* Opens operand i, a pattern, with its size and dimension; without a size the tolerance chooses it. i past the last
   operand: the default pattern. Returns the exit code. */
static int open_source(estimating *e, int i)
{
    cli_source *source = &e->source;
    const cli_arguments *arguments = e->arguments;
    const char *text = i < arguments->n_operands ? arguments->operands[i] : CLI_USUAL_PATTERN;
    uint64_t dim;
    if (i >= arguments->n_operands && !e->to_tolerance) {
        return cli_usage_error(arguments, "an estimate takes points, as in disk -p %s -n 1024, or --tolerance",
                               CLI_USUAL_PATTERN);
    }
    int code = cli_pattern_open(arguments, text, source);
    if (!code && !source->n && !e->to_tolerance) {
        code = cli_usage_error(arguments, "%s: it lacks @N, the number of points", text);
    }
    if (!code && !source->dim) {
        code = cli_whole(arguments, "dim", 2, 1, KOKSMA_MAX_DIM, &dim) ? CLI_YES : CLI_USAGE;
        source->dim = code ? 0 : (int)dim;
    }
    return code;
}

/* What is printed of an integral. */
typedef struct printed {
    char name[KOKSMA_MAX_SPEC], pattern[KOKSMA_MAX_SPEC];
    double truth; /* NaN: unknown */
} printed;

static koksma_status values_of(void *context, const koksma_points *points, double *values)
{
    void *const *all = context;
    return koksma_integral_values(all[0], points, all[1], values);
}

static void put_step(const estimating *e, const printed *p, const koksma_tolerance *t, size_t k)
{
    const koksma_tolerance_step *step = &t->steps[k];
    cli_rows *rows = e->rows;
    const koksma_integral_estimate *found = &step->estimate;
    cli_row_text(rows, "integrand", p->name);
    cli_row_text(rows, "source", p->pattern);
    cli_row_whole(rows, "n", step->n);
    cli_row_whole(rows, "dim", (uint64_t)e->source.dim);
    cli_row_whole(rows, "replicates", t->replicates);
    cli_row_flag(rows, "parts", t->parts);
    cli_row_whole(rows, "points", step->points);
    cli_row_number(rows, "estimate", found->value);
    cli_row_number(rows, "error", found->error);
    cli_row_number(rows, "low", found->low);
    cli_row_number(rows, "high", found->high);
    cli_row_number(rows, "confidence", found->confidence);
    cli_row_text(rows, "estimator", found->estimator);
    cli_row_text(rows, "interval", found->interval);
    cli_row_number(rows, "integral", p->truth);
    cli_row_number(rows, "off", found->value - p->truth);
    if (isnan(p->truth)) {
        cli_row_json(rows, "holds", "null", "-");
    } else {
        cli_row_flag(rows, "holds", found->low <= p->truth && p->truth <= found->high);
    }
    cli_row_end(rows);
}

static void put_end(const estimating *e, const printed *p, const koksma_tolerance *t)
{
    cli_rows *rows = e->rows;
    const koksma_tolerance_step *last = &t->steps[t->n_steps - 1];
    cli_row_text(rows, "tolerance_of", p->name);
    cli_row_text(rows, "source", p->pattern);
    cli_row_whole(rows, "dim", (uint64_t)e->source.dim);
    cli_row_number(rows, "tolerance", fmax(e->options.absolute, e->options.relative));
    cli_row_flag(rows, "relative", e->options.relative > 0);
    cli_row_flag(rows, "reached", t->reached);
    cli_row_number(rows, "estimate", last->estimate.value);
    cli_row_number(rows, "error", last->estimate.error);
    cli_row_whole(rows, "points", last->points);
    cli_row_number(rows, "rate", t->rate);
    cli_row_number(rows, "rate_error", t->rate_error);
    cli_row_number(rows, "needed", t->reached ? (double)NAN : t->needed);
    cli_row_number(rows, "needed_low", t->reached ? (double)NAN : t->needed_low);
    cli_row_number(rows, "needed_high", t->reached ? (double)NAN : t->needed_high);
    cli_row_end(rows);
}

/* Takes the bounds of an integrand of the table where the interval needs them and --range gives none. */
static void take_bounds(koksma_estimate_options *o, const koksma_integral_facts *facts)
{
    const koksma_interval *interval = o->interval ? koksma_interval_find(o->interval) : NULL;
    if (interval && interval->bounded && isfinite(facts->lowest) && isfinite(facts->highest)) {
        const double slack = 1e-12 * fmax(fabs(facts->lowest), fabs(facts->highest)); /* values are rounded */
        o->lowest = facts->lowest - slack;
        o->highest = facts->highest + slack;
    }
}

/* Says what of the values makes the estimate doubtful. */
static void tell_values(const estimating *e, const printed *p, const koksma_tolerance *t)
{
    const uint64_t points = t->steps[t->n_steps - 1].points;
    const double largest = fabs(t->largest) > fabs(t->least) ? t->largest : t->least;
    if (cli_flag(e->arguments, "quiet")) {
        return;
    }
    if (t->least == t->largest && points > 1 && e->command.command) {
        cli_say(e->arguments->command->name, "warning: all values are %g; the program gets %d numbers a line (-d)",
                t->least, e->source.dim);
    } else if (points >= 4096 && t->top_share > 0.02) {
        cli_say(e->arguments->command->name,
                "warning: %s: one value, %.3g, is %.0f %% of the sum: the integral may be infinite, or its peak is "
                "narrow",
                p->name, largest, 100 * t->top_share);
    }
}

/* Estimates the integral and prints the steps. integral: NULL with --with. Returns the exit code. */
static int put_estimate(const koksma_integral *integral, void *context)
{
    estimating *e = context;
    const cli_source *source = &e->source;
    printed p = {.truth = NAN};
    koksma_tolerance_options o = e->options;
    koksma_integral_facts facts = {.lowest = NAN, .highest = NAN};
    if (integral) {
        koksma_integral_about(integral, &facts);
        p.truth = facts.value;
    }
    snprintf(p.name, sizeof p.name, "%s", integral ? facts.text : cli_one_line(e->command.command));
    koksma_spec_text(&source->spec, p.pattern);
    if (!e->has_range) {
        take_bounds(&o.estimate, &facts);
    }
    if (o.resume && e->searches++) {
        return cli_usage_error(e->arguments, "--resume %s: a file has one integrand with one pattern", o.resume);
    }
    if (facts.value == 0 && o.relative > 0) {
        return cli_usage_error(e->arguments, "--relative: the integral of %s is 0, and no error is small beside it",
                               p.name);
    }
    o.function = p.name;
    o.first_n = source->n;
    o.most_points = e->to_tolerance ? o.most_points : (uint64_t)o.replicates * source->n;
    koksma_tolerance *t = malloc(sizeof *t);
    if (!t) {
        return cli_no_memory();
    }
    const void *both[] = {integral, &e->work.run};
    const koksma_status status =
        koksma_integrate_to(integral ? values_of : koksma_values_by_command, integral ? (void *)both : &e->command,
                            source->dim, &source->spec, &o, &e->work.run, t);
    for (size_t i = 0; i < t->n_steps && !status; i++) {
        put_step(e, &p, t, i);
    }
    if (!status) {
        tell_values(e, &p, t);
    }
    if (!status && e->to_tolerance) {
        put_end(e, &p, t);
        e->missed = e->missed || !t->reached;
    }
    free(t);
    return status ? cli_fail(e->arguments, status) : CLI_YES;
}

int cli_run_estimates(const cli_arguments *arguments)
{
    const bool command = cli_text(arguments, "with", NULL);
    const int first = command ? 0 : 1;
    estimating e = {.arguments = arguments};
    if (arguments->n_operands < first) {
        return cli_usage_error(arguments,
                               "it takes an integrand, or --with PROGRAM; 'koksma list integrands' names them");
    }
    if (!cli_work_begin(arguments, "integrating", &e.work) || !read_options(&e)) {
        return CLI_USAGE;
    }
    for (int i = first; i < arguments->n_operands; i++) {
        const char *operand = arguments->operands[i];
        if (!cli_source_is_pattern(operand) && !cli_names_pattern(operand) && !access(operand, R_OK)) {
            return cli_usage_error(
                arguments, "%s is one set, whose error no interval knows; -p file:%s,shift=1 shifts it at random",
                operand, operand);
        }
    }
    const int end = arguments->n_operands > first ? arguments->n_operands : first + 1;
    int code = CLI_YES;
    e.rows = cli_rows_open(cli_flag(arguments, "json"));
    for (int i = first; i < end && !code; i++) {
        cli_work_part(&e.work, (size_t)(i - first), (size_t)(end - first));
        code = open_source(&e, i);
        if (!code) {
            code = command ? put_estimate(NULL, &e) : cli_integrands_each(arguments, e.source.dim, put_estimate, &e);
        }
    }
    cli_work_end();
    return cli_rows_close(e.rows, code ? code : e.missed ? CLI_NO : CLI_YES);
}
