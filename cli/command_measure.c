/* SPDX-License-Identifier: Apache-2.0 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/warp.h>

#include "cli.h"
#include "source.h"

enum { MAX_MEASURES = 64, MAX_PREFIXES = 64 };

/* Values over trials (Welford 1962). */
typedef struct tally {
    double count, mean, spread, min, max;
} tally;

typedef struct job {
    const cli_arguments *arguments;
    koksma_spec measures[MAX_MEASURES];
    size_t n_measures;
    bool all; /* -m all: measures that can't serve a set are left out */
    uint64_t seed, trials;
    const koksma_warp *warp; /* NULL: none */
    size_t prefixes[MAX_PREFIXES], n_prefixes;
    bool powers; /* prefixes are the powers of two */
    double time_limit_s;
    cli_work work;
    cli_rows *rows;
    tally *tallies; /* [prefix][measure] */
} job;

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
    static const char *const kinds[] = {"none", "box", "half-plane", "disk"};
    if (w->kind == KOKSMA_WITNESS_NONE) {
        cli_row_json(rows, "witness", "null", "-");
        return;
    }
    char json[1024], text[256];
    const int lo_dim = w->kind == KOKSMA_WITNESS_BOX ? w->dim : 2,
              hi_dim = w->kind == KOKSMA_WITNESS_BOX ? w->dim : 1;
    snprintf(json, sizeof json,
             "{\"kind\":\"%s\",\"closed\":%s,\"count\":%zu,\"volume\":%.17g,\"lo\":", kinds[w->kind],
             w->closed ? "true" : "false", w->count, w->volume);
    put_corner(json, sizeof json, w->lo, lo_dim);
    strcat(json, ",\"hi\":");
    put_corner(json, sizeof json, w->hi, hi_dim);
    strcat(json, "}");
    int used = snprintf(text, sizeof text, "%zu points in the %s %s", w->count, w->closed ? "closed" : "open",
                        kinds[w->kind]);
    if (w->kind == KOKSMA_WITNESS_BOX) {
        for (int k = 0; k < w->dim && used < (int)sizeof text; k++) {
            used += snprintf(text + used, sizeof text - (size_t)used, "%s%.6g..%.6g", k ? " x " : " ", w->lo[k],
                             w->hi[k]);
        }
    } else if (w->kind == KOKSMA_WITNESS_HALF_PLANE) {
        snprintf(text + used, sizeof text - (size_t)used, " %.6g x + %.6g y <= %.6g", w->lo[0], w->lo[1], w->hi[0]);
    } else {
        snprintf(text + used, sizeof text - (size_t)used, " about (%.6g, %.6g) of radius %.6g", w->lo[0], w->lo[1],
                 w->hi[0]);
    }
    cli_row_json(rows, "witness", json, text);
}

static void put_row(job *j, const char *source, const koksma_points *points, const koksma_spec *measure,
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
    if (cli_flag(j->arguments, "json")) {
        cli_row_number(j->rows, "square", value->square);
        cli_row_flag(j->rows, "exact", value->exact);
        cli_row_number(j->rows, "lower", value->lower);
        cli_row_number(j->rows, "upper", value->upper);
        cli_row_number(j->rows, "standard_error", value->standard_error);
    }
    put_witness(j->rows, &value->witness);
    cli_row_end(j->rows);
}

static koksma_status evaluate(job *j, size_t measure, const koksma_points *points, koksma_value *value)
{
    const koksma_spec *spec = &j->measures[measure];
    j->work.what = spec->measure->name;
    koksma_run run = j->work.run;
    run.time_limit_s = j->time_limit_s;
    return j->warp ? koksma_warp_evaluate(j->warp, spec, points, &run, value)
                   : koksma_evaluate(spec, points, &run, value);
}

/* -m all leaves out what can't serve a set. */
static koksma_status forgive(const job *j, koksma_status status)
{
    return j->all && (status == KOKSMA_DIM || status == KOKSMA_N || status == KOKSMA_UNSUPPORTED) ? KOKSMA_OK
                                                                                                  : status;
}

static void add_to_tally(tally *t, double value)
{
    t->count++;
    const double off = value - t->mean;
    t->mean += off / t->count;
    t->spread += off * (value - t->mean);
    t->min = t->count == 1 ? value : fmin(t->min, value);
    t->max = t->count == 1 ? value : fmax(t->max, value);
}

static void put_tally(job *j, const char *source, size_t n, int dim, const char *name, const tally *t)
{
    const double sd = t->count > 1 ? sqrt(t->spread / (t->count - 1)) : (double)NAN;
    cli_row_text(j->rows, "source", source);
    cli_row_whole(j->rows, "n", n);
    cli_row_whole(j->rows, "dim", (uint64_t)dim);
    cli_row_text(j->rows, "measure", name);
    if (j->warp) {
        cli_row_text(j->rows, "warp", j->warp->name);
    }
    cli_row_number(j->rows, "value", t->mean);
    cli_row_whole(j->rows, "trials", (uint64_t)t->count);
    cli_row_number(j->rows, "sd", sd);
    cli_row_number(j->rows, "min", t->min);
    cli_row_number(j->rows, "max", t->max);
    cli_row_number(j->rows, "standard_error", sd / sqrt(t->count));
    cli_row_end(j->rows);
}

