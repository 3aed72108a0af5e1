/* SPDX-License-Identifier: Apache-2.0 */
/*
 * points: draws the points of each source in a panel, in the square or mapped by a warp. Options add cells, the
 * region where a measure reaches its supremum, or the local discrepancy as colours behind the points.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../curves.h"
#include "../source.h"

enum { MAX_CELLS = 4096 };

/* Reads the number of cells from --grid M or MxN, --rooks, --columns and --rows. Returns false after an error. */
static bool choose_cells(const cli_curves *c, const koksma_points *points, koksma_scatter_options *out)
{
    uint64_t columns, rows;
    unsigned m = 0, n = 0;
    int used = 0;
    const char *grid = cli_text(c->args, "grid", NULL);
    const bool rooks = cli_flag(c->args, "rooks"), cells = cli_flag(c->args, "columns") || cli_flag(c->args, "rows");
    if (rooks + (grid != NULL) + cells > 1) {
        return !cli_error(c->args, "--%s excludes --%s: each of them chooses the cells", rooks ? "rooks" : "grid",
                          grid && rooks                  ? "grid"
                          : cli_flag(c->args, "columns") ? "columns"
                                                         : "rows");
    }
    if (!cli_whole(c->args, "columns", 0, 1, MAX_CELLS, &columns) ||
        !cli_whole(c->args, "rows", 0, 1, MAX_CELLS, &rows)) {
        return false;
    }
    if (grid) {
        const int given = sscanf(grid, "%5u%nx%5u%n", &m, &used, &n, &used);
        n = given < 2 ? m : n;
        if (given < 1 || grid[used] || strspn(grid, "0123456789x") != strlen(grid) || m < 1 || n < 1 ||
            m > MAX_CELLS || n > MAX_CELLS) {
            return !cli_error(c->args, "--grid %s: it takes M, or MxN columns and rows, up to %d", grid, MAX_CELLS);
        }
    }
    /* with more cells than MAX_CELLS the guide lines would overlap */
    const size_t all = rooks && points->n < MAX_CELLS ? points->n : 0;
    out->columns = rooks ? all : grid ? m : columns;
    out->rows = rooks ? all : grid ? n : rows;
    return true;
}

/* Prepares one panel: its points, cells and witness. caption has room for KOKSMA_MAX_SPEC characters. Returns the
   exit code. */
static int add_points(cli_curves *c, const char *source, koksma_points *points, koksma_panel *panel,
                      koksma_value *value, char *caption, char *title)
{
    koksma_spec measure;
    int code = cli_source_points(c->args, source, c->seed, &c->work.run, points);
    if (code) {
        return code;
    }
    *panel = (koksma_panel){.points = points, .title = cli_title(source, title)};
    if (!choose_cells(c, points, &panel->scatter)) {
        return CLI_USAGE;
    }
    panel->scatter.warp = c->warp;
    panel->scatter.local_discrepancy = cli_flag(c->args, "local-discrepancy");
    if (c->witness) {
        koksma_status status = koksma_measure_spec(c->witness, &measure);
        status = status ? status : koksma_evaluate(&measure, points, &c->work.run, value);
        cli_work_end();
        if (status) {
            return cli_fail(c->args, status);
        }
        const bool is_bound = !value->exact && measure.measure->answer != KOKSMA_ANSWER_SAMPLED;
        snprintf(caption, KOKSMA_MAX_SPEC, "%.200s %s %.6f", c->witness, is_bound ? "≥" : "=", value->value);
        panel->scatter.witness = &value->witness;
        panel->caption = caption;
        if (value->witness.kind == KOKSMA_WITNESS_NONE) {
            cli_note(c->args, "%s has no witness for %s: the picture shows only the value", c->witness, source);
        }
    }
    return CLI_YES;
}

static int draw(cli_curves *c)
{
    const int n = c->args->n_operands;
    koksma_points points[CLI_MAX_PANELS] = {{0}};
    koksma_panel panels[CLI_MAX_PANELS] = {{0}};
    koksma_value values[CLI_MAX_PANELS];
    char captions[CLI_MAX_PANELS][KOKSMA_MAX_SPEC], titles[CLI_MAX_PANELS][CLI_CHART_LABEL];
    int code = CLI_YES;
    for (int i = 0; i < n && !code; i++) {
        code = add_points(c, c->args->operands[i], &points[i], &panels[i], &values[i], captions[i], titles[i]);
    }
    if (!code) {
        code = cli_draw_panels(c, NULL, panels, (size_t)n);
    }
    for (int i = 0; i < n; i++) {
        koksma_points_fini(&points[i]);
    }
    return code;
}

const cli_curve cli_curve_points = {
    .name = "points",
    .meaning =
        "the points; on request with cells, the region where a measure has its supremum, or the local discrepancy",
    .cite = "-",
    .plot = {.options = "columns rows grid rooks witness warp local-discrepancy", .draw = draw},
};
