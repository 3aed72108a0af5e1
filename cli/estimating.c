/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Estimates of integrals from replicates: one row for each step of koksma_integrate_to. Without --tolerance there is one
 * step, of the size that the operand gives. With it the steps are the path to the tolerance, and a row tells how it
 * ended. Where the integral is known, the rows have the difference from it, and whether the interval holds it.
 */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "integrating.h"

enum { REPLICATES = 15, MOST_REPLICATES = 100000, DIGITS = 9 };

static const char *const names[] = {"tolerance",  "estimator", "interval", "replicates",
                                    "confidence", "range",     "with"};

/* Opens integrand i of the first operand, which is "all" or a list. *end: whether i is past the end. *out is NULL
   past the end, and for an integrand of "all" that does not exist in this dimension. Returns the exit code. */
static int open_integrand(const cli_args *args, size_t i, int dim, bool *end, koksma_integral **out)
{
    const char *list = args->operands[0];
    const bool every = !strcmp(list, "all");
    const koksma_integrand *member = every ? koksma_integrand_at(i) : NULL;
    char item[KOKSMA_MAX_SPEC];
    *out = NULL;
    *end = every ? !member : !cli_list_item(list, i, item, sizeof item);
    if (*end) {
        return CLI_YES;
    }
    const koksma_status status = koksma_integral_open(every ? member->name : item, dim, out);
    return status && !(every && status == KOKSMA_DIM) ? cli_fail(args, status) : CLI_YES;
}

int cli_integrands_each(const cli_args *args, int dim, int (*f)(const koksma_integral *integral, void *context),
                        void *context)
{
    int code = CLI_YES;
    bool end = false;
    for (size_t i = 0; !code && !end; i++) {
        koksma_integral *integral;
        code = open_integrand(args, i, dim, &end, &integral);
        if (!code && integral) {
            code = f(integral, context);
        }
        koksma_integral_close(integral);
    }
    return code;
}

typedef struct estimating {
    const cli_args *args;
    cli_work work;
    cli_source source; /* of the present rows */
    koksma_tolerance_options options;
    size_t searches; /* that were begun */
    bool to_tolerance, has_range;
    koksma_values_command command; /* command.command: NULL without --with */
    bool missed;                   /* a tolerance was not reached */
} estimating;

bool cli_estimates(const cli_args *args)
{
    bool any = cli_flag(args, "relative") || cli_text(args, "max-points", NULL) || cli_text(args, "resume", NULL);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        any = any || cli_text(args, names[i], NULL);
    }
    return any;
}

/* Reads "LOW,HIGH". */
static bool read_range(estimating *e)
{
    const char *text = cli_text(e->args, "range", NULL);
    double range[2];
    e->has_range = text;
    if (!text) {
        return true;
    }
    if (cli_reals(text, -DBL_MAX, DBL_MAX, range, 2) != 2 || !(range[0] < range[1])) {
        return !cli_error(e->args, "--range %s: it takes two numbers, the lower one first, such as 0,1", text);
    }
    e->options.estimate.lowest = range[0];
    e->options.estimate.highest = range[1];
    return true;
}

/* Reads the options. Returns false after an error. */
static bool read_options(estimating *e)
{
    const cli_args *args = e->args;
    koksma_tolerance_options *o = &e->options;
    double tolerance = 0;
    uint64_t replicates;
    e->to_tolerance = cli_text(args, "tolerance", NULL);
    e->command = (koksma_values_command){.command = cli_text(args, "with", NULL), .run = &e->work.run};
    o->estimate.estimator = cli_text(args, "estimator", NULL);
    o->estimate.interval = cli_text(args, "interval", NULL);
    if (!e->to_tolerance && !cli_refuse(args, "relative max-points resume", "has an effect only with --tolerance")) {
        return false;
    }
    if (!cli_refuse(args, "trials", "has no effect on estimates; their number of sets is --replicates") ||
        !cli_whole(args, "seed", 0, 0, UINT64_MAX, &o->seed) ||
        !cli_real(args, "tolerance", 0, 1e-300, 1e300, &tolerance) ||
        !cli_real(args, "confidence", 0.95, 1e-9, 1 - 1e-12, &o->estimate.confidence) ||
        !cli_real(args, "exec-seconds", 60, 1e-3, 86400, &e->command.seconds) ||
        !cli_whole(args, "replicates", e->to_tolerance ? 0 : REPLICATES, 2, MOST_REPLICATES, &replicates) ||
        !cli_whole(args, "max-points", 0, 2, UINT64_C(1) << 40, &o->most_points) || !read_range(e) ||
        (replicates > 1 && !cli_seeds_fit(args, o->seed, replicates))) {
        return false;
    }
    if (o->estimate.confidence < 0.5) {
        cli_note(args,
                 "warning: --confidence %g: the interval misses the integral more often than not; 0.95 is 95 %%",
                 o->estimate.confidence);
    }
    o->replicates = (size_t)replicates;
    o->resume = cli_text(args, "resume", NULL);
    if (!cli_text(args, "digits", NULL)) { /* those of an estimate, which has more than its error */
        cli_set_style(DIGITS, cli_flag(args, "long"));
    }
    *(cli_flag(args, "relative") ? &o->relative : &o->absolute) = tolerance;
    return true;
}

