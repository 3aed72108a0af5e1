/* SPDX-License-Identifier: Apache-2.0 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/spectrum.h>

#include "cli.h"
#include "source.h"

typedef struct curve_job {
    const cli_arguments *arguments;
    uint64_t seed, trials, half, bins;
    double r_max;
    koksma_spectrum_method method;
    cli_work work;
    cli_rows *rows;
} curve_job;

static void put_head(const curve_job *j, const char *source, const char *curve)
{
    cli_row_text(j->rows, "source", source);
    cli_row_text(j->rows, "curve", curve);
}

static void put_power(const curve_job *j, const char *source, const koksma_spectrum *s)
{
    for (int ky = 0; ky <= s->half; ky++) {
        for (int kx = -s->half; kx <= s->half; kx++) {
            put_head(j, source, "power");
            cli_row_number(j->rows, "kx", kx);
            cli_row_number(j->rows, "ky", ky);
            cli_row_number(j->rows, "value", koksma_spectrum_power(s, kx, ky));
            cli_row_end(j->rows);
        }
    }
}

static void put_rings(const curve_job *j, const char *source, const koksma_spectrum *s)
{
    koksma_ring *rings = malloc((size_t)s->half * sizeof *rings);
    if (!rings) {
        return;
    }
    koksma_spectrum_rings(s, rings);
    for (int r = 0; r < s->half; r++) {
        put_head(j, source, "rings");
        cli_row_number(j->rows, "frequency", rings[r].frequency);
        cli_row_number(j->rows, "value", rings[r].power);
        cli_row_number(j->rows, "standard_error", rings[r].standard_error);
        cli_row_number(j->rows, "anisotropy_db", rings[r].anisotropy_db);
        cli_row_end(j->rows);
    }
    free(rings);
}

static void put_quality(const curve_job *j, const char *source, const koksma_spectrum *s)
{
    double nyquist, oscillation;
    koksma_spectrum_quality(s, &nyquist, &oscillation);
    put_head(j, source, "quality");
    cli_row_number(j->rows, "effective_nyquist", nyquist);
    cli_row_number(j->rows, "relative_to_sqrt_n", nyquist / sqrt(s->points));
    cli_row_number(j->rows, "oscillation", oscillation);
    cli_row_end(j->rows);
}

/* half = 0: twice the square root of n each way. */
static koksma_status add_spectrum(curve_job *j, koksma_spectrum *s, const koksma_points *points)
{
    koksma_status status = KOKSMA_OK;
    if (!s->power) {
        const double wish = ceil(2 * sqrt((double)points->n));
        status = koksma_spectrum_init(s, j->half ? (int)j->half : wish < 2048 ? (int)wish : 2048);
    }
    return status ? status : koksma_spectrum_add(s, points, j->method, &j->work.run);
}

static void put_pairs(const curve_job *j, const char *source, const double *sums, uint64_t sets)
{
    for (uint64_t b = 0; b < j->bins; b++) {
        const double mean = sums[b] / (double)sets, variance = sums[j->bins + b] / (double)sets - mean * mean;
        put_head(j, source, "pairs");
        cli_row_number(j->rows, "distance", ((double)b + 0.5) * j->r_max / (double)j->bins);
        cli_row_number(j->rows, "value", mean);
        cli_row_number(j->rows, "standard_error",
                       sets > 1 ? sqrt(fmax(variance, 0) / ((double)sets - 1)) : (double)NAN);
        cli_row_end(j->rows);
    }
}

static koksma_status add_pairs(const curve_job *j, const koksma_points *points, double *sums)
{
    double *values = sums + 2 * j->bins;
    const koksma_status status = koksma_pair_correlation(points, j->r_max, j->bins, values);
    for (uint64_t b = 0; b < j->bins && !status; b++) {
        sums[b] += values[b];
        sums[j->bins + b] += values[b] * values[b];
    }
    return status;
}

