/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Evaluates measures over many sets or several sizes, for `koksma measure`: running statistics for each measure and
 * size, differences from the first source with equal seeds (--paired), and slopes. In a trial --prefixes measures the
 * first points of one set, and --sizes measures one set of each size. After an interruption the statistics of the
 * completed trials are printed.
 */
#include "measuring.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "source.h"

bool measuring_open(measuring *j)
{
    j->tallies = calloc(2 * MAX_PREFIXES * (j->n_measures + 1), sizeof *j->tallies);
    const size_t count = MAX_PREFIXES * (j->n_measures + 1);
    j->n_exact = calloc(2 * count, sizeof *j->n_exact);
    j->n_cut = calloc(2 * (j->n_measures + 1), sizeof *j->n_cut);
    j->joints = calloc(j->n_measures + 1, sizeof *j->joints);
    j->differences = j->tallies ? j->tallies + count : NULL;
    j->n_exact_pairs = j->n_exact ? j->n_exact + count : NULL;
    j->n_whole = j->n_cut ? j->n_cut + j->n_measures + 1 : NULL;
    return j->tallies && j->n_exact && j->n_cut && j->joints;
}

void measuring_close(measuring *j)
{
    free(j->tallies);
    free(j->n_exact);
    free(j->n_cut);
    free(j->joints);
    free(j->firsts);
    free(j->first_is_exact);
}

/* Adds the first columns of a row of trials. In a row of differences they also name the first source or warp,
   which is subtracted. */
static void put_head(measuring *j, const char *source, size_t n, int dim, const char *measure, bool difference)
{
    char text[2 * KOKSMA_MAX_SPEC];
    const bool two_sources = difference && strcmp(source, j->first_source) != 0;
    snprintf(text, sizeof text, two_sources ? "%.500s minus %.500s" : "%.500s", source, j->first_source);
    cli_row_text(j->rows, "source", text);
    cli_row_whole(j->rows, "n", n);
    cli_row_whole(j->rows, "dim", (uint64_t)dim);
    cli_row_text(j->rows, "measure", measure);
    if (j->warp) {
        const bool two_warps = difference && j->warp != j->first_warp;
        snprintf(text, sizeof text, two_warps ? "%s minus %s" : "%s", j->warp->name,
                 two_warps ? j->first_warp->name : "");
        cli_row_text(j->rows, "warp", text);
    }
}

/* Values of the last columns; NaN if a row has no value: the number of trials with exact values, the 95 % interval of
   the mean, the exponents that theory gives for the pattern and for the best points, and the residual error of a
   slope fitted to one set. */
typedef struct tail {
    double n_exact, low, high, theory, best, residual_error;
} tail;

static void put_tail(measuring *j, tail t)
{
    if (j->bounds || cli_flag(j->arguments, "json")) {
        cli_row_number(j->rows, "exact", t.n_exact);
    }
    if (j->paired) {
        cli_row_number(j->rows, "low", t.low);
        cli_row_number(j->rows, "high", t.high);
    }
    if (measuring_by_size(j)) {
        if (j->residuals) {
            cli_row_number(j->rows, "residual_error", t.residual_error);
        }
        cli_row_number(j->rows, "theory", t.theory);
        cli_row_number(j->rows, "best", t.best);
    }
    cli_row_end(j->rows);
}

/* least: the least possible value, at which the interval begins at the least. */
static void put_tally(measuring *j, const koksma_tally *t, double n_exact, double least)
{
    cli_row_number(j->rows, "value", t->mean);
    cli_row_number(j->rows, "standard_error", koksma_tally_error(t));
    cli_row_whole(j->rows, "trials", (uint64_t)t->count);
    cli_row_number(j->rows, "sd", koksma_tally_sd(t));
    cli_row_number(j->rows, "min", t->min);
    cli_row_number(j->rows, "max", t->max);
    const double half = koksma_tally_interval(t), low = t->mean - half;
    put_tail(j, (tail){n_exact, low < least ? least : low, t->mean + half, NAN, NAN, NAN});
}

bool measuring_by_size(const measuring *j)
{
    return cli_text(j->arguments, "prefixes", NULL) || cli_text(j->arguments, "sizes", NULL);
}