/* The slope of log value over log n by least squares, with the error that the residuals give it. */
static void put_slope(job *j, const char *source, size_t measure, int dim)
{
    double m = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    char name[KOKSMA_MAX_SPEC + 16], text[KOKSMA_MAX_SPEC];
    for (size_t i = 0; i < j->n_prefixes; i++) {
        const tally *t = &j->tallies[i * j->n_measures + measure];
        if (t->count > 0 && t->mean > 0 && isfinite(t->mean)) {
            const double u = log((double)j->prefixes[i]), v = log(t->mean);
            m++;
            x += u;
            y += v;
            xx += u * u;
            xy += u * v;
            yy += v * v;
        }
    }
    const double sxx = xx - x * x / m, sxy = xy - x * y / m, syy = yy - y * y / m, slope = sxy / sxx;
    if (m < 3) {
        return;
    }
    koksma_spec_text(&j->measures[measure], text);
    snprintf(name, sizeof name, "slope of %s", text);
    cli_row_text(j->rows, "source", source);
    cli_row_whole(j->rows, "n", j->prefixes[j->n_prefixes - 1]);
    cli_row_whole(j->rows, "dim", (uint64_t)dim);
    cli_row_text(j->rows, "measure", name);
    if (j->warp) {
        cli_row_text(j->rows, "warp", j->warp->name);
    }
    cli_row_number(j->rows, "value", slope);
    cli_row_whole(j->rows, "trials", (uint64_t)j->tallies[measure].count);
    cli_row_number(j->rows, "sd", NAN);
    cli_row_number(j->rows, "min", NAN);
    cli_row_number(j->rows, "max", NAN);
    cli_row_number(j->rows, "standard_error", sqrt(fmax(syy - slope * sxy, 0) / (m - 2) / sxx));
    cli_row_end(j->rows);
}

static void put_tallies(job *j, const char *source, int dim)
{
    for (size_t m = 0; m < j->n_measures; m++) {
        char name[KOKSMA_MAX_SPEC];
        koksma_spec_text(&j->measures[m], name);
        for (size_t i = 0; i < j->n_prefixes; i++) {
            if (j->tallies[i * j->n_measures + m].count > 0) {
                put_tally(j, source, j->prefixes[i], dim, name, &j->tallies[i * j->n_measures + m]);
            }
        }
        put_slope(j, source, m, dim);
    }
}

/* The prefixes that a set of n has; the whole set without --prefixes. */
static void choose_prefixes(job *j, size_t n)
{
    if (j->powers || !cli_text(j->arguments, "prefixes", NULL)) {
        j->n_prefixes = 0;
        for (size_t k = 1; j->powers && k < n; k *= 2) {
            j->prefixes[j->n_prefixes++] = k;
        }
        j->prefixes[j->n_prefixes++] = n;
    }
}

static koksma_status tally_points(job *j, const koksma_points *points)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < j->n_prefixes && !status; i++) {
        const koksma_points prefix = {j->prefixes[i], points->dim, points->xs};
        for (size_t m = 0; m < j->n_measures && !status && prefix.n <= points->n; m++) {
            koksma_value value;
            status = evaluate(j, m, &prefix, &value);
            if (!status) {
                add_to_tally(&j->tallies[i * j->n_measures + m], value.value);
            }
            status = forgive(j, status);
        }
    }
    return status;
}

/* Many sets, or prefixes: what was done is printed even if it was cut short. */
static int measure_trials(job *j, const char *source)
{
    int code = CLI_YES, dim = 0;
    memset(j->tallies, 0, MAX_PREFIXES * j->n_measures * sizeof *j->tallies);
    for (uint64_t t = 0; t < j->trials && !code; t++) {
        koksma_points points = {0};
        code = cli_source_points(j->arguments, source, j->seed + t, &j->work.run, &points);
        if (!code) {
            dim = points.dim;
            choose_prefixes(j, points.n);
            const koksma_status status = tally_points(j, &points);
            cli_work_end(&j->work);
            code = status ? cli_fail(j->arguments, status) : CLI_YES;
        }
        koksma_points_fini(&points);
    }
    put_tallies(j, source, dim);
    return code;
}

static int measure_source(job *j, const char *source)
{
    koksma_points points = {0};
    koksma_status status = KOKSMA_OK;
    if (j->trials > 1 || j->n_prefixes > 0 || j->powers) {
        return measure_trials(j, source);
    }
    const int code = cli_source_points(j->arguments, source, j->seed, &j->work.run, &points);
    if (code) {
        koksma_points_fini(&points);
        return code;
    }
    for (size_t i = 0; !status && i < j->n_measures; i++) {
        koksma_value value;
        status = evaluate(j, i, &points, &value);
        if (!status) {
            put_row(j, source, &points, &j->measures[i], &value);
        }
        status = forgive(j, status);
    }
    koksma_points_fini(&points);
    cli_work_end(&j->work);
    return status ? cli_fail(j->arguments, status) : CLI_YES;
}

