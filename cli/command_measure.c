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

static void put_corner(char *text, size_t size, const double *xs, int dim)
{
    size_t used = strlen(text);
    for (int k = 0; k < dim && used < size; k++) {
        used += (size_t)snprintf(text + used, size - used, "%s%.17g", k ? "," : "[", xs[k]);
    }
    if (used + 1 < size) {
        strcat(text, "]");
    }
}

static void put_witness(cli_rows *rows, const koksma_witness *w)
{
    static const char *const kinds[] = {[KOKSMA_WITNESS_NONE] = "none",
                                        [KOKSMA_WITNESS_BOX] = "box",
                                        [KOKSMA_WITNESS_HALF_PLANE] = "half-plane",
                                        [KOKSMA_WITNESS_DISK] = "disk"};
    if (w->kind == KOKSMA_WITNESS_NONE) {
        cli_row_json(rows, "witness", "null", "-");
        return;
    }
    char json[1024], text[256];
    const int lo_dim = w->kind == KOKSMA_WITNESS_DISK ? 2 : w->dim,
              hi_dim = w->kind == KOKSMA_WITNESS_BOX ? w->dim : 1;
    snprintf(json, sizeof json,
             "{\"kind\":\"%s\",\"closed\":%s,\"count\":%zu,\"volume\":%.17g,\"lo\":", kinds[w->kind],
             w->closed ? "true" : "false", w->count, w->volume);
    put_corner(json, sizeof json, w->lo, lo_dim);
    strcat(json, ",\"hi\":");
    put_corner(json, sizeof json, w->hi, hi_dim);
    strcat(json, "}");
    const bool space = w->kind == KOKSMA_WITNESS_HALF_PLANE && w->dim == 3;
    int used = snprintf(text, sizeof text, "%zu point%s in the %s %s", w->count, w->count == 1 ? "" : "s",
                        w->closed ? "closed" : "open", space ? "half-space" : kinds[w->kind]);
    char a[CLI_NUMBER], b[CLI_NUMBER], c[CLI_NUMBER];
    if (w->kind == KOKSMA_WITNESS_BOX) {
        for (int k = 0; k < w->dim && used < (int)sizeof text; k++) {
            used += snprintf(text + used, sizeof text - (size_t)used, "%s%s..%s", k ? " x " : " ",
                             cli_number(w->lo[k], a), cli_number(w->hi[k], b));
        }
    } else if (w->kind == KOKSMA_WITNESS_HALF_PLANE) {
        used += snprintf(text + used, sizeof text - (size_t)used, " %s x + %s y", cli_number(w->lo[0], a),
                         cli_number(w->lo[1], b));
        if (space) {
            used += snprintf(text + used, sizeof text - (size_t)used, " + %s z", cli_number(w->lo[2], a));
        }
        snprintf(text + used, sizeof text - (size_t)used, " <= %s", cli_number(w->hi[0], a));
    } else {
        snprintf(text + used, sizeof text - (size_t)used, " about (%s, %s) of radius %s", cli_number(w->lo[0], a),
                 cli_number(w->lo[1], b), cli_number(w->hi[0], c));
    }
    cli_row_json(rows, "witness", json, text);
}

static void put_row(measuring *j, const char *source, const koksma_points *points, const koksma_spec *measure,
                    const koksma_value *value)
{
    char name[KOKSMA_MAX_SPEC];
    koksma_spec_text(measure, name);
    cli_row_text(j->rows, "source", source);
    cli_row_whole(j->rows, "n", points->n);
    cli_row_whole(j->rows, "dim", (uint64_t)points->dim);
    cli_row_text(j->rows, "measure", name);
    if (j->warp) {
        cli_row_text(j->rows, "warp", j->warp->name);
    }
    cli_row_number(j->rows, "value", value->value);
    const bool json = cli_flag(j->arguments, "json");
    if (json) {
        cli_row_number(j->rows, "square", value->square);
    }
    if (json || j->bounds || cli_is_cut_short(measure, value)) {
        cli_row_flag(j->rows, "exact", value->exact);
        cli_row_number(j->rows, "lower", value->lower);
        cli_row_number(j->rows, "upper", value->upper);
    }
    if (json || j->sampled) {
        const bool none = !json && measure->measure->answer != KOKSMA_ANSWER_SAMPLED;
        cli_row_number(j->rows, "standard_error", none ? (double)NAN : value->standard_error);
    }
    put_witness(j->rows, &value->witness);
    cli_row_end(j->rows);
}