/* Returns whether the first k points are a set of the pattern for all k, so that a slope describes the pattern and
   theory applies to it. Sequences, and independent points without cells, have this property. The first k points of
   other patterns are only a part of a set, such as a strip of cells. */
static bool prefixes_are_sets(const koksma_spec *spec)
{
    const unsigned claims = spec->pattern->claims;
    return koksma_is_sequence(spec) || (claims & KOKSMA_CLAIM_INDEPENDENT && !(claims & KOKSMA_CLAIM_STRATIFIED));
}

/* Returns whether all trials of a source have the same points. */
static bool has_one_set(const cli_source *source)
{
    return !source->is_pattern || koksma_has_one_set(&source->spec);
}

bool measuring_has_residuals(const measuring *j)
{
    bool any = j->trials == 1;
    for (int i = 0; i < j->arguments->n_operands && !any && measuring_by_size(j); i++) {
        cli_source parts;
        any = !cli_source_open(j->arguments, j->arguments->operands[i], &parts) && has_one_set(&parts);
    }
    return any;
}

bool measuring_check_prefixes(const measuring *j)
{
    for (int i = 0; cli_text(j->arguments, "prefixes", NULL) && i < j->arguments->n_operands; i++) {
        cli_source parts;
        if (cli_source_open(j->arguments, j->arguments->operands[i], &parts)) {
            return false;
        }
        if (parts.is_pattern && !prefixes_are_sets(&parts.spec)) {
            cli_usage_error(j->arguments,
                            "--prefixes: %s is no sequence, so its first points are no set of the pattern; use "
                            "--sizes 16,64,256 to measure a set of each n",
                            parts.spec.pattern->name);
            return false;
        }
    }
    return true;
}

/* Returns the number of exact values, or NaN for a sampled measure, whose estimates are neither exact nor bounds. */
static double n_exact_of(const measuring *j, size_t measure, size_t count)
{
    return j->measures[measure].measure->answer == KOKSMA_ANSWER_SAMPLED ? (double)NAN : (double)count;
}

/* Prints the slope of log value over log n, beside the exponents that theory gives. */
static void put_slope(measuring *j, const char *source, size_t measure, int dim)
{
    double sizes[MAX_PREFIXES], means[MAX_PREFIXES];
    char name[KOKSMA_MAX_SPEC + 16], text[KOKSMA_MAX_SPEC];
    koksma_line line;
    cli_source parts;
    for (size_t i = 0; i < j->n_prefixes; i++) {
        const koksma_tally *t = &j->tallies[i * j->n_measures + measure];
        sizes[i] = (double)j->prefixes[i];
        means[i] = t->count > 0 ? t->mean : (double)NAN;
    }
    if (!koksma_joint_line(&j->joints[measure], j->n_prefixes, sizes, means, &line) ||
        cli_source_open(j->arguments, source, &parts)) {
        return;
    }
    const koksma_measure *m = j->measures[measure].measure;
    const bool known = parts.is_pattern && !j->warp; /* no theorem covers mapped points */
    koksma_spec_text(&j->measures[measure], text);
    snprintf(name, sizeof name, "slope of %s", text);
    put_head(j, source, j->prefixes[j->n_prefixes - 1], dim, name, false);
    cli_row_number(j->rows, "value", line.slope);
    const double trials = j->joints[measure].count;
    cli_row_number(j->rows, "standard_error", trials > 1 ? line.slope_error : (double)NAN);
    cli_row_whole(j->rows, "trials", (uint64_t)trials);
    cli_row_number(j->rows, "sd", NAN);
    cli_row_number(j->rows, "min", NAN);
    cli_row_number(j->rows, "max", NAN);
    put_tail(j,
             (tail){n_exact_of(j, measure, j->n_whole[measure]), NAN, NAN,
                    known ? -koksma_rate(&parts.spec, m, dim) : (double)NAN,
                    j->warp ? (double)NAN : -koksma_best_rate(m, dim), trials > 1 ? (double)NAN : line.slope_error});
}

