/* SPDX-License-Identifier: Apache-2.0 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plots.h"
#include "source.h"
#include "warps.h"

enum { MAX_PANELS = 16 };

/* --grid M or MxN, --rooks, --columns and --rows. */
static bool choose_cells(const plot_job *j, const koksma_points *points, koksma_scatter_options *out)
{
    uint64_t columns, rows;
    const char *grid = cli_text(j->curves.arguments, "grid", NULL);
    if (!cli_whole(j->curves.arguments, "columns", 0, 1, MAX_CELLS, &columns) ||
        !cli_whole(j->curves.arguments, "rows", 0, 1, MAX_CELLS, &rows)) {
        return false;
    }
    if (grid) {
        char *end;
        columns = rows = strtoull(grid, &end, 10);
        bool good = grid[0] >= '0' && grid[0] <= '9';
        if (good && *end == 'x') {
            const char *second = end + 1;
            rows = strtoull(second, &end, 10);
            good = second[0] >= '0' && second[0] <= '9';
        }
        if (!good || *end || columns < 1 || rows < 1 || columns > MAX_CELLS || rows > MAX_CELLS) {
            cli_usage_error(j->curves.arguments, "--grid %s: it takes M, or MxN columns and rows, up to %d", grid,
                            MAX_CELLS);
            return false;
        }
    }
    if (cli_flag(j->curves.arguments, "rooks")) {
        columns = rows = points->n < MAX_CELLS ? points->n : 0; /* closer than a line is wide */
    }
    out->columns = columns;
    out->rows = rows;
    return true;
}

/* One panel's points, its cells and its witness; caption has room for KOKSMA_MAX_SPEC characters. */
static int add_points(plot_job *j, const char *source, koksma_points *points, koksma_panel *panel,
                      koksma_value *value, char *caption)
{
    koksma_spec measure;
    int code = cli_source_points(j->curves.arguments, source, j->curves.seed, &j->curves.work.run, points);
    if (code) {
        return code;
    }
    *panel = (koksma_panel){.points = points};
    if (!choose_cells(j, points, &panel->scatter)) {
        return CLI_USAGE;
    }
    panel->scatter.warp = j->warp;
    panel->scatter.local_discrepancy = cli_flag(j->curves.arguments, "local-discrepancy");
    if (j->witness) {
        koksma_status status = koksma_measure_spec(j->witness, &measure);
        if (!status) {
            status = koksma_evaluate(&measure, points, &j->curves.work.run, value);
        }
        cli_work_end(&j->curves.work);
        if (status) {
            return cli_fail(j->curves.arguments, status);
        }
        const bool is_bound = !value->exact && measure.measure->answer != KOKSMA_ANSWER_SAMPLED;
        snprintf(caption, KOKSMA_MAX_SPEC, "%.200s %s %.6f", j->witness, is_bound ? ">=" : "=", value->value);
        panel->scatter.witness = &value->witness;
        panel->caption = caption;
    } else if (j->curves.arguments->n_operands > 1) {
        panel->caption = plot_label(source);
    }
    return CLI_YES;
}

static int plot_points(plot_job *j)
{
    const int n = j->curves.arguments->n_operands;
    koksma_points points[MAX_PANELS] = {{0}};
    koksma_panel panels[MAX_PANELS] = {{0}};
    koksma_value values[MAX_PANELS];
    char captions[MAX_PANELS][KOKSMA_MAX_SPEC];
    int code = CLI_YES;
    for (int i = 0; i < n && !code; i++) {
        code = add_points(j, j->curves.arguments->operands[i], &points[i], &panels[i], &values[i], captions[i]);
    }
    if (!code) {
        code = plot_panels(j, panels, (size_t)n);
    }
    for (int i = 0; i < n; i++) {
        koksma_points_fini(&points[i]);
    }
    return code;
}

static int plot_power(plot_job *j)
{
    const int n = j->curves.arguments->n_operands;
    koksma_spectrum spectra[MAX_PANELS] = {{0}};
    koksma_panel panels[MAX_PANELS] = {{0}};
    double white;
    int code = cli_real(j->curves.arguments, "white", 2, 1e-9, 1e9, &white) ? CLI_YES : CLI_USAGE;
    for (int i = 0; i < n && !code; i++) {
        const char *source = j->curves.arguments->operands[i];
        code = cli_curves_spectrum(&j->curves, source, 2, &spectra[i]);
        panels[i] = (koksma_panel){.spectrum = &spectra[i], .white = white, .caption = plot_label(source)};
    }
    if (!code) {
        code = plot_panels(j, panels, (size_t)n);
    }
    for (int i = 0; i < n; i++) {
        koksma_spectrum_fini(&spectra[i]);
    }
    return code;
}

typedef struct plot_kind {
    const char *name;
    int (*plot)(plot_job *j);
} plot_kind;

static const plot_kind kinds[] = {
    {"points", plot_points},  {"power", plot_power},
    {"radial", plot_radial},  {"anisotropy", plot_radial},
    {"pairs", plot_pairs},    {"convergence", plot_convergence},
    {"filter", plot_filters}, {"filter-response", plot_filters},
};