/* --prefixes powers, or a list of numbers. */
static bool parse_prefixes(job *j)
{
    const char *text = cli_text(j->arguments, "prefixes", NULL);
    j->powers = text && !strcmp(text, "powers");
    while (text && *text && !j->powers) {
        char *end;
        const unsigned long long k = strtoull(text, &end, 10);
        if (*text < '0' || *text > '9' || k == 0 || (*end && *end != ',') || j->n_prefixes == MAX_PREFIXES) {
            cli_usage_error(j->arguments, "--prefixes %s: it takes powers, or up to %d numbers as in 16,64,256", text,
                            MAX_PREFIXES);
            return false;
        }
        j->prefixes[j->n_prefixes++] = k;
        text = *end ? end + 1 : end;
    }
    return true;
}

static bool parse_options(job *j)
{
    const char *warp = cli_text(j->arguments, "warp", NULL);
    j->warp = warp ? koksma_warp_find(warp) : NULL;
    if (warp && !j->warp) {
        char names[512] = "";
        for (size_t i = 0; koksma_warp_at(i); i++) {
            const size_t used = strlen(names);
            snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", koksma_warp_at(i)->name);
        }
        cli_usage_error(j->arguments, "--warp %s: it takes %s", warp, names);
        return false;
    }
    return cli_whole(j->arguments, "seed", 0, 0, UINT64_MAX, &j->seed) &&
           cli_whole(j->arguments, "trials", 1, 1, 1000000000, &j->trials) &&
           cli_real(j->arguments, "time-limit", 0, 0, 1e9, &j->time_limit_s) && parse_prefixes(j);
}

/* What is measured without -m: after a warp, what makes sense on its domain. */
static const char *default_measures(const job *j)
{
    static const char *const of_domains[] = {
        [KOKSMA_DOMAIN_DISK] = "edge,l2-edge,l2-disk",
        [KOKSMA_DOMAIN_TRIANGLE] = "edge,l2-edge",
        [KOKSMA_DOMAIN_HEMISPHERE] = "l2-edge,l2-disk:law=area",
        [KOKSMA_DOMAIN_HEMISPHERE_COSINE] = "l2-disk:law=area",
    };
    return j->warp ? of_domains[j->warp->domain] : "star,l2-star,extreme";
}

static koksma_status choose_measures(job *j, const char *list)
{
    char item[KOKSMA_MAX_SPEC];
    j->all = !strcmp(list, "all");
    if (j->all) {
        while (j->n_measures < MAX_MEASURES && koksma_measure_at(j->n_measures)) {
            koksma_measure_spec(koksma_measure_at(j->n_measures)->name, &j->measures[j->n_measures]);
            j->n_measures++;
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
    job j = {.arguments = arguments};
    if (arguments->n_operands == 0) {
        return cli_usage_error(arguments, "it takes files of points, - for stdin, or pattern:SPEC@N");
    }
    if (!parse_options(&j) || !cli_work_begin(arguments, "measuring", &j.work)) {
        return CLI_USAGE;
    }
    const koksma_status status = choose_measures(&j, cli_text(arguments, "measures", default_measures(&j)));
    if (status) {
        return cli_fail(arguments, status);
    }
    j.rows = cli_rows_open(cli_flag(arguments, "json"));
    j.tallies = calloc(MAX_PREFIXES * (j.n_measures + 1), sizeof *j.tallies);
    int code = j.rows && j.tallies ? CLI_YES : 4;
    for (int i = 0; !code && i < arguments->n_operands; i++) {
        code = measure_source(&j, arguments->operands[i]);
    }
    free(j.tallies);
    const int rows_code = cli_rows_close(j.rows);
    return code ? code : rows_code;
}

static const cli_option options[] = {
    {'m', "measures", "NAMES", "measures, separated by commas, or all (default: star,l2-star,extreme)"},
    {'s', "seed", "S", "seed for pattern: sources (default: 0)"},
    {'t', "trials", "T", "T sets with seeds S, S+1, ..: mean, SD, smallest, largest and standard error"},
    {0, "prefixes", "LIST",
     "the first k points for each k of LIST (as in 16,64,256), or powers; and the log-log slope"},
    {0, "warp", "W", "measure the points mapped by W: concentric-disk, polar-disk, triangle, hemisphere, .."},
    {0, "time-limit", "SECONDS", "for each value: a measure that is cut short gives bounds"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_measure = {
    .name = "measure",
    .summary = "measure how irregular points are",
    .synopsis = "FILE|-|pattern:SPEC@N[@DIM]... [-m NAME,NAME...|all] [--json]",
    .details =
        "FILE holds points as text, .csv or .npy. pattern:SPEC@N measures the points of a pattern without a file.\n"
        "The witness is the region where a supremum is reached: count its points and compare with its volume.",
    .options = options,
    .run = run,
};