static void put_tallies(measuring *j, const char *source, int dim)
{
    for (size_t m = 0; m < j->n_measures; m++) { /* all rows of a table have the same columns */
        j->bounds = j->bounds || j->n_cut[m] > 0;
    }
    for (size_t m = 0; m < j->n_measures; m++) {
        char name[KOKSMA_MAX_SPEC];
        koksma_spec_text(&j->measures[m], name);
        for (int which = 0; which <= j->paired; which++) {
            const koksma_tally *tallies = which ? j->differences : j->tallies;
            for (size_t i = 0; i < j->n_prefixes; i++) {
                if (tallies[i * j->n_measures + m].count > 0) {
                    put_head(j, source, j->prefixes[i], dim, name, which == 1);
                    const size_t at = i * j->n_measures + m;
                    put_tally(j, &tallies[at], n_exact_of(j, m, (which ? j->n_exact_pairs : j->n_exact)[at]),
                              which ? (double)-INFINITY : 0);
                }
            }
        }
        put_slope(j, source, m, dim);
    }
}

/* Chooses the prefixes for a set of n points. Without --prefixes and --sizes the only prefix is the whole set.
   Returns the exit code. */
static int choose_prefixes(measuring *j, size_t n)
{
    if (j->powers || !measuring_by_size(j)) {
        j->n_prefixes = 0;
        for (size_t k = 1; j->powers && k < n; k *= 2) {
            j->prefixes[j->n_prefixes++] = k;
        }
        j->prefixes[j->n_prefixes++] = n;
    }
    for (size_t i = 0; i < j->n_prefixes; i++) {
        if (j->prefixes[i] > n) {
            return cli_usage_error(j->arguments, "%s: a prefix of %zu points is longer than the set, which has %zu",
                                   j->own_sets ? "sizes" : "prefixes", j->prefixes[i], n);
        }
    }
    return CLI_YES;
}

/* With --paired, allocates the arrays for the first source's values once their number is known. Returns the exit
   code. */
static int open_firsts(measuring *j, const char *source)
{
    const size_t count = j->n_prefixes * j->n_measures;
    if (!j->paired) {
        return CLI_YES;
    }
    if (j->firsts) {
        return count == j->n_firsts ? CLI_YES
                                    : cli_usage_error(j->arguments, "--paired: %s has other prefixes than %s", source,
                                                      j->first_source);
    }
    j->firsts = calloc((size_t)j->trials, count * sizeof *j->firsts);
    j->first_is_exact = calloc((size_t)j->trials, count * sizeof *j->first_is_exact);
    if (!j->firsts || !j->first_is_exact) {
        return cli_no_memory();
    }
    j->n_firsts = count;
    j->first_source = source;
    j->first_warp = j->warp;
    return CLI_YES;
}

static void tally_value(measuring *j, const koksma_value *value, size_t at, uint64_t trial, bool first)
{
    koksma_tally_add(&j->tallies[at], value->value);
    j->n_exact[at] += value->exact;
    if (!j->paired) {
        return;
    }
    const size_t kept = trial * j->n_firsts + at;
    if (first) {
        j->firsts[kept] = value->value;
        j->first_is_exact[kept] = value->exact;
    } else if (isfinite(value->value - j->firsts[kept])) {
        koksma_tally_add(&j->differences[at], value->value - j->firsts[kept]);
        j->n_exact_pairs[at] += value->exact && j->first_is_exact[kept];
    }
}

/* The values of one trial: for each measure its value at each prefix, and whether all these values are exact. */
typedef struct trial_values {
    double values[MAX_MEASURES][MAX_PREFIXES];
    bool whole[MAX_MEASURES];
} trial_values;

/* Evaluates the measures for prefix i. With `--prefixes powers` it leaves out a measure that needs more points, such
   as min-distance for one point. */
static koksma_status tally_set(measuring *j, const koksma_points *points, size_t i, uint64_t trial, bool first,
                               trial_values *v)
{
    const bool chosen_here = j->powers && i + 1 < j->n_prefixes;
    for (size_t m = 0; m < j->n_measures; m++) {
        const size_t at = i * j->n_measures + m;
        koksma_value value = {.value = NAN};
        const koksma_status status = measuring_evaluate(j, m, points, &value);
        if (measuring_forgive(j, status) && !(chosen_here && status == KOKSMA_N)) {
            return status;
        }
        if (!status) {
            tally_value(j, &value, at, trial, first);
        } else if (j->paired && first) {
            j->firsts[trial * j->n_firsts + at] = NAN;
        }
        v->values[m][i] = status ? (double)NAN : value.value;
        v->whole[m] = (i == 0 || v->whole[m]) && (status || value.exact);
    }
    return KOKSMA_OK;
}

