/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma measure`: evaluates measures of points from files and patterns. With one set per source, a row has the
 * exact value or bounds, and the witness if the measure finds one. --trials, --prefixes, --sizes and --paired are
 * handled in measuring.c, which computes means, standard errors and slopes. If --time-limit ends a search early, the
 * row has bounds, and a warning is printed.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "measuring.h"
#include "source.h"

static void put_corner(char json[1024], const char *key, const double *xs, int dim)
{
    CLI_APPEND(json, 1024, ",\"%s\":", key);
    for (int k = 0; k < dim; k++) {
        CLI_APPEND(json, 1024, "%c%.17g", k ? ',' : '[', xs[k]);
    }
    CLI_APPEND(json, 1024, "]");
}

static void put_witness(const koksma_witness *w)
{
    static const char *const kinds[] = {
        [KOKSMA_WITNESS_BOX] = "box", [KOKSMA_WITNESS_HALF_PLANE] = "half-plane", [KOKSMA_WITNESS_DISK] = "disk"};
    char json[1024], text[256], a[CLI_NUMBER], b[CLI_NUMBER], c[CLI_NUMBER], d[CLI_NUMBER];
    if (w->kind == KOKSMA_WITNESS_NONE) {
        cli_row_json("witness", "null", "-");
        return;
    }
    snprintf(json, sizeof json, "{\"kind\":\"%s\",\"closed\":%s,\"count\":%zu,\"volume\":%.17g", kinds[w->kind],
             w->closed ? "true" : "false", w->count, w->volume);
    put_corner(json, "lo", w->lo, w->kind == KOKSMA_WITNESS_DISK ? 2 : w->dim);
    put_corner(json, "hi", w->hi, w->kind == KOKSMA_WITNESS_BOX ? w->dim : 1);
    strcat(json, "}");
    const bool space = w->kind == KOKSMA_WITNESS_HALF_PLANE && w->dim == 3;
    snprintf(text, sizeof text, "%zu point%s in the %s %s", w->count, w->count == 1 ? "" : "s",
             w->closed ? "closed" : "open", space ? "half-space" : kinds[w->kind]);
    for (int k = 0; k < w->dim && w->kind == KOKSMA_WITNESS_BOX; k++) {
        CLI_APPEND(text, sizeof text, "%s%s..%s", k ? " x " : " ", cli_number(w->lo[k], a), cli_number(w->hi[k], b));
    }
    if (w->kind == KOKSMA_WITNESS_HALF_PLANE) {
        CLI_APPEND(text, sizeof text, " %s x + %s y%s%s%s <= %s", cli_number(w->lo[0], a), cli_number(w->lo[1], b),
                   space ? " + " : "", space ? cli_number(w->lo[2], c) : "", space ? " z" : "",
                   cli_number(w->hi[0], d));
    } else if (w->kind == KOKSMA_WITNESS_DISK) {
        CLI_APPEND(text, sizeof text, " about (%s, %s) of radius %s", cli_number(w->lo[0], a),
                   cli_number(w->lo[1], b), cli_number(w->hi[0], c));
    }
    cli_row_json("witness", json, text);
}

static void put_row(measuring *j, const char *source, const koksma_points *points, const koksma_spec *measure,
                    const koksma_value *value)
{
    char name[KOKSMA_MAX_SPEC];
    koksma_spec_text(measure, name);
    cli_row("source %s n %zu dim %d measure %s", source, points->n, points->dim, name);
    if (j->warp) {
        cli_row("warp %s", j->warp->name);
    }
    cli_row("value %g", value->value);
    const bool json = cli_flag(j->args, "json");
    if (json) {
        cli_row("square %g", value->square);
    }
    if (json || j->bounds || cli_is_cut_short(measure, value)) {
        cli_row("exact? %d lower %g upper %g", value->exact, value->lower, value->upper);
    }
    if (json || j->sampled) {
        const bool none = !json && measure->measure->answer != KOKSMA_ANSWER_SAMPLED;
        cli_row("standard_error %g", none ? (double)NAN : value->standard_error);
    }
    put_witness(&value->witness);
    cli_row_end();
}

/* Returns whether the first k points are a set of the pattern for all k, so that a slope describes the pattern and
   theory applies to it. Sequences, and independent points without cells, have this property. The first k points of
   other patterns are only a part of a set, such as a strip of cells. */
static bool prefixes_are_sets(const koksma_spec *spec)
{
    const unsigned claims = spec->pattern->claims;
    return koksma_is_sequence(spec) || (claims & KOKSMA_CLAIM_INDEPENDENT && !(claims & KOKSMA_CLAIM_STRATIFIED));
}

/* Whether slopes of some source are fitted to one set: there is one trial, or the pattern has only one set. */
static bool has_residuals(const measuring *j)
{
    bool any = j->trials == 1;
    for (int i = 0; i < j->args->n_operands && !any && j->by_size; i++) {
        cli_source parts;
        any = !cli_source_open(j->args, j->args->operands[i], &parts) &&
              (!parts.is_pattern || koksma_has_one_set(&parts.spec));
    }
    return any;
}

/* Refuses --prefixes for a pattern whose first points are not a set of the pattern. */
static bool check_prefixes(const measuring *j)
{
    for (int i = 0; cli_text(j->args, "prefixes", NULL) && i < j->args->n_operands; i++) {
        cli_source parts;
        if (cli_source_open(j->args, j->args->operands[i], &parts)) {
            return false;
        }
        if (parts.is_pattern && !prefixes_are_sets(&parts.spec)) {
            return !cli_error(j->args,
                              "--prefixes: %s is no sequence, so its first points are no set of the pattern; use "
                              "--sizes 16,64,256 to measure a set of each n",
                              parts.spec.pattern->name);
        }
    }
    return true;
}

/* Chooses the optional columns, which all rows of a table have in common. */
static void choose_columns(measuring *j)
{
    j->bounds = j->time_limit_s > 0;
    j->residuals = has_residuals(j);
    for (size_t m = 0; m < j->n_measures; m++) {
        j->bounds = j->bounds || j->measures[m].measure->answer == KOKSMA_ANSWER_BOUND;
        j->sampled = j->sampled || j->measures[m].measure->answer == KOKSMA_ANSWER_SAMPLED;
    }
}

/* Checks the measures for all patterns before the first of them is generated. Returns the exit code. */
static int check_patterns(measuring *j)
{
    int code = CLI_YES;
    for (int i = 0; !code && i < j->args->n_operands; i++) {
        cli_source parts;
        code = cli_source_open(j->args, j->args->operands[i], &parts);
        for (size_t w = 0; !code && parts.is_pattern && w < (j->n_warps ? j->n_warps : 1); w++) {
            j->warp = j->warps[w];
            code = measuring_check_dim(j, parts.dim);
        }
    }
    return code;
}

static int measure_source(measuring *j, const char *source)
{
    koksma_points points = {0};
    koksma_status status = KOKSMA_OK;
    if (j->trials > 1 || j->n_prefixes > 0 || j->powers || j->paired) {
        return measuring_trials(j, source);
    }
    cli_work_unknown(&j->work, "points");
    int code = cli_source_points(j->args, source, j->seed, &j->work.run, &points);
    code = code ? code : measuring_check_dim(j, points.dim);
    if (code) {
        koksma_points_fini(&points);
        return code;
    }
    for (size_t i = 0; !status && i < j->n_measures; i++) {
        koksma_value value;
        status = measuring_evaluate(j, i, &points, &value);
        if (!status) {
            put_row(j, source, &points, &j->measures[i], &value);
        }
        status = measuring_forgive(j, status);
    }
    koksma_points_fini(&points);
    cli_work_end();
    return status ? cli_fail(j->args, status) : CLI_YES;
}

/* Reads --prefixes, which is "powers" or a list of numbers, or --sizes, a list of numbers. Returns false after an
   error. */
static bool parse_prefixes(measuring *j)
{
    const char *sizes = cli_text(j->args, "sizes", NULL), *prefixes = cli_text(j->args, "prefixes", NULL),
               *text = sizes ? sizes : prefixes, *option = sizes ? "sizes" : "prefixes";
    if (sizes && prefixes) {
        return !cli_error(j->args, "--sizes and --prefixes exclude each other");
    }
    j->own_sets = sizes;
    j->by_size = text;
    j->powers = prefixes && !strcmp(prefixes, "powers");
    return !text || j->powers ||
           cli_sizes(j->args, option, text, sizes ? "" : "powers, or ", KOKSMA_MAX_COORDINATES, j->prefixes,
                     &j->n_prefixes);
}

/* Reads --warp W,W.. and checks that all warps have the same domain. Returns false after an error. */
static bool parse_warps(measuring *j)
{
    const char *list = cli_text(j->args, "warp", NULL);
    char item[KOKSMA_MAX_SPEC];
    while (list && j->n_warps < MAX_WARPS && cli_list_item(list, j->n_warps, item, sizeof item)) {
        const koksma_warp *warp = cli_find_warp(j->args, item);
        if (!warp) {
            return false;
        }
        j->warps[j->n_warps++] = warp;
    }
    j->warp = j->warps[0];
    for (size_t i = 1; i < j->n_warps; i++) {
        if (j->warps[i]->domain != j->warp->domain) {
            return !cli_error(j->args, "--warp %s: its domain differs from that of %s", j->warps[i]->name,
                              j->warp->name);
        }
    }
    return true;
}

/* Returns false, after an error, if the list of an option has more than `most` items. */
static bool check_list(const measuring *j, const char *option, size_t most)
{
    const char *list = cli_text(j->args, option, NULL);
    char item[KOKSMA_MAX_SPEC];
    if (list && cli_list_item(list, most, item, sizeof item)) {
        return !cli_error(j->args, "--%s: it takes up to %zu", option, most);
    }
    return true;
}

/* Whether files stand beside patterns, whose trials they are compared with. */
static bool has_files_beside_patterns(const measuring *j)
{
    int files = 0, patterns = 0;
    for (int i = 0; i < j->args->n_operands; i++) {
        const bool pattern = cli_source_is_pattern(j->args->operands[i]);
        patterns += pattern;
        files += !pattern && !access(j->args->operands[i], R_OK);
    }
    return files && patterns && files + patterns == j->args->n_operands;
}

static bool parse_options(measuring *j)
{
    if (!check_list(j, "measures", MAX_MEASURES) || !check_list(j, "warp", MAX_WARPS)) {
        return false;
    }
    j->paired = cli_flag(j->args, "paired");
    if (!parse_warps(j) || !cli_trials(j->args, 1, 1000000000, &j->seed, &j->trials) ||
        !cli_real(j->args, "time-limit", 0, 0, 1e9, &j->time_limit_s) || !parse_prefixes(j) || !check_prefixes(j) ||
        !cli_sources_check(j->args, 0, !j->paired && has_files_beside_patterns(j) ? 1 : j->trials, j->n_warps)) {
        return false;
    }
    const size_t contestants = (size_t)j->args->n_operands * (j->n_warps ? j->n_warps : 1);
    if (j->paired && (j->trials < 2 || j->trials > MAX_PAIRED_TRIALS || contestants < 2)) {
        return !cli_error(j->args, "--paired: it takes --trials from 2 to %d, and at least two sources or warps",
                          MAX_PAIRED_TRIALS);
    }
    return true;
}

/* Returns the measures that are evaluated without -m. With --warp they are the measures that apply to the domain of
   the warp: NULL if there are none. */
static const char *default_measures(const measuring *j)
{
    static const char *const of_domains[] = {
        [KOKSMA_DOMAIN_DISK] = "edge,l2-edge,l2-disk",
        [KOKSMA_DOMAIN_TRIANGLE] = "edge,l2-edge",
        [KOKSMA_DOMAIN_HEMISPHERE] = "l2-edge,l2-disk:law=area",
        [KOKSMA_DOMAIN_HEMISPHERE_COSINE] = "l2-disk:law=area",
        [KOKSMA_DOMAIN_SPHERE] = "l2-edge,l2-disk:law=area",
        [KOKSMA_DOMAIN_GGX_VISIBLE] = NULL,
    };
    return j->warp ? of_domains[j->warp->domain] : "star,l2-star,extreme";
}

static koksma_status choose_measures(measuring *j, const char *list)
{
    char item[KOKSMA_MAX_SPEC];
    j->all = !strcmp(list, "all");
    if (j->all) {
        while (j->n_measures < MAX_MEASURES && koksma_measure_at(j->n_measures)) {
            koksma_measure_spec(koksma_measure_at(j->n_measures)->name, &j->measures[j->n_measures]);
            j->n_measures++;
        }
        if (j->warp && j->n_measures < MAX_MEASURES) { /* this variant of l2-disk accepts directions */
            koksma_measure_spec("l2-disk:law=area", &j->measures[j->n_measures++]);
        }
        return KOKSMA_OK;
    }
    while (j->n_measures < MAX_MEASURES && cli_list_item(list, j->n_measures, item, sizeof item)) {
        const koksma_status status = koksma_measure_spec(item, &j->measures[j->n_measures]);
        if (status) {
            return status;
        }
        j->n_measures++;
    }
    return KOKSMA_OK;
}

/* `koksma measure --at X,Y..`: the local discrepancy at a corner, which is the fraction of the points in the box from
   the origin to that corner, minus the volume of the box. */

enum { MAX_CORNER = 64 };

static int measure_local(const cli_args *args)
{
    double corner[MAX_CORNER], value;
    const char *list = cli_text(args, "at", "");
    const int dim = (int)cli_reals(list, 0, 1, corner, MAX_CORNER);
    if (!dim) {
        return cli_error(args, "--at %s: it takes the coordinates of a corner in [0,1], such as 0.3,0.7", list);
    }
    uint64_t seed;
    cli_work work;
    if (!cli_refuse(args, "measures trials prefixes sizes warp paired time-limit",
                    "has no effect with --at, which prints only the local discrepancy of the points as they are") ||
        !cli_whole(args, "seed", 0, 0, UINT64_MAX, &seed) || !cli_work_begin(args, "measuring", &work)) {
        return CLI_USAGE;
    }
    int code = CLI_YES;
    for (int i = 0; i < args->n_operands && !code; i++) {
        koksma_points points = {0};
        code = cli_source_points(args, args->operands[i], seed, &work.run, &points);
        if (!code && points.dim != dim) {
            code = cli_error(args, "%s: the points have %d dimensions, but --at %s has %d", args->operands[i],
                             points.dim, list, dim);
        }
        const koksma_status status = code ? KOKSMA_OK : koksma_local_discrepancy(&points, corner, &value);
        code = status ? cli_fail(args, status) : code;
        if (!code) {
            cli_row("source %s n %zu dim %d at %s local_discrepancy %g\n", args->operands[i], points.n, points.dim,
                    list, value);
        }
        koksma_points_fini(&points);
    }
    cli_work_end();
    return cli_rows_close(code);
}

static int run(const cli_args *args)
{
    measuring j = {.args = args};
    if (args->n_operands == 0) {
        return cli_error(args, "it takes files of points, - for stdin, or SPEC@N");
    }
    if (cli_text(args, "at", NULL)) {
        return measure_local(args);
    }
    if (!parse_options(&j) || !cli_work_begin(args, "measuring", &j.work)) {
        return CLI_USAGE;
    }
    j.by_default = !cli_text(args, "measures", NULL);
    const char *list = cli_text(args, "measures", default_measures(&j));
    if (!list) {
        return cli_error(args, "--warp %s: no measure is known on its domain; generate and plot take it",
                         j.warp->name);
    }
    const koksma_status status = choose_measures(&j, list);
    if (status) {
        return cli_fail(args, status);
    }
    choose_columns(&j);
    int code = measuring_open(&j) ? check_patterns(&j) : cli_no_memory();
    for (int i = 0; !code && i < args->n_operands; i++) {
        for (size_t w = 0; !code && w < (j.n_warps ? j.n_warps : 1); w++) {
            j.warp = j.warps[w];
            code = measure_source(&j, args->operands[i]);
        }
    }
    code = cli_rows_close(code);
    for (size_t m = 0; j.fits && m < j.n_measures; m++) {
        char text[KOKSMA_MAX_SPEC];
        koksma_spec_text(&j.measures[m], text);
        cli_tell_cuts(args, text, j.fits[m].n_cut);
    }
    measuring_close(&j);
    return code;
}

static const cli_option options[] = {
    {'m', "measures", "MEASURE,..|all",
     "measures (default: those of star,l2-star,extreme that accept the points; with --warp those for its domain)"},
    CLI_SOURCE_OPTIONS,
    {'s', "seed", "S", "seed of patterns (default: 0)"},
    {'t', "trials", "T",
     "measure T sets of each pattern, with seeds S, S+1, .. to 2^64 - 1 at most; print mean, SD, smallest, largest "
     "and standard error"},
    {0, "prefixes", "K,..|powers",
     "measure the first K points for each K, as in 16,64,256 (powers: all powers of two), and print the log-log "
     "slope"},
    {0, "at", "X,Y..",
     "print only the local discrepancy at this corner x: the fraction of the points in the box [0, x) minus the "
     "volume of the box"},
    {0, "sizes", "N,..",
     "measure a set of N points for each N, as in 16,64,256 (of a file the first N points), and print the log-log "
     "slope"},
    {0, "warp", "WARP,..", "measure the points mapped by WARP: see 'koksma list warps'"},
    {0, "paired", NULL,
     "with --trials: also print the difference of every further source or warp from the first, set by set, with its "
     "95 % interval (Student's t; simulated ones hold in 94 to 96 % up to a skewness of 1/2, in 89 to 95 % at 1 to "
     "2)"},
    {0, "time-limit", "SECONDS",
     "time limit in seconds for each value; a measure that exceeds it gives bounds (default: 0, no limit)"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_measure = {
    .name = "measure",
    .summary = "measure how irregular points are",
    .synopsis = "FILE|-|SPEC@N[@DIM]... [-p PATTERN,..|all -n N,..] [-m MEASURE,..|all] [--json]",
    .details =
        "FILE holds points as text, .csv or .npy. SPEC@N measures N points of a pattern, without a file. The "
        "witness is the region where the supremum is reached. To check a value, compare the fraction of the points "
        "in this region with its volume.\n"
        "\n"
        "--prefixes needs a sequence, because the first points of other patterns, such as n-rooks, fill only a "
        "strip of the square. --sizes instead measures a new set for each N and ignores the N of the source. "
        "'powers' leaves out sizes that a measure does not accept, such as one point for min-distance. --prefixes "
        "and --sizes print the fitted slope beside the proven exponent for the pattern and the best possible one "
        "(up to powers of logarithms). The standard error of a slope comes from the trials. With one set, which is "
        "all that a deterministic pattern has for any --trials, it is replaced by residual_error, the scatter of "
        "the values about the fitted line.\n"
        "\n"
        "--time-limit applies to star-lower, extreme, edge, disk and, from 3 dimensions on, star. A row whose time "
        "ran out has proven bounds, lower and upper. Rows of trials, differences and slopes count how many of "
        "their values are exact. --time-limit has no effect on other measures and on extreme:grid. disk also stops "
        "after 2^28 point tests, which lattices of hundreds of points and other sets of thousands exceed; it then "
        "reports bounds and warns.\n",
    .examples = "koksma measure points.txt -m star,l2-star,extreme\n"
                "koksma measure pattern:random@64 pattern:jittered@64 -m l2-star --trials 100\n"
                "koksma measure --prefixes powers pattern:sobol@4096\n"
                "koksma measure --sizes 16,64,256 pattern:n-rooks@256 -m star --trials 10\n"
                "koksma measure --paired --trials 100 pattern:random@64 pattern:jittered@64\n",
    .options = options,
    .run = run,
};
