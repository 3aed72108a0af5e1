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
    j->tallies = calloc(MAX_PREFIXES * (j->n_measures + 1), sizeof *j->tallies);
    j->fits = calloc(j->n_measures + 1, sizeof *j->fits);
    return j->tallies && j->fits;
}

void measuring_close(measuring *j)
{
    free(j->tallies);
    free(j->fits);
    free(j->firsts);
}

koksma_status measuring_evaluate(measuring *j, size_t measure, const koksma_points *points, koksma_value *value)
{
    const koksma_spec *spec = &j->measures[measure];
    j->work.what = spec->measure->name;
    const size_t sets = (size_t)j->args->n_operands * (j->n_warps ? j->n_warps : 1) * j->trials;
    const size_t all = sets * j->n_measures * (j->n_prefixes ? j->n_prefixes : 1);
    cli_work_part(&j->work, j->n_evaluated < all ? j->n_evaluated : all - 1, all);
    j->n_evaluated++;
    koksma_run run = j->work.run;
    run.time_limit_s = j->time_limit_s;
    const koksma_status status = j->warp ? koksma_warp_evaluate(j->warp, spec, points, &run, value)
                                         : koksma_evaluate(spec, points, &run, value);
    j->fits[measure].n_cut += !status && cli_is_cut_short(spec, value);
    return status;
}

/* Returns `status`; but with -m all and without -m it returns KOKSMA_OK for a measure that does not accept a set, so that
   the measure is left out. */
koksma_status measuring_forgive(measuring *j, koksma_status status)
{
    const bool unable = status == KOKSMA_DIM || status == KOKSMA_N || status == KOKSMA_UNSUPPORTED;
    if (!unable || !(j->all || j->by_default)) {
        return status;
    }
    if (j->by_default && !cli_flag(j->args, "quiet") && strcmp(j->note, koksma_error_text()) != 0) {
        snprintf(j->note, sizeof j->note, "%s", koksma_error_text());
        cli_work_end();
        cli_say("measure", "left out: %s", j->note);
    }
    return KOKSMA_OK;
}

static bool stop_at_once(void *context, double fraction_done)
{
    (void)context;
    (void)fraction_done;
    return false;
}

int measuring_check_dim(measuring *j, int dim)
{
    const koksma_run run = {.threads = 1, .keep_going = stop_at_once};
    const bool one_suffices = j->all || j->by_default;
    koksma_points points;
    koksma_status status = koksma_points_init(&points, 1, dim);
    bool more = !status;
    for (size_t m = 0; m < j->n_measures && more; m++) {
        koksma_value value;
        status = j->warp ? koksma_warp_evaluate(j->warp, &j->measures[m], &points, &run, &value)
                         : koksma_evaluate(&j->measures[m], &points, &run, &value);
        status = status == KOKSMA_DIM || status == KOKSMA_UNSUPPORTED ? status : KOKSMA_OK;
        more = one_suffices ? status != KOKSMA_OK : status == KOKSMA_OK;
    }
    const int code = status ? cli_fail(j->args, status) : CLI_YES;
    koksma_points_fini(&points);
    return code;
}

/* Adds the first columns of a row of trials. In a row of differences they also name the first source or warp,
   which is subtracted. */
