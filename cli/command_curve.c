/* SPDX-License-Identifier: Apache-2.0 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>

#include "curves.h"
#include "source.h"

typedef struct curve_job {
    cli_curves curves;
    const char *output; /* a file for the power, or NULL */
    cli_rows *rows;
} curve_job;

static void put_head(const curve_job *j, const char *source, const char *curve)
{
    cli_row_text(j->rows, "source", source);
    cli_row_text(j->rows, "curve", curve);
}

/* The grid as an image, ky = half on top. */
static koksma_status write_image(const char *path, const koksma_spectrum *s)
{
    const int side = 2 * s->half + 1;
    koksma_image image;
    koksma_status status = koksma_image_init(&image, side, side, 1);
    for (int row = 0; row < side && !status; row++) {
        for (int column = 0; column < side; column++) {
            image.pixels[(size_t)row * (size_t)side + (size_t)column] =
                (float)koksma_spectrum_power(s, column - s->half, s->half - row);
        }
    }
    if (!status) {
        status = koksma_image_write(path, &image, NULL);
        koksma_image_fini(&image);
    }
    return status;
}

static int put_power(const curve_job *j, const char *source, const koksma_spectrum *s)
{
    if (j->output) {
        const char *dot = strrchr(j->output, '.');
        const bool image = dot && (!strcmp(dot, ".exr") || !strcmp(dot, ".png") || !strcmp(dot, ".pfm"));
        const koksma_status status = (image ? write_image : koksma_spectrum_write)(j->output, s);
        return status ? cli_fail(j->curves.arguments, status) : CLI_YES;
    }
    for (int ky = 0; ky <= s->half; ky++) {
        for (int kx = -s->half; kx <= s->half; kx++) {
            put_head(j, source, "power");
            cli_row_number(j->rows, "kx", kx);
            cli_row_number(j->rows, "ky", ky);
            cli_row_number(j->rows, "value", koksma_spectrum_power(s, kx, ky));
            cli_row_end(j->rows);
        }
    }
    return CLI_YES;
}

static int put_rings(const curve_job *j, const char *source, const koksma_spectrum *s)
{
    koksma_ring *rings = malloc((size_t)s->half * sizeof *rings);
    if (!rings) {
        return cli_no_memory();
    }
    const koksma_status status = koksma_spectrum_rings(s, rings);
    for (int r = 0; r < s->half && !status; r++) {
        put_head(j, source, "rings");
        cli_row_number(j->rows, "frequency", rings[r].frequency);
        cli_row_number(j->rows, "value", rings[r].power);
        cli_row_number(j->rows, "standard_error", rings[r].standard_error);
        cli_row_number(j->rows, "anisotropy_db", rings[r].anisotropy_db);
        cli_row_end(j->rows);
    }
    free(rings);
    return status ? cli_fail(j->curves.arguments, status) : CLI_YES;
}

static int put_quality(const curve_job *j, const char *source, const koksma_spectrum *s)
{
    koksma_spectrum_quality_values q;
    koksma_spectrum_quality(s, &q);
    if (isnan(q.oscillation) && !cli_flag(j->curves.arguments, "quiet")) {
        fprintf(stderr,
                "koksma curve: %s: no oscillation: frequencies up to %d end before 5 sqrt(n) beyond the rise%s\n",
                source, s->half, s->half < KOKSMA_SPECTRUM_MAX_HALF ? "; try a larger --half" : "");
    }
    put_head(j, source, "quality");
    cli_row_number(j->rows, "effective_nyquist", q.effective_nyquist);
    cli_row_number(j->rows, "relative_nyquist", q.relative_nyquist);
    cli_row_number(j->rows, "oscillation", q.oscillation);
    cli_row_end(j->rows);
    return CLI_YES;
}

static void put_pairs(const curve_job *j, const char *source, const koksma_tally *tallies, double r_max)
{
    for (uint64_t b = 0; b < j->curves.bins; b++) {
        put_head(j, source, "pairs");
        cli_row_number(j->rows, "distance", ((double)b + 0.5) * r_max / (double)j->curves.bins);
        cli_row_number(j->rows, "value", tallies[b].mean);
        cli_row_number(j->rows, "standard_error", koksma_tally_error(&tallies[b]));
        cli_row_end(j->rows);
    }
}

