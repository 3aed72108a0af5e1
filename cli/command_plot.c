/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma plot`: draws the points of each source, or another curve of the table curves.def, in one picture. */
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "curves.h"
#include "measuring.h"
#include "source.h"

/* Returns the number of sets that every source must provide. The number is 1 if the picture may show a file, which is
   one set, beside means over several sets of a pattern. */
static uint64_t trials_of_all(const cli_curves *c)
{
    const cli_args *args = c->args;
    bool has_pattern = false;
    for (int i = 0; i < args->n_operands; i++) {
        has_pattern = has_pattern || cli_source_is_pattern(args->operands[i]);
    }
    return has_pattern && c->curve->plot.mixes_files ? 1 : c->trials;
}

/* Reads --size W[xH] and --theme. Returns false after an error. */
static bool choose_looks(const cli_args *args, cli_curves *c)
{
    const char *size = cli_text(args, "size", NULL);
    int width = 0, height = 0, used = 0, dark = 0;
    const int n = size ? sscanf(size, "%5d%nx%5d%n", &width, &used, &height, &used) : 0;
    if (size && (n < 1 || size[used] || width < 16 || width > 8192 || (n > 1 && (height < 16 || height > 8192)))) {
        return !cli_error(args, "--size %s: it takes W, or WxH, of 16 to 8192", size);
    }
    c->width = width;
    c->height = height;
    const bool known = cli_choice(args, "theme", &dark);
    c->dark = dark;
    return known;
}

static int run(const cli_args *args)
{
    cli_curves c;
    char names[256], what[80];
    const bool compare = cli_flag(args, "compare");
    const char *name = cli_text(args, "curve", compare ? cli_curve_compare.name : cli_curve_points.name);
    if (compare && strcmp(name, cli_curve_compare.name) != 0) {
        return cli_error(args, "--compare excludes --curve %s, because --compare draws a fixed set of charts", name);
    }
    const cli_curve *curve = cli_curve_find(CLI_DRAWN, name);
    if (args->n_operands < 1 || !cli_text(args, "output", NULL)) {
        return curve && curve->plot.of_filters
                   ? cli_error(args,
                               "--curve %s takes names of filters and a picture, as in box mitchell -o filters.svg",
                               name)
                   : cli_error(args, "it takes points and a picture, as in points.txt -o points.svg");
    }
    if (args->n_operands > CLI_MAX_PANELS) {
        return cli_error(args, "%d sets of points: a picture has up to %d", args->n_operands, CLI_MAX_PANELS);
    }
    if (!curve) {
        cli_curve_names(CLI_DRAWN, NULL, ", ", " or ", names, sizeof names);
        snprintf(what, sizeof what, "--curve %.60s: ", name);
        return cli_takes(args, what, name, names);
    }
    if (!cli_curves_begin(args, curve, CLI_DRAWN, "--curve ", &c) || !choose_looks(args, &c) ||
        (!curve->plot.of_filters && !cli_sources_check(args, 0, trials_of_all(&c), 0))) {
        return CLI_USAGE;
    }
    c.witness = cli_text(args, "witness", NULL);
    const char *warp = cli_text(args, "warp", NULL);
    if (warp && !(c.warp = cli_find_warp(args, warp))) {
        return CLI_USAGE;
    }
    const koksma_status status = koksma_plot_format_of(c.output, &c.format);
    const int code = status ? cli_fail(args, status) : cli_try_output(args, c.output);
    return code ? code : curve->plot.draw(&c);
}

static const cli_option options[] = {
    {'o', "output", "OUT", "picture to write: .svg, .pdf or .png"},
    CLI_SOURCE_OPTIONS,
    {'c', "curve", "{chart}", "the curve to draw (default: points)"},
    {0, "compare", NULL, "the same as --curve compare"},
    {0, "size", "W[xH]",
     "width and height of the picture in points or pixels (default: 320 for each set, 480 for charts)"},
    {0, "title", "TEXT", "heading of the picture (default: the name of the curve)"},
    {0, "theme", "light|dark", "dark lines on a light background, or the reverse (default: light)"},
    {0, "columns", "C", "points: draw C columns of cells"},
    {0, "rows", "R", "points: draw R rows of cells"},
    {0, "grid", "M[xN]", "points: draw M x M cells, or M columns and N rows"},
    {0, "rooks", NULL, "points: draw n columns and n rows"},
    {0, "witness", "MEASURE", "points: draw the region where this measure's supremum is reached, with its value"},
    {0, "warp", "WARP", "points: draw points and cells mapped by WARP: see 'koksma list warps'"},
    {0, "local-discrepancy", NULL,
     "points: colour each position x of the square by the fraction of the points in the box [0, x) minus its area"},
    {0, "white", "P", "power: the power that is drawn as white (default: 2; random points have 1)"},
    {'m', "measure", "MEASURE", "convergence, compare: the measure to draw (default: l2-star)"},
    {0, "sizes", "N,..",
     "convergence, compare: draw these n, as in 16,64,256 (default: powers of 4 up to the n of the source, and n; "
     "files: n)"},
    CLI_CURVE_OPTIONS("chart", "2 sqrt(n)", "rings and pairs have error bars"),
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_plot = {
    .name = "plot",
    .summary = "draw points, their worst regions, spectra and convergence",
    .synopsis = "FILE|-|SPEC@N... [-p PATTERN,..|all -n N,..] -o OUT.svg|.pdf|.png [--curve KIND|--compare] "
                "[--trials T]",
    .details =
        "{chart-meanings}\n"
        "Points and power spectra of several sources are drawn side by side, curves in one chart. Points of 3 "
        "dimensions and more are drawn as projections on all pairs of the first 8 axes. A pattern has the colour of "
        "its family in all pictures.",
    .examples = "koksma plot pattern:n-rooks@16 -o points.svg --witness star\n"
                "koksma plot --compare pattern:random@256 pattern:jittered@256 -o figure.svg\n"
                "koksma plot pattern:sobol@64@4 -o projections.svg --title 'Sobol points'\n"
                "koksma plot pattern:jittered@64 --warp polar-disk --grid 8 -o disk.png\n"
                "koksma plot --curve power pattern:jittered@256 --trials 10 -o power.svg\n"
                "koksma plot --curve rings pattern:random@256 pattern:jittered@256 -o r.pdf\n"
                "koksma plot --curve pairs pattern:jittered@256 -o pairs.svg --size 400x300\n"
                "koksma plot --curve anisotropy pattern:n-rooks@256 -t 10 -o a.svg --theme dark\n"
                "koksma plot --curve convergence pattern:random@256 pattern:sobol@256 -o c.svg\n"
                "koksma plot --curve filter-response box tent mitchell -o response.svg\n",
    .options = options,
    .run = run,
};