static void put_head(measuring *j, const char *source, size_t n, int dim, const char *measure, bool difference)
{
    char text[2 * KOKSMA_MAX_SPEC];
    const bool two_sources = difference && strcmp(source, j->first_source) != 0;
    snprintf(text, sizeof text, two_sources ? "%.500s minus %.500s" : "%.500s", source, j->first_source);
    cli_row("source %s n %zu dim %d measure %s", text, n, dim, measure);
    if (j->warp) {
        const bool two_warps = difference && j->warp != j->first_warp;
        snprintf(text, sizeof text, two_warps ? "%s minus %s" : "%s", j->warp->name,
                 two_warps ? j->first_warp->name : "");
        cli_row("warp %s", text);
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
    if (j->bounds || cli_flag(j->args, "json")) {
        cli_row("exact %g", t.n_exact);
    }
    if (j->paired) {
        cli_row("low %g high %g", t.low, t.high);
    }
    if (j->by_size) {
        if (j->residuals) {
            cli_row("residual_error %g", t.residual_error);
        }
        cli_row("theory %g best %g", t.theory, t.best);
    }
    cli_row_end();
}

/* least: the least possible value, at which the interval begins at the least. */
static void put_tally(measuring *j, const koksma_tally *t, double n_exact, double least)
{
    cli_row("value %g standard_error %g trials %g sd %g min %g max %g", t->mean, koksma_tally_error(t), t->count,
            koksma_tally_sd(t), t->min, t->max);
    const double half = koksma_tally_interval(t), low = t->mean - half;
    put_tail(j, (tail){n_exact, low < least ? least : low, t->mean + half, NAN, NAN, NAN});
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
        const koksma_tally *t = &j->tallies[i * j->n_measures + measure].values;
        sizes[i] = (double)j->prefixes[i];
        means[i] = t->count > 0 ? t->mean : (double)NAN;
    }
    if (!koksma_joint_line(&j->fits[measure].joint, j->n_prefixes, sizes, means, &line) ||
        cli_source_open(j->args, source, &parts)) {
        return;
    }
    const koksma_measure *m = j->measures[measure].measure;
    const bool known = parts.is_pattern && !j->warp; /* no theorem covers mapped points */
    koksma_spec_text(&j->measures[measure], text);
    snprintf(name, sizeof name, "slope of %s", text);
    put_head(j, source, j->prefixes[j->n_prefixes - 1], dim, name, false);
    cli_row("value %g", line.slope);
    const double trials = j->fits[measure].joint.count;
    cli_row("standard_error %g trials %g sd %g min %g max %g", trials > 1 ? line.slope_error : (double)NAN, trials,
            (double)NAN, (double)NAN, (double)NAN);
    put_tail(j,
             (tail){n_exact_of(j, measure, j->fits[measure].n_whole), NAN, NAN,
                    known ? -koksma_rate(&parts.spec, m, dim) : (double)NAN,
                    j->warp ? (double)NAN : -koksma_best_rate(m, dim), trials > 1 ? (double)NAN : line.slope_error});
}

