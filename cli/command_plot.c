/* SPDX-License-Identifier: Apache-2.0 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/plot.h>

#include "cli.h"
#include "source.h"

typedef struct plot_job {
    const cli_arguments *arguments;
    const char *source, *output, *witness;
    uint64_t seed, columns, rows, size;
    koksma_plot_format format;
    cli_work work;
} plot_job;

static koksma_status draw(plot_job *j, const koksma_points *points)
{
    koksma_scatter_options options = {.size = (double)j->size, .columns = j->columns, .rows = j->rows};
    koksma_value value;
    koksma_spec measure;
    unsigned char *bytes;
    size_t size;
    char caption[KOKSMA_MAX_SPEC];
    koksma_status status = KOKSMA_OK;
    if (j->witness) {
        status = koksma_measure_spec(j->witness, &measure);
        if (!status) {
            status = koksma_evaluate(&measure, points, &j->work.run, &value);
        }
        if (status) {
            return status;
        }
        snprintf(caption, sizeof caption, "%.200s = %.6f", j->witness, value.value);
        options.witness = &value.witness;
        options.caption = caption;
    }
    status = koksma_plot_scatter(points, &options, j->format, &bytes, &size);
    if (!status) {
        status = koksma_plot_write(j->output, bytes, size);
        free(bytes);
    }
    return status;
}

static int run(const cli_arguments *arguments)
{
    plot_job j = {.arguments = arguments, .output = cli_text(arguments, "output", NULL)};
    if (arguments->n_operands != 1 || !j.output) {
        return cli_usage_error(arguments, "it takes points and a picture, as in points.txt -o points.svg");
    }
    j.source = arguments->operands[0];
    j.witness = cli_text(arguments, "witness", NULL);
    if (!cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &j.seed) ||
        !cli_whole(arguments, "columns", 0, 1, 4096, &j.columns) ||
        !cli_whole(arguments, "rows", 0, 1, 4096, &j.rows) || !cli_whole(arguments, "size", 320, 16, 8192, &j.size) ||
        !cli_work_begin(arguments, "plotting", &j.work)) {
        return CLI_USAGE;
    }
    koksma_points points = {0};
    koksma_status status = koksma_plot_format_of(j.output, &j.format);
    if (status) {
        return cli_fail(arguments, status);
    }
    int code = cli_source_points(arguments, j.source, j.seed, &j.work.run, &points);
    if (!code) {
        status = draw(&j, &points);
        cli_work_end(&j.work);
        code = status ? cli_fail(arguments, status) : CLI_YES;
    }
    koksma_points_fini(&points);
    return code;
}

static const cli_option options[] = {
    {'o', "output", "OUT", "picture to write: .svg, .pdf or .png"},
    {0, "columns", "C", "draw C columns of cells"},
    {0, "rows", "R", "draw R rows of cells"},
    {0, "witness", "MEASURE", "draw the region where this measure's supremum is reached, with its value below"},
    {0, "size", "S", "side of the picture in points or pixels (default: 320)"},
    {'s', "seed", "S", "seed for a pattern: source (default: 0)"},
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_plot = {
    .name = "plot",
    .summary = "draw points, and where a measure finds them worst",
    .synopsis = "FILE|-|pattern:SPEC@N -o OUT.svg|.pdf|.png [--columns C --rows R] [--witness MEASURE]",
    .options = options,
    .run = run,
};