/* Evaluates the measures for all prefixes of a trial. points: the whole set, or NULL if `source` generates a set of
   each size. A source that has the same set in every trial is one trial of its slopes. */
static koksma_status tally_points(measuring *j, const koksma_points *points, const cli_source *source, uint64_t trial,
                                  bool first)
{
    trial_values v;
    for (size_t i = 0; i < j->n_prefixes; i++) {
        koksma_points own = {0};
        koksma_status status = KOKSMA_OK;
        if (!points) {
            cli_work_unknown(&j->work, "points");
            status = koksma_points_init(&own, j->prefixes[i], source->dim);
            status = status ? status : koksma_generate(&source->spec, j->seed + trial, &j->work.run, &own);
        }
        if (!status) {
            const koksma_points prefix = {j->prefixes[i], points ? points->dim : 0, points ? points->xs : NULL};
            status = tally_set(j, points ? &prefix : &own, i, trial, first, &v);
        }
        koksma_points_fini(&own);
        if (status) {
            return status;
        }
    }
    for (size_t m = 0; m < j->n_measures && (trial == 0 || !has_one_set(source)); m++) {
        koksma_joint_add(&j->joints[m], j->n_prefixes, v.values[m]);
        j->n_whole[m] += v.whole[m];
    }
    return KOKSMA_OK;
}

/* The points of trial t, into those of the trial before. */
static int next_points(const measuring *j, const char *source, const cli_source *parts, uint64_t t,
                       koksma_points *points)
{
    if (t == 0) {
        return cli_source_points(j->arguments, source, j->seed, &j->work.run, points);
    }
    const koksma_status status = koksma_generate(&parts->spec, j->seed + t, &j->work.run, points);
    return status ? cli_fail(j->arguments, status) : CLI_YES;
}

/* What needs the numbers of points and dimensions, which are those of the first trial. Returns the exit code. */
static int begin_trials(measuring *j, const char *source, size_t n, int dim, bool own_sets)
{
    int code = measuring_check_dim(j, dim);
    code = code || own_sets ? code : choose_prefixes(j, n);
    return code ? code : open_firsts(j, source);
}

int measuring_trials(measuring *j, const char *source)
{
    cli_source parts;
    koksma_points points = {0};
    int code = cli_source_open(j->arguments, source, &parts), dim = 0;
    const bool first = !j->firsts, own_sets = j->own_sets && !code && parts.is_pattern;
    memset(j->tallies, 0, 2 * MAX_PREFIXES * (j->n_measures + 1) * sizeof *j->tallies);
    memset(j->n_exact, 0, 2 * MAX_PREFIXES * (j->n_measures + 1) * sizeof *j->n_exact);
    memset(j->n_whole, 0, (j->n_measures + 1) * sizeof *j->n_whole);
    memset(j->joints, 0, (j->n_measures + 1) * sizeof *j->joints);
    for (uint64_t t = 0; t < (parts.is_pattern ? j->trials : 1) && !code; t++) {
        if (!own_sets) {
            cli_work_unknown(&j->work, "points");
            code = next_points(j, source, &parts, t, &points);
        }
        if (!code && t == 0) {
            dim = own_sets ? parts.dim : points.dim;
            code = begin_trials(j, source, points.n, dim, own_sets);
        }
        if (!code) {
            const koksma_status status = tally_points(j, own_sets ? NULL : &points, &parts, t, first);
            cli_work_end();
            code = status ? cli_fail(j->arguments, status) : CLI_YES;
        }
    }
    koksma_points_fini(&points);
    put_tallies(j, source, dim);
    return code;
}

/* `koksma measure --at X,Y..`: the local discrepancy at a corner, which is the fraction of the points in the box from
   the origin to that corner, minus the volume of the box. */