static const plot_kind *find_kind(const char *name)
{
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        if (!strcmp(name, kinds[k].name)) {
            return &kinds[k];
        }
    }
    return NULL;
}

#define SPECTRA "power radial anisotropy"

static const cli_kinds options_of_kinds[] = {
    {"columns", "points"},
    {"rows", "points"},
    {"grid", "points"},
    {"rooks", "points"},
    {"witness", "points"},
    {"warp", "points"},
    {"local-discrepancy", "points"},
    {"white", "power"},
    {"half", SPECTRA},
    {"exact", SPECTRA},
    {"r-max", "pairs"},
    {"bins", "pairs"},
    {"measure", "convergence"},
    {"sizes", "convergence"},
    {"trials", SPECTRA " pairs convergence"},
    {NULL, NULL},
};

/* Trials that every source must have a set for: convergence draws a file, which is one, beside means of patterns. */
static uint64_t trials_of_all(const plot_job *j)
{
    const cli_arguments *arguments = j->curves.arguments;
    bool has_pattern = false;
    for (int i = 0; i < arguments->n_operands; i++) {
        has_pattern = has_pattern || plot_label(arguments->operands[i]) != arguments->operands[i];
    }
    return has_pattern && !strcmp(j->curve, "convergence") ? 1 : j->curves.trials;
}

static int run(const cli_arguments *arguments)
{
    plot_job j = {.output = cli_text(arguments, "output", NULL),
                  .witness = cli_text(arguments, "witness", NULL),
                  .curve = cli_text(arguments, "curve", "points")};
    if (arguments->n_operands < 1 || arguments->n_operands > MAX_PANELS || !j.output) {
        return cli_usage_error(
            arguments, "it takes points (up to %d sets) and a picture, as in points.txt -o points.svg", MAX_PANELS);
    }
    const plot_kind *kind = find_kind(j.curve);
    if (!kind) {
        return cli_usage_error(
            arguments,
            "--curve %s: it takes points, power, radial, anisotropy, pairs, convergence, filter or filter-response",
            j.curve);
    }
    if (!cli_options_fit(arguments, options_of_kinds, j.curve, "--curve ") ||
        !cli_whole(arguments, "size", 0, 16, 8192, &j.size) || !cli_curves_begin(arguments, &j.curves) ||
        (kind->plot != plot_filters && !cli_sources_check(arguments, 0, trials_of_all(&j), 0))) {
        return CLI_USAGE;
    }
    const char *warp = cli_text(arguments, "warp", NULL);
    if (warp && !(j.warp = cli_find_warp(arguments, warp))) {
        return CLI_USAGE;
    }
    const koksma_status status = koksma_plot_format_of(j.output, &j.format);
    return status ? cli_fail(arguments, status) : kind->plot(&j);
}

static const cli_option options[] = {
    {'o', "output", "OUT", "picture to write: .svg, .pdf or .png"},
    {'c', "curve", "points|power|radial|anisotropy|pairs|convergence|filter|filter-response",
     "what is drawn (default: points)"},
    {0, "size", "S", "side or width of a picture in points or pixels (default: 320, charts 480)"},
    {0, "columns", "C", "points: draw C columns of cells"},
    {0, "rows", "R", "points: draw R rows of cells"},
    {0, "grid", "M[xN]", "points: draw M x M cells, or M columns and N rows"},
    {0, "rooks", NULL, "points: draw n columns and n rows"},
    {0, "witness", "MEASURE", "points: draw the region where this measure's supremum is reached, with its value"},
    {0, "warp", "WARP", "points: draw them and the cells through this map: see 'koksma list warps'"},
    {0, "local-discrepancy", NULL,
     "points: colour the square by the share of the points in the box from the origin, less its area"},
    {0, "white", "P", "power: the power that is drawn white (default: 2; random points have 1)"},
    {'m', "measure", "MEASURE", "convergence: of this measure (default: l2-star)"},
    {0, "sizes", "N,..", "convergence: at these n, as in 16,64,256 (default: powers of 4 up to the source's)"},
    CLI_CURVE_OPTIONS("all but points: ", "power, radial, anisotropy", "2 sqrt(n)"),
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_plot = {
    .name = "plot",
    .summary = "draw points, where a measure finds them worst, spectra and convergence",
    .synopsis = "FILE|-|pattern:SPEC@N... -o OUT.svg|.pdf|.png [--curve KIND] [--trials T]",
    .details =
        "Points and power spectra of several sources are drawn side by side, curves in one chart. power leaves out\n"
        "the frequency 0. radial and pairs show the level 1 of random points. convergence is the mean over trials\n"
        "against n on logarithmic axes, with the fitted slope and its standard error, and dashed the slopes that\n"
        "theory gives for the pattern, or else the best that any points can have. A file's sizes are its prefixes.\n"
        "filter and filter-response take names of pixel filters for sources; leakage is the part of the squared\n"
        "response beyond half a cycle a pixel.",
    .options = options,
    .run = run,
};
