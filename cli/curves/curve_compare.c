/* SPDX-License-Identifier: Apache-2.0 */
/*
 * compare: a figure as in many papers on sampling. The figure shows the points of each source, below them their mean
 * power spectra, and below these two charts with all sources: the radial means of the spectra, and the convergence of
 * a measure.
 */
#include <string.h>
#include <sys/stat.h>

#include "../curves.h"
#include "../source.h"

enum { TRIALS = 10 };

typedef struct comparison {
    koksma_points points[CLI_MAX_PANELS];
    koksma_spectrum spectra[CLI_MAX_PANELS];
    koksma_panel panels[2][CLI_MAX_PANELS];
    char titles[CLI_MAX_PANELS][CLI_CHART_LABEL];
} comparison;

/* Prepares the panels of points and of power spectra for all sources. Returns the exit code. */
static int open_panels(cli_curves *c, comparison *m)
{
    size_t colours[CLI_MAX_PANELS];
    int code = CLI_YES;
    cli_colours(c, colours);
    for (int i = 0; i < c->arguments->n_operands && !code; i++) {
        const char *source = c->arguments->operands[i];
        struct stat info;
        const bool in_file = !cli_source_is_pattern(source) && !stat(source, &info);
        if (!strcmp(source, "-") || (in_file && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode))) {
            return cli_usage_error(
                c->arguments, "%s: %s reads its sources more than once, so it needs files instead of stdin and pipes",
                source, c->curve->name);
        }
        cli_title(source, m->titles[i]);
        m->panels[0][i] = (koksma_panel){.points = &m->points[i], .title = m->titles[i], .swatch = 1 + colours[i]};
        m->panels[1][i] = (koksma_panel){.spectrum = &m->spectra[i], .title = m->titles[i], .swatch = 1 + colours[i]};
        code = cli_source_points(c->arguments, source, c->seed, &c->work.run, &m->points[i]);
        code = code ? code : cli_curves_spectrum(c, source, 2, &m->spectra[i]);
    }
    return code;
}

static int draw(cli_curves *c)
{
    const size_t n = (size_t)c->arguments->n_operands;
    comparison m = {0};
    cli_convergence v = {0};
    cli_chart_store rings = {0};
    koksma_chart radial = {0};
    koksma_cell cells[2 * CLI_MAX_PANELS + 2] = {{0}};
    c->trials = cli_flag(c->arguments, "trials") ? c->trials : TRIALS;
    int code = open_panels(c, &m);
    code = code ? code : cli_chart_open(c, &cli_curve_rings, &rings, &radial);
    code = code ? code : cli_convergence_open(c, &v);
    for (size_t i = 0; i < 2 * n; i++) {
        cells[i] = (koksma_cell){.panel = &m.panels[i / n][i % n], .row = i / n};
    }
    radial.title = cli_curve_rings.plot.title;
    v.chart.title = v.title;
    cells[2 * n] = (koksma_cell){.chart = &radial, .row = 2};
    cells[2 * n + 1] = (koksma_cell){.chart = &v.chart, .row = 2};
    code = code ? code : cli_write_figure(c, "Points, power spectra and convergence", cells, 2 * n + 2);
    for (size_t i = 0; i < n; i++) {
        koksma_points_fini(&m.points[i]);
        koksma_spectrum_fini(&m.spectra[i]);
    }
    cli_close_store(&rings);
    cli_close_store(&v.store);
    return code;
}

const cli_curve cli_curve_compare = {
    .name = "compare",
    .meaning = "compares several sources in one figure: their points, power spectra, radial means of the spectra, "
               "and convergence of a measure; the means are over 10 sets unless --trials is given",
    .cite = "-",
    .plot = {.options = "half exact measure sizes trials", .draw = draw, .mixes_files = true},
};
