/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma integrate`: estimates integrals of functions by means over point sets and prints the errors against n.
 * Operands are integrands, then sources of points as `koksma measure` takes them; sources of one pattern that differ in
 * their size become one series with a slope. Rows are printed in two tables: errors, slopes. cli/estimating.c opens the
 * functions, and has the estimates of those whose integral is not known.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/integrate.h>

#include "integrating.h"

enum { MOST_TRIALS = 1000000 };

/* A pattern with its sizes, or a file. */
typedef struct series {
    int first; /* the index of its first operand; all operands up to the next series are its own */
    cli_source source;
    char text[KOKSMA_MAX_SPEC]; /* the spec of a pattern without its size, or the name of a file */
    koksma_integration_options options;
    koksma_points points; /* only of a file */
    int dim;
} series;

/* A fitted slope; slopes are printed after all errors. */
typedef struct slope {
    char integrand[KOKSMA_MAX_SPEC], source[KOKSMA_MAX_SPEC];
    int dim;
    size_t from, to;
    koksma_integration_slope line;
} slope;

typedef struct job {
    const cli_args *args;
    cli_work work;
    uint64_t seed, trials;
    series *series;
    size_t n_series;
    series *at;    /* the series whose errors are computed */
    size_t *sizes; /* the size of each operand that was opened */
    slope *slopes;
    size_t n_slopes;
    /* the number of deterministic patterns, which have one set and thus no trials */
    size_t n_deterministic;
    char deterministic[KOKSMA_MAX_SPEC]; /* the first deterministic pattern */
    char biased[KOKSMA_MAX_SPEC];        /* the last pattern that was found to be biased */
} job;

/* ---- Errors ------------------------------------------------------------------------------------------------- */

static void put_error(const koksma_integral_facts *facts, const series *s, const koksma_integration_row *row)
{
    cli_row("integrand %s source %s n %zu dim %d trials %llu rmse %g low %g high %g "
            "approximate? %d gain %g mean %g sd %g integral %g z %g\n",
            facts->text, s->text, row->n, facts->dim, (unsigned long long)row->trials, row->rmse, row->low, row->high,
            row->approximate, row->gain, row->mean, row->sd, facts->value, row->z);
}

static void put_slope(const slope *s)
{
    cli_row("slope_of %s source %s dim %d from_n %zu to_n %zu sizes %zu slope %g "
            "standard_error %g low %g high %g approximate? %d\n",
            s->integrand, s->source, s->dim, s->from, s->to, s->line.count, s->line.value, s->line.standard_error,
            s->line.low, s->line.high, s->line.approximate);
}

static koksma_status errors_of(job *j, const koksma_integral *integral, series *s, koksma_integration *out)
{
    if (s->source.is_pattern) {
        return koksma_integration_errors(integral, &s->source.spec, &s->options, &j->work.run, out);
    }
    double mean = 0;
    koksma_integral_facts facts;
    const koksma_status status = koksma_integrate(integral, &s->points, &j->work.run, &mean);
    koksma_integral_about(integral, &facts);
    return status ? status : koksma_integration_summary(facts.value, facts.variance, &s->options, &mean, out);
}

/* Prints the errors of a series; `context` is the job. */
static int integrate(const koksma_integral *integral, void *context)
{
    job *j = context;
    series *s = j->at;
    slope *more = realloc(j->slopes, (j->n_slopes + 1) * sizeof *more);
    j->slopes = more ? more : j->slopes;
    koksma_integration *result = malloc(sizeof *result);
    koksma_integral_facts facts;
    if (!result || !more) {
        free(result);
        return cli_no_memory();
    }
    koksma_integral_about(integral, &facts);
    const koksma_status status = errors_of(j, integral, s, result);
    const size_t last = s->options.n_sizes - 1;
    for (size_t i = 0; !status && i <= last; i++) {
        put_error(&facts, s, &result->rows[i]);
    }
    if (!status && last >= 2) {
        slope *to = &j->slopes[j->n_slopes++];
        *to = (slope){.dim = facts.dim, .from = SIZE_MAX, .line = result->slope};
        for (size_t i = 0; i <= last; i++) {
            to->from = s->options.sizes[i] < to->from ? s->options.sizes[i] : to->from;
            to->to = s->options.sizes[i] > to->to ? s->options.sizes[i] : to->to;
        }
        snprintf(to->integrand, sizeof to->integrand, "%s", facts.text);
        snprintf(to->source, sizeof to->source, "%s", s->text);
    }
    if (!status && *result->bias && strcmp(j->biased, s->text) != 0) {
        snprintf(j->biased, sizeof j->biased, "%s", s->text);
        cli_note(j->args, "%s is biased, and has no gain: %s", s->text, result->bias);
    }
    if (!status && s->source.is_pattern && j->trials > 1 && result->rows[0].trials == 1 &&
        strcmp(j->deterministic, s->text) != 0) {
        snprintf(j->deterministic, sizeof j->deterministic, "%s", s->text);
        j->n_deterministic++;
    }
    free(result);
    return status ? cli_fail(j->args, status) : CLI_YES;
}

/* ---- The command --------------------------------------------------------------------------------------------- */

/* Whether two operands write the same name of a pattern. */
static bool same_name(const char *a, const char *b)
{
    a = cli_spec_in(a);
    b = cli_spec_in(b);
    const size_t length = strcspn(a, ":@");
    return length == strcspn(b, ":@") && !strncmp(a, b, length);
}

/* Adds the size of operand i, which is the same pattern, to a series. A size that the series has under another name of the
   pattern is the same set, whose row stands for both; one that was given twice under one name is an error. Returns the
   exit code. */
static int add_size(const job *j, series *to, int i)
{
    const size_t n = j->sizes[i];
    bool has = false;
    for (int k = to->first; k < i; k++) {
        has |= j->sizes[k] == n;
        if (j->sizes[k] == n && same_name(j->args->operands[k], j->args->operands[i])) {
            return cli_error(j->args, "%s: n = %zu is given twice", to->text, n);
        }
    }
    if (has) {
        return CLI_YES;
    }
    if (to->options.n_sizes == KOKSMA_MAX_SIZES) {
        return cli_error(j->args, "%s: it takes up to %d sizes", to->text, KOKSMA_MAX_SIZES);
    }
    to->options.sizes[to->options.n_sizes++] = n;
    return CLI_YES;
}

/* Opens operand i, a source. A pattern that differs from the previous source only in its size is added to that
   series. */
static int open_series(job *j, int i)
{
    const char *operand = j->args->operands[i];
    series *s = &j->series[j->n_series], *before = j->n_series ? s - 1 : NULL;
    *s = (series){.first = i, .options = {.seed = j->seed, .trials = j->trials}};
    int code = cli_source_open(j->args, operand, &s->source);
    if (code) {
        return code;
    }
    if (s->source.is_pattern && !koksma_has_one_set(&s->source.spec) && !cli_seeds_fit(j->args, j->seed, j->trials)) {
        return CLI_USAGE;
    }
    if (!s->source.is_pattern) {
        code = cli_source_points(j->args, operand, j->seed, &j->work.run, &s->points);
        s->options.trials = 1;
    }
    koksma_spec_text(&s->source.spec, s->text);
    if (!s->source.is_pattern) {
        snprintf(s->text, sizeof s->text, "%s", operand);
    }
    s->dim = s->source.is_pattern ? s->source.dim : s->points.dim;
    s->options.sizes[0] = j->sizes[i] = s->source.is_pattern ? s->source.n : s->points.n;
    s->options.n_sizes = 1;
    if (before && s->source.is_pattern && before->source.is_pattern && before->dim == s->dim &&
        !strcmp(before->text, s->text)) {
        return add_size(j, before, i);
    }
    j->n_series++;
    return code;
}

/* Shares the level of z among all rows of errors. */
static void count_tests(job *j)
{
    const char *list = j->args->operands[0];
    const bool all = !strcmp(list, "all");
    char item[KOKSMA_MAX_SPEC];
    size_t integrands = 0, rows = 0;
    while (all ? koksma_integrand_at(integrands) != NULL : cli_list_item(list, integrands, item, sizeof item)) {
        integrands++;
    }
    for (size_t i = 0; i < j->n_series; i++) {
        rows += j->series[i].options.n_sizes;
    }
    for (size_t i = 0; i < j->n_series; i++) {
        j->series[i].options.tests = integrands * rows;
    }
}

static int run_all(job *j)
{
    const cli_args *args = j->args;
    int code = CLI_YES;
    for (int i = 1; i < args->n_operands && !code; i++) {
        code = open_series(j, i);
    }
    count_tests(j);
    for (size_t i = 0; i < j->n_series && !code; i++) {
        cli_work_part(&j->work, i, j->n_series);
        j->at = &j->series[i];
        code = cli_integrands_each(args, j->at->dim, integrate, j);
    }
    for (size_t i = 0; i < j->n_slopes; i++) {
        put_slope(&j->slopes[i]);
    }
    cli_work_end();
    const int end = cli_rows_close(code);
    if (!code && j->n_deterministic) {
        cli_note(args, "%s%s is deterministic, so its error is that of a single set; add %cshift=1 for random sets",
                 j->deterministic, j->n_deterministic > 1 ? ", as others," : "",
                 strchr(j->deterministic, ':') ? ',' : ':');
    }
    return end;
}

static int run(const cli_args *args)
{
    job j = {.args = args};
    const bool command = cli_text(args, "with", NULL);
    for (int i = !command; i < args->n_operands; i++) {
        if (koksma_integrand_find(args->operands[i])) {
            return cli_error(args, "%s: %s", args->operands[i],
                             command ? "--with takes the place of an integrand"
                                     : "the integrand comes first, several with commas between them");
        }
    }
    if (cli_estimates(args)) {
        return cli_run_estimates(args);
    }
    if (args->n_operands == 0) {
        return cli_error(args, "it takes an integrand, such as disk or genz-gaussian:difficulty=5, and "
                               "patterns or files; 'koksma list integrands' names them");
    }
    if (args->n_operands == 1) {
        return cli_error(args,
                         "it takes an integrand and points, as in disk sobol@64 or disk -p sobol,halton -n 16,64; "
                         "'koksma list integrands' names the integrands");
    }
    if (!cli_trials(args, 32, MOST_TRIALS, &j.seed, &j.trials) ||
        !cli_sources_check(args, 1, cli_text(args, "trials", NULL) ? j.trials : 1, 1) ||
        !cli_work_begin(args, "integrating", &j.work)) {
        return CLI_USAGE;
    }
    j.series = calloc((size_t)args->n_operands + 1, sizeof *j.series);
    j.sizes = calloc((size_t)args->n_operands, sizeof *j.sizes);
    const int code = j.series && j.sizes ? run_all(&j) : cli_no_memory();
    for (size_t i = 0; j.series && i < (size_t)args->n_operands; i++) {
        koksma_points_fini(&j.series[i].points);
    }
    free(j.series);
    free(j.sizes);
    free(j.slopes);
    return code;
}

static const cli_option options[] = {
    CLI_SOURCE_OPTIONS,
    {'t', "trials", "T",
     "number of sets of each random pattern, with seeds S, S+1, .. to 2^64 - 1 at most (default: 32)"},
    {'s', "seed", "S", "seed of patterns (default: 0)"},
    {0, "tolerance", "ERROR", "double the points until the error is at most ERROR; exit code 1 if the limit ends it"},
    {0, "relative", NULL, "with --tolerance: ERROR is relative to the integral"},
    {0, "max-points", "N", "with --tolerance: limit of the points of all sets together (default: 16777216)"},
    {0, "resume", "FILE", "with --tolerance: keep the steps in FILE, and continue those that are there"},
    {0, "estimator", "ESTIMATOR", "print an estimate; see 'koksma list estimators' (default: the interval's)"},
    {0, "interval", "INTERVAL", "of an estimate; see 'koksma list intervals' (default: the estimator's, or auto)"},
    {0, "replicates", "R", "independent sets of an estimate (default: 15, or 8 parts of one set; see below)"},
    {0, "confidence", "C", "of the interval, above 0 and below 1 (default: 0.95)"},
    {0, "range", "LOW,HIGH", "bounds of the function's values, for intervals that need them"},
    {0, "with", "PROGRAM",
     "estimate the function that the shell command PROGRAM computes: points on its stdin, values on its "
     "stdout"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_integrate = {
    .name = "integrate",
    .summary = "integrate functions with known integrals; print errors against n",
    .synopsis =
        "INTEGRAND,..|all [FILE|-|SPEC@N[@DIM]]... [-p PATTERN,..|all -n N,..] [-d DIM] [--trials T]\n"
        "INTEGRAND,..|--with PROGRAM --tolerance ERROR [--relative] [--confidence C] [--resume FILE] [-p PATTERN,..] "
        "[-d DIM]",
    .details =
        "rmse is the root mean square, over the trials, of the estimate minus the integral, with its 95 % "
        "interval. With a single set, which is all that deterministic patterns have, it is the absolute error. "
        "gain is the variance with random points divided by the mean squared error: how many times as many random "
        "points would be needed for the same error. z is the mean minus the integral in standard errors, sd / "
        "sqrt T. Estimates whose z is beyond what Student's t allows at the level of 4 standard deviations "
        "(6.3e-5), or of .001 for all rows together if that is less, are biased, and have no gain; where "
        "intervals are approximate, the mean must be off by 4 standard errors of random points, too. With 32 sets "
        "or more, patterns that are not known to be unbiased are tested as by 'koksma verify --seeds'. Three "
        "sizes or more give the slope of log rmse against log n with its interval. Intervals are marked "
        "approximate if they may hold in less than 93 % of cases: with fewer than 16 sets, and if errors are much "
        "more skewed or heavy-tailed than normal ones (docs/findings/integration.md).\n"
        "\n"
        "--estimator, --interval, --replicates and --confidence print estimates that need no known integral, each "
        "from R independent sets of n points, with an interval for the integral. --interval auto takes the "
        "narrower of the median's quantile interval and the mean's by Student, each with half of the risk; only "
        "Student's where the sets differ by 0.7 of one point's share of the range of values or more, as with "
        "jumps. error is the larger distance of its ends from the estimate, points the number of function values. "
        "Where the integral is known, off is estimate minus integral, and holds tells whether the interval has "
        "it. --tolerance doubles n, from -n on, until the error is within the tolerance or the next step exceeds "
        "--max-points; the pattern is by default sobol:scramble=lms,digital-shift=1. Without --estimator, "
        "--interval and --replicates, sequences of nets in base 2 have one set of points, whose 8 consecutive "
        "parts give Student's interval, and a ninth of another set as a check: fewest points for a tolerance "
        "(docs/findings/coverage.md). --resume FILE keeps each step in FILE: after an interrupt or a limit the "
        "same command continues, to the same result. The last interval holds with the confidence whenever the "
        "search ends, if the estimates are about normal and their error falls at least as n^-1/2; with fewer than "
        "6 replicates, a confidence below 0.9 or a proved interval all steps share it. rate is the slope of log "
        "error against log points over the last five steps, needed the number of points that a tolerance out of "
        "reach would take by it, with its approximate 95 % interval. Patterns must be unbiased over their seeds "
        "('koksma list claims').\n"
        "\n"
        "PROGRAM runs in the shell, with your permissions, for up to 2^16 points at a time: it reads a point a "
        "line from stdin and prints a value for each. --exec-seconds limits each run.\n",
    .examples = "koksma integrate quarter-disk,quarter-gaussian -p random,halton -n 16,64,256\n"
                "koksma integrate genz-gaussian:difficulty=3 -d 5 -p halton -n 64,256,1024\n"
                "koksma integrate disk points.txt --json\n"
                "koksma integrate exp --tolerance 1e-6\n"
                "koksma integrate disk -p sobol:scramble=owen -n 256 --estimator mean\n"
                "koksma integrate --with \"awk '{print \\$1 * \\$2}'\" --tolerance 1e-4 -d 2\n",
    .options = options,
    .run = run,
};
