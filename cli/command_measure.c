/* SPDX-License-Identifier: Apache-2.0 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "source.h"

enum { MAX_MEASURES = 64 };

typedef struct job {
    const cli_arguments *arguments;
    koksma_spec measures[MAX_MEASURES];
    size_t n_measures;
    bool all; /* -m all: measures that can't serve a set are left out */
    uint64_t seed;
    cli_work work;
    cli_rows *rows;
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

static int measure_source(job *j, const char *source)
{
    koksma_points points = {0};
    koksma_status status = KOKSMA_OK;
    const int code = cli_source_points(j->arguments, source, j->seed, &j->work.run, &points);
    if (code) {
        koksma_points_fini(&points);
        return code;
    }
    for (size_t i = 0; !status && i < j->n_measures; i++) {
        koksma_value value;
        j->work.what = j->measures[i].measure->name;
        status = koksma_evaluate(&j->measures[i], &points, &j->work.run, &value);
        if (!status) {
            put_row(j, source, &points, &j->measures[i], &value);
        } else if (j->all && (status == KOKSMA_DIM || status == KOKSMA_N)) {
            status = KOKSMA_OK;
        }
    }
    koksma_points_fini(&points);
    cli_work_end(&j->work);
    return status ? cli_fail(j->arguments, status) : CLI_YES;
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
    if (!cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &j.seed) ||
        !cli_work_begin(arguments, "measuring", &j.work)) {
        return CLI_USAGE;
    }
    const koksma_status status = choose_measures(&j, cli_text(arguments, "measures", "star,l2-star,extreme"));
    if (status) {
        return cli_fail(arguments, status);
    }
    j.rows = cli_rows_open(cli_flag(arguments, "json"));
    int code = j.rows ? CLI_YES : 4;
    for (int i = 0; !code && i < arguments->n_operands; i++) {
        code = measure_source(&j, arguments->operands[i]);
    }
    const int rows_code = cli_rows_close(j.rows);
    return code ? code : rows_code;
}

static const cli_option options[] = {
    {'m', "measures", "NAMES", "measures, separated by commas, or all (default: star,l2-star,extreme)"},
    {'s', "seed", "S", "seed for pattern: sources (default: 0)"},
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