/* Opens operand i, a pattern, with its size and dimension; without a size the tolerance chooses it. i past the last
   operand: the default pattern. Returns the exit code. */
static int open_source(estimating *e, int i)
{
    cli_source *source = &e->source;
    const cli_args *args = e->args;
    const char *text = i < args->n_operands ? args->operands[i] : CLI_USUAL_PATTERN;
    uint64_t dim;
    if (i >= args->n_operands && !e->to_tolerance) {
        return cli_error(args, "an estimate takes points, as in disk -p %s -n 1024, or --tolerance",
                         CLI_USUAL_PATTERN);
    }
    int code = cli_pattern_open(args, text, source);
    if (!code && !source->n && !e->to_tolerance) {
        code = cli_error(args, "%s: it lacks @N, the number of points", text);
    }
    if (!code && !source->dim) {
        code = cli_whole(args, "dim", 2, 1, KOKSMA_MAX_DIM, &dim) ? CLI_YES : CLI_USAGE;
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
    const koksma_integral_estimate *found = &step->estimate;
    cli_row("integrand %s source %s n %zu dim %d replicates %zu parts? %d points %llu estimate %g "
            "error %g low %g high %g confidence %g estimator %s interval %s integral %g off %g holds? %d\n",
            p->name, p->pattern, step->n, e->source.dim, t->replicates, t->parts, (unsigned long long)step->points,
            found->value, found->error, found->low, found->high, found->confidence, found->estimator, found->interval,
            p->truth, found->value - p->truth,
            isnan(p->truth) ? -1 : found->low <= p->truth && p->truth <= found->high);
}

static void put_end(const estimating *e, const printed *p, const koksma_tolerance *t)
{
    const koksma_tolerance_step *last = &t->steps[t->n_steps - 1];
    cli_row("tolerance_of %s source %s dim %d tolerance %g relative? %d reached? %d estimate %g "
            "error %g points %llu rate %g rate_error %g needed %g needed_low %g needed_high %g\n",
            p->name, p->pattern, e->source.dim, fmax(e->options.absolute, e->options.relative),
            e->options.relative > 0, t->reached, last->estimate.value, last->estimate.error,
            (unsigned long long)last->points, t->rate, t->rate_error, t->reached ? (double)NAN : t->needed,
            t->reached ? (double)NAN : t->needed_low, t->reached ? (double)NAN : t->needed_high);
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
    if (cli_flag(e->args, "quiet")) {
        return;
    }
    if (t->least == t->largest && points > 1 && e->command.command) {
        cli_say(e->args->command->name, "warning: all values are %g; the program gets %d numbers a line (-d)",
                t->least, e->source.dim);
    } else if (points >= 4096 && t->top_share > 0.02) {
        cli_say(e->args->command->name,
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
        return cli_error(e->args, "--resume %s: a file has one integrand with one pattern", o.resume);
    }
    if (facts.value == 0 && o.relative > 0) {
        return cli_error(e->args, "--relative: the integral of %s is 0, and no error is small beside it", p.name);
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
    return status ? cli_fail(e->args, status) : CLI_YES;
}

int cli_run_estimates(const cli_args *args)
{
    const bool command = cli_text(args, "with", NULL);
    const int first = command ? 0 : 1;
    estimating e = {.args = args};
    if (args->n_operands < first) {
        return cli_error(args, "it takes an integrand, or --with PROGRAM; 'koksma list integrands' names them");
    }
    if (!cli_work_begin(args, "integrating", &e.work) || !read_options(&e)) {
        return CLI_USAGE;
    }
    for (int i = first; i < args->n_operands; i++) {
        const char *operand = args->operands[i];
        if (!cli_source_is_pattern(operand) && !cli_names_pattern(operand) && !access(operand, R_OK)) {
            return cli_error(args,
                             "%s is one set, whose error no interval knows; -p file:%s,shift=1 shifts it at random",
                             operand, operand);
        }
    }
    const int end = args->n_operands > first ? args->n_operands : first + 1;
    int code = CLI_YES;
    for (int i = first; i < end && !code; i++) {
        cli_work_part(&e.work, (size_t)(i - first), (size_t)(end - first));
        code = open_source(&e, i);
        if (!code) {
            code = command ? put_estimate(NULL, &e) : cli_integrands_each(args, e.source.dim, put_estimate, &e);
        }
    }
    cli_work_end();
    return cli_rows_close(code ? code : e.missed ? CLI_NO : CLI_YES);
}