koksma_status measuring_evaluate(measuring *j, size_t measure, const koksma_points *points, koksma_value *value)
{
    const koksma_spec *spec = &j->measures[measure];
    j->work.what = spec->measure->name;
    const size_t sets = (size_t)j->arguments->n_operands * (j->n_warps ? j->n_warps : 1) * j->trials;
    const size_t all = sets * j->n_measures * (j->n_prefixes ? j->n_prefixes : 1);
    cli_work_part(&j->work, j->n_evaluated < all ? j->n_evaluated : all - 1, all);
    j->n_evaluated++;
    koksma_run run = j->work.run;
    run.time_limit_s = j->time_limit_s;
    const koksma_status status = j->warp ? koksma_warp_evaluate(j->warp, spec, points, &run, value)
                                         : koksma_evaluate(spec, points, &run, value);
    j->n_cut[measure] += !status && cli_is_cut_short(spec, value);
    return status;
}

/* Prints a line on stderr for each measure that was cut short. */
static void tell_cuts(const measuring *j)
{
    for (size_t m = 0; j->n_cut && m < j->n_measures; m++) {
        char text[KOKSMA_MAX_SPEC];
        koksma_spec_text(&j->measures[m], text);
        cli_tell_cuts(j->arguments, text, j->n_cut[m]);
    }
}

/* Chooses the optional columns, which all rows of a table have in common. */
static void choose_columns(measuring *j)
{
    j->bounds = j->time_limit_s > 0;
    j->residuals = measuring_has_residuals(j);
    for (size_t m = 0; m < j->n_measures; m++) {
        j->bounds = j->bounds || j->measures[m].measure->answer == KOKSMA_ANSWER_BOUND;
        j->sampled = j->sampled || j->measures[m].measure->answer == KOKSMA_ANSWER_SAMPLED;
    }
}

/* Returns `status`; but with -m all and without -m it returns KOKSMA_OK for a measure that does not accept a set, so that
   the measure is left out. */