static int pairs_of(curve_job *j, const char *source)
{
    double r_max;
    koksma_tally *tallies = calloc(j->curves.bins, sizeof *tallies);
    const int code = tallies ? cli_curves_pairs(&j->curves, source, tallies, &r_max) : cli_no_memory();
    if (tallies && tallies[0].count > 0) {
        put_pairs(j, source, tallies, r_max);
    }
    free(tallies);
    return code;
}

static int spectrum_of(curve_job *j, const char *kind, const char *source)
{
    koksma_spectrum spectrum;
    int code = cli_curves_spectrum(&j->curves, source, !strcmp(kind, "quality") ? 7 : 2, &spectrum);
    if (spectrum.sets > 0) {
        const int put = (!strcmp(kind, "power")   ? put_power
                         : !strcmp(kind, "rings") ? put_rings
                                                  : put_quality)(j, source, &spectrum);
        code = code ? code : put;
    }
    koksma_spectrum_fini(&spectrum);
    return code;
}

#define SPECTRA "power rings quality"

static const cli_kinds options_of_kinds[] = {
    {"half", SPECTRA}, {"exact", SPECTRA}, {"output", "power"}, {"r-max", "pairs"}, {"bins", "pairs"}, {NULL, NULL},
};

static int run(const cli_arguments *arguments)
{
    static const char *const kinds[] = {"power", "rings", "quality", "pairs"};
    const char *kind = arguments->n_operands > 0 ? arguments->operands[0] : "";
    curve_job j = {.output = cli_text(arguments, "output", NULL)};
    bool known = false;
    for (size_t k = 0; k < 4; k++) {
        known = known || !strcmp(kind, kinds[k]);
    }
    if (!known || arguments->n_operands < 2) {
        return cli_usage_error(arguments, "it takes one of power, rings, quality, pairs, and points");
    }
    if (!cli_options_fit(arguments, options_of_kinds, kind, "")) {
        return CLI_USAGE;
    }
    if (j.output && arguments->n_operands > 2) {
        return cli_usage_error(arguments, "--output: it takes power of one source");
    }
    if (!cli_curves_begin(arguments, &j.curves) || !cli_sources_check(arguments, 1, j.curves.trials, 0)) {
        return CLI_USAGE;
    }
    j.rows = cli_rows_open(cli_flag(arguments, "json"));
    int code = CLI_YES;
    for (int i = 1; i < arguments->n_operands && !code; i++) {
        const char *source = arguments->operands[i];
        code = !strcmp(kind, "pairs") ? pairs_of(&j, source) : spectrum_of(&j, kind, source);
    }
    const int rows_code = cli_rows_close(j.rows);
    return code ? code : rows_code;
}

static const cli_option options[] = {
    CLI_CURVE_OPTIONS("", "all but pairs", "2 sqrt(n); quality: 7 sqrt(n)"),
    {'o', "output", "OUT", "power: the grid to a file: .npy, .csv, text, or grey .exr, .pfm, .png"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_curve = {
    .name = "curve",
    .summary = "measures that are functions: power spectrum, pair correlation",
    .synopsis = "power|rings|quality|pairs FILE|-|pattern:SPEC@N... [--trials T] [--json]",
    .details =
        "power: (1/n)|sum exp(-2 pi i k.x)|^2 at every frequency. rings: its mean over |k|, and the anisotropy\n"
        "(Ulichney 1987): the variance of the power along the ring, divided by the square of its mean, in dB; "
        "random\n"
        "points have -10 log10 of the trials.\n"
        "quality: effective Nyquist frequency, also over sqrt(n)/2 in steps of 1/sqrt(n), so that a square lattice "
        "of\n"
        "16 points has 3/4; and oscillation (Heck, Schlomer, Deussen 2013), which takes frequencies up to about\n"
        "6.5 sqrt(n): from 85,000 points on --half must say so, up to 4096. Memory grows as its square: 1 GB at\n"
        "2047, 4 GB at 4096.\n"
        "pairs: pair correlation on the torus. `koksma plot --curve` draws them.",
    .options = options,
    .run = run,
};