enum { MAX_CORNER = 64 };

/* Reads a list of coordinates such as 0.3,0.7. Returns their number, at most MAX_CORNER, or 0 after an error. */
static int parse_corner(const cli_arguments *arguments, const char *list, double corner[MAX_CORNER])
{
    char item[64];
    int n = 0;
    while (n < MAX_CORNER && cli_list_item(list, (size_t)n, item, sizeof item)) {
        char *end;
        corner[n] = strtod(item, &end);
        if (end == item || *end || !(corner[n] >= 0 && corner[n] <= 1)) {
            cli_usage_error(arguments, "--at %s: it takes the coordinates of a corner in [0,1], such as 0.3,0.7",
                            list);
            return 0;
        }
        n++;
    }
    if (n == MAX_CORNER && cli_list_item(list, (size_t)n, item, sizeof item)) {
        cli_usage_error(arguments, "--at: at most %d coordinates", MAX_CORNER);
        return 0;
    }
    return n;
}

int measure_local(const cli_arguments *arguments)
{
    double corner[MAX_CORNER], value;
    const char *list = cli_text(arguments, "at", "");
    const int dim = parse_corner(arguments, list, corner);
    uint64_t seed;
    cli_work work;
    if (!cli_refuse(arguments, "measures trials prefixes sizes warp paired time-limit",
                    "has no effect with --at, which prints only the local discrepancy of the points as they are") ||
        !dim || !cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &seed) ||
        !cli_work_begin(arguments, "measuring", &work)) {
        return CLI_USAGE;
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    int code = CLI_YES;
    for (int i = 0; i < arguments->n_operands && !code; i++) {
        koksma_points points = {0};
        code = cli_source_points(arguments, arguments->operands[i], seed, &work.run, &points);
        if (!code && points.dim != dim) {
            code = cli_usage_error(arguments, "%s: the points have %d dimensions, but --at %s has %d",
                                   arguments->operands[i], points.dim, list, dim);
        }
        const koksma_status status = code ? KOKSMA_OK : koksma_local_discrepancy(&points, corner, &value);
        code = status ? cli_fail(arguments, status) : code;
        if (!code) {
            cli_row_text(rows, "source", arguments->operands[i]);
            cli_row_whole(rows, "n", points.n);
            cli_row_whole(rows, "dim", (uint64_t)points.dim);
            cli_row_text(rows, "at", list);
            cli_row_number(rows, "local_discrepancy", value);
            cli_row_end(rows);
        }
        koksma_points_fini(&points);
    }
    cli_work_end();
    return cli_rows_close(rows, code);
}

/* Reports values that are only bounds because the search for the exact value was cut short. */

bool cli_is_cut_short(const koksma_spec *measure, const koksma_value *value)
{
    return measure->measure->answer == KOKSMA_ANSWER_EXACT && !value->exact;
}

void cli_tell_cuts(const cli_arguments *arguments, const char *what, size_t n_cut)
{
    if (n_cut > 0 && !cli_flag(arguments, "quiet")) {
        cli_say(arguments->command->name, "%s: %zu value%s lower bound%s, not exact: the search was cut short", what,
                n_cut, n_cut > 1 ? "s are" : " is a", n_cut > 1 ? "s" : "");
    }
}

/* The option --warp of measure, generate and plot: finds a map by its name, and maps sets of points. */

const koksma_warp *cli_find_warp(const cli_arguments *arguments, const char *name)
{
    const koksma_warp *warp = koksma_warp_find(name);
    if (!warp) {
        char names[512] = "";
        for (size_t i = 0; koksma_warp_at(i); i++) {
            const size_t used = strlen(names);
            snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", koksma_warp_at(i)->name);
        }
        char meant[96];
        cli_usage_error(arguments, "--warp %s: %sit takes %s", name, cli_meant_of(name, names, meant), names);
    }
    return warp;
}

koksma_status cli_map_points(const koksma_warp *warp, koksma_points *points)
{
    koksma_points mapped;
    const koksma_status status = koksma_warp_points(warp, points, &mapped);
    if (!status) {
        koksma_points_fini(points);
        *points = mapped;
    }
    return status;
}