koksma_status measuring_forgive(measuring *j, koksma_status status)
{
    const bool unable = status == KOKSMA_DIM || status == KOKSMA_N || status == KOKSMA_UNSUPPORTED;
    if (!unable || !(j->all || j->by_default)) {
        return status;
    }
    if (j->by_default && !cli_flag(j->arguments, "quiet") && strcmp(j->note, koksma_error_text()) != 0) {
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
    const int code = status ? cli_fail(j->arguments, status) : CLI_YES;
    koksma_points_fini(&points);
    return code;
}

/* Checks the measures for all patterns before the first of them is generated. Returns the exit code. */
static int check_patterns(measuring *j)
{
    int code = CLI_YES;
    for (int i = 0; !code && i < j->arguments->n_operands; i++) {
        cli_source parts;
        code = cli_source_open(j->arguments, j->arguments->operands[i], &parts);
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
    int code = cli_source_points(j->arguments, source, j->seed, &j->work.run, &points);
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
    return status ? cli_fail(j->arguments, status) : CLI_YES;
}

/* Reads --prefixes, which is "powers" or a list of numbers, or --sizes, a list of numbers. Returns false after an
   error. */
static bool parse_prefixes(measuring *j)
{
    const char *sizes = cli_text(j->arguments, "sizes", NULL), *prefixes = cli_text(j->arguments, "prefixes", NULL),
               *text = sizes ? sizes : prefixes, *option = sizes ? "sizes" : "prefixes";
    if (sizes && prefixes) {
        cli_usage_error(j->arguments, "--sizes and --prefixes exclude each other");
        return false;
    }
    j->own_sets = sizes;
    j->powers = prefixes && !strcmp(prefixes, "powers");
    return !text || j->powers ||
           cli_sizes(j->arguments, option, text, sizes ? "" : "powers, or ", KOKSMA_MAX_COORDINATES, j->prefixes,
                     &j->n_prefixes);
}

/* Reads --warp W,W.. and checks that all warps have the same domain. Returns false after an error. */
static bool parse_warps(measuring *j)
{
    const char *list = cli_text(j->arguments, "warp", NULL);
    char item[KOKSMA_MAX_SPEC];
    while (list && j->n_warps < MAX_WARPS && cli_list_item(list, j->n_warps, item, sizeof item)) {
        const koksma_warp *warp = cli_find_warp(j->arguments, item);
        if (!warp) {
            return false;
        }
        j->warps[j->n_warps++] = warp;
    }
    j->warp = j->warps[0];
    for (size_t i = 1; i < j->n_warps; i++) {
        if (j->warps[i]->domain != j->warp->domain) {
            cli_usage_error(j->arguments, "--warp %s: its domain differs from that of %s", j->warps[i]->name,
                            j->warp->name);
            return false;
        }
    }
    return true;
}

/* Returns false, after an error, if the list of an option has more than `most` items. */
static bool check_list(const measuring *j, const char *option, size_t most)
{
    const char *list = cli_text(j->arguments, option, NULL);
    char item[KOKSMA_MAX_SPEC];
    if (list && cli_list_item(list, most, item, sizeof item)) {
        cli_usage_error(j->arguments, "--%s: it takes up to %zu", option, most);
        return false;
    }
    return true;
}

/* Whether files stand beside patterns, whose trials they are compared with. */
static bool has_files_beside_patterns(const measuring *j)
{
    int files = 0, patterns = 0;
    for (int i = 0; i < j->arguments->n_operands; i++) {
        const bool pattern = cli_source_is_pattern(j->arguments->operands[i]);
        patterns += pattern;
        files += !pattern && !access(j->arguments->operands[i], R_OK);
    }
    return files && patterns && files + patterns == j->arguments->n_operands;
}

static bool parse_options(measuring *j)
{
    if (!check_list(j, "measures", MAX_MEASURES) || !check_list(j, "warp", MAX_WARPS)) {
        return false;
    }
    j->paired = cli_flag(j->arguments, "paired");
    if (!parse_warps(j) || !cli_trials(j->arguments, 1, 1000000000, &j->seed, &j->trials) ||
        !cli_real(j->arguments, "time-limit", 0, 0, 1e9, &j->time_limit_s) || !parse_prefixes(j) ||
        !measuring_check_prefixes(j) ||
        !cli_sources_check(j->arguments, 0, !j->paired && has_files_beside_patterns(j) ? 1 : j->trials, j->n_warps)) {
        return false;
    }
    const size_t contestants = (size_t)j->arguments->n_operands * (j->n_warps ? j->n_warps : 1);
    if (j->paired && (j->trials < 2 || j->trials > MAX_PAIRED_TRIALS || contestants < 2)) {
        cli_usage_error(j->arguments, "--paired: it takes --trials from 2 to %d, and at least two sources or warps",
                        MAX_PAIRED_TRIALS);
        return false;
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

static int run(const cli_arguments *arguments)
{
    measuring j = {.arguments = arguments};
    if (arguments->n_operands == 0) {
        return cli_usage_error(arguments, "it takes files of points, - for stdin, or SPEC@N");
    }
    if (cli_text(arguments, "at", NULL)) {
        return measure_local(arguments);
    }
    if (!parse_options(&j) || !cli_work_begin(arguments, "measuring", &j.work)) {
        return CLI_USAGE;
    }
    j.by_default = !cli_text(arguments, "measures", NULL);
    const char *list = cli_text(arguments, "measures", default_measures(&j));
    if (!list) {
        return cli_usage_error(arguments, "--warp %s: no measure is known on its domain; generate and plot take it",
                               j.warp->name);
    }
    const koksma_status status = choose_measures(&j, list);
    if (status) {
        return cli_fail(arguments, status);
    }
    choose_columns(&j);
    j.rows = cli_rows_open(cli_flag(arguments, "json"));
    int code = measuring_open(&j) ? check_patterns(&j) : cli_no_memory();
    for (int i = 0; !code && i < arguments->n_operands; i++) {
        for (size_t w = 0; !code && w < (j.n_warps ? j.n_warps : 1); w++) {
            j.warp = j.warps[w];
            code = measure_source(&j, arguments->operands[i]);
        }
    }
    code = cli_rows_close(j.rows, code);
    tell_cuts(&j);
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