static void put_tallies(measuring *j, const char *source, int dim)
{
    for (size_t m = 0; m < j->n_measures; m++) { /* all rows of a table have the same columns */
        j->bounds = j->bounds || j->fits[m].n_cut > 0;
    }
    for (size_t m = 0; m < j->n_measures; m++) {
        char name[KOKSMA_MAX_SPEC];
        koksma_spec_text(&j->measures[m], name);
        for (int which = 0; which <= j->paired; which++) {
            for (size_t i = 0; i < j->n_prefixes; i++) {
                const tallied *at = &j->tallies[i * j->n_measures + m];
                const koksma_tally *tally = which ? &at->differences : &at->values;
                if (tally->count > 0) {
                    put_head(j, source, j->prefixes[i], dim, name, which == 1);
                    put_tally(j, tally, n_exact_of(j, m, which ? at->n_exact_pairs : at->n_exact),
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
    if (j->powers || !j->by_size) {
        j->n_prefixes = 0;
        for (size_t k = 1; j->powers && k < n; k *= 2) {
            j->prefixes[j->n_prefixes++] = k;
        }
        j->prefixes[j->n_prefixes++] = n;
    }
    for (size_t i = 0; i < j->n_prefixes; i++) {
        if (j->prefixes[i] > n) {
            return cli_error(j->args, "%s: a prefix of %zu points is longer than the set, which has %zu",
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
        return count == j->n_firsts
                   ? CLI_YES
                   : cli_error(j->args, "--paired: %s has other prefixes than %s", source, j->first_source);
    }
    j->firsts = calloc((size_t)j->trials, count * sizeof *j->firsts);
    if (!j->firsts) {
        return cli_no_memory();
    }
    j->n_firsts = count;
    j->first_source = source;
    j->first_warp = j->warp;
    return CLI_YES;
}

static void tally_value(measuring *j, const koksma_value *value, size_t at, uint64_t trial, bool first)
{
    tallied *to = &j->tallies[at];
    koksma_tally_add(&to->values, value->value);
    to->n_exact += value->exact;
    paired_value *kept = j->paired ? &j->firsts[trial * j->n_firsts + at] : NULL;
    if (kept && first) {
        *kept = (paired_value){value->value, value->exact};
    } else if (kept && isfinite(value->value - kept->value)) {
        koksma_tally_add(&to->differences, value->value - kept->value);
        to->n_exact_pairs += value->exact && kept->exact;
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
            j->firsts[trial * j->n_firsts + at].value = NAN;
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
    const bool varies = source->is_pattern && !koksma_has_one_set(&source->spec);
    for (size_t m = 0; m < j->n_measures && (trial == 0 || varies); m++) {
        koksma_joint_add(&j->fits[m].joint, j->n_prefixes, v.values[m]);
        j->fits[m].n_whole += v.whole[m];
    }
    return KOKSMA_OK;
}

/* The points of trial t, into those of the trial before. */
static int next_points(const measuring *j, const char *source, const cli_source *parts, uint64_t t,
                       koksma_points *points)
{
    if (t == 0) {
        return cli_source_points(j->args, source, j->seed, &j->work.run, points);
    }
    const koksma_status status = koksma_generate(&parts->spec, j->seed + t, &j->work.run, points);
    return status ? cli_fail(j->args, status) : CLI_YES;
}

/* What needs the numbers of points and dimensions, which are those of the first trial. Returns the exit code. */
static int begin_trials(measuring *j, const char *source, size_t n, int dim, bool own_sets)
{
    int code = measuring_check_dim(j, dim);
    code = code || own_sets ? code : choose_prefixes(j, n);
    return code ? code : open_firsts(j, source);
}

int measuring_tally(measuring *j, const char *source, int *dim)
{
    cli_source parts;
    koksma_points points = {0};
    int code = cli_source_open(j->args, source, &parts);
    const bool first = !j->firsts, own_sets = j->own_sets && !code && parts.is_pattern;
    memset(j->tallies, 0, MAX_PREFIXES * (j->n_measures + 1) * sizeof *j->tallies);
    for (size_t m = 0; m < j->n_measures; m++) {
        j->fits[m] = (fitted){.n_cut = j->fits[m].n_cut};
    }
    for (uint64_t t = 0; t < (parts.is_pattern ? j->trials : 1) && !code; t++) {
        if (!own_sets) {
            cli_work_unknown(&j->work, "points");
            code = next_points(j, source, &parts, t, &points);
        }
        if (!code && t == 0) {
            *dim = own_sets ? parts.dim : points.dim;
            code = begin_trials(j, source, points.n, *dim, own_sets);
        }
        if (!code) {
            const koksma_status status = tally_points(j, own_sets ? NULL : &points, &parts, t, first);
            cli_work_end();
            code = status ? cli_fail(j->args, status) : CLI_YES;
        }
    }
    koksma_points_fini(&points);
    return code;
}

int measuring_trials(measuring *j, const char *source)
{
    int dim = 0;
    const int code = measuring_tally(j, source, &dim);
    put_tallies(j, source, dim);
    return code;
}

bool cli_is_cut_short(const koksma_spec *measure, const koksma_value *value)
{
    return measure->measure->answer == KOKSMA_ANSWER_EXACT && !value->exact;
}

void cli_tell_cuts(const cli_args *args, const char *what, size_t n_cut)
{
    if (n_cut > 0) {
        cli_note(args, "%s: %zu value%s lower bound%s, not exact: the search was cut short", what, n_cut,
                 n_cut > 1 ? "s are" : " is a", n_cut > 1 ? "s" : "");
    }
}

const koksma_warp *cli_find_warp(const cli_args *args, const char *name)
{
    const koksma_warp *warp = koksma_warp_find(name);
    if (!warp) {
        char names[512], what[80];
        cli_join(cli_noun_of("WARP", 4)->name, NULL, ", ", ", ", names, sizeof names);
        snprintf(what, sizeof what, "--warp %.60s: ", name);
        cli_takes(args, what, name, names);
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