static int curve_of(curve_job *j, const char *kind, const char *source)
{
    const bool pairs = !strcmp(kind, "pairs");
    koksma_spectrum spectrum = {0};
    double *sums = calloc(3 * j->bins, sizeof *sums);
    int code = sums ? CLI_YES : 4;
    uint64_t sets = 0;
    while (sets < j->trials && !code) {
        koksma_points points;
        code = cli_source_points(j->arguments, source, j->seed + sets, &j->work.run, &points);
        if (!code) {
            const koksma_status status = cli_interrupted() ? KOKSMA_INTERRUPTED
                                         : pairs           ? add_pairs(j, &points, sums)
                                                           : add_spectrum(j, &spectrum, &points);
            cli_work_end(&j->work);
            code = status ? cli_fail(j->arguments, status) : CLI_YES;
            sets += !status;
        }
        koksma_points_fini(&points);
    }
    if (sets > 0 && pairs) {
        put_pairs(j, source, sums, sets);
    } else if (sets > 0) {
        (!strcmp(kind, "power") ? put_power : !strcmp(kind, "rings") ? put_rings : put_quality)(j, source, &spectrum);
    }
    koksma_spectrum_fini(&spectrum);
    free(sums);
    return code;
}

static int run(const cli_arguments *arguments)
{
    static const char *const kinds[] = {"power", "rings", "quality", "pairs"};
    curve_job j = {.arguments = arguments};
    bool known = false;
    for (size_t k = 0; k < 4 && arguments->n_operands > 0; k++) {
        known = known || !strcmp(arguments->operands[0], kinds[k]);
    }
    if (!known || arguments->n_operands < 2) {
        return cli_usage_error(arguments, "it takes one of power, rings, quality, pairs, and points");
    }
    if (!cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &j.seed) ||
        !cli_whole(arguments, "trials", 1, 1, 1000000000, &j.trials) ||
        !cli_whole(arguments, "half", 0, 1, KOKSMA_SPECTRUM_MAX_HALF, &j.half) ||
        !cli_whole(arguments, "bins", 100, 1, 1000000, &j.bins) ||
        !cli_real(arguments, "r-max", 0.1, 1e-6, 0.5, &j.r_max) || !cli_work_begin(arguments, "spectrum", &j.work)) {
        return CLI_USAGE;
    }
    j.method = cli_flag(arguments, "exact") ? KOKSMA_SPECTRUM_EXACT : KOKSMA_SPECTRUM_FAST;
    j.rows = cli_rows_open(cli_flag(arguments, "json"));
    int code = j.rows ? CLI_YES : 4;
    for (int i = 1; i < arguments->n_operands && !code; i++) {
        code = curve_of(&j, arguments->operands[0], arguments->operands[i]);
    }
    const int rows_code = cli_rows_close(j.rows);
    return code ? code : rows_code;
}

static const cli_option options[] = {
    {'s', "seed", "S", "seed for pattern: sources (default: 0)"},
    {'t', "trials", "T", "the mean over T sets with seeds S, S+1, .., with standard errors"},
    {0, "half", "H", "frequencies up to H in each coordinate (default: twice the square root of n)"},
    {0, "exact", NULL, "sum over all points at each frequency instead of the fast transform"},
    {0, "r-max", "R", "pairs: distances up to R (default: 0.1)"},
    {0, "bins", "B", "pairs: rings of distances (default: 100)"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_curve = {
    .name = "curve",
    .summary = "measures that are functions: power spectrum, pair correlation",
    .synopsis = "power|rings|quality|pairs FILE|-|pattern:SPEC@N... [--trials T] [--json]",
    .details =
        "power: (1/n)|sum exp(-2 pi i k.x)|^2 at every frequency. rings: its mean over |k|, and the anisotropy.\n"
        "quality: effective Nyquist frequency and oscillation. pairs: pair correlation on the torus.",
    .options = options,
    .run = run,
};
