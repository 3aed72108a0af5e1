/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma curve`: prints the rows of a curve of the table curves.def, for each source. */
#include "cli.h"
#include "curves.h"
#include "source.h"

/* A sink that prints the rows of a curve. */
typedef struct row_sink {
    cli_sink sink;
    const cli_curve *curve;
    const char *source;
} row_sink;

static void put_row(cli_sink *sink, const double *values)
{
    const row_sink *s = (row_sink *)sink;
    cli_row("source %s curve %s", s->source, s->curve->name);
    for (int k = 0; s->curve->columns[k]; k++) {
        cli_row_number(s->curve->columns[k], values[k]);
    }
    cli_row_end();
}

static int run(const cli_args *args)
{
    cli_curves c;
    char names[256];
    const cli_curve *curve = args->n_operands > 1 ? cli_curve_find(CLI_PRINTED, args->operands[0]) : NULL;
    if (!curve) {
        cli_curve_names(CLI_PRINTED, NULL, ", ", ", ", names, sizeof names);
        char meant[96] = "";
        return cli_error(args, "%sit takes one of %s, and points",
                         args->n_operands > 1 ? cli_meant_of(args->operands[0], names, meant) : "", names);
    }
    if (!cli_curves_begin(args, curve, CLI_PRINTED, "", &c)) {
        return CLI_USAGE;
    }
    if (c.output && args->n_operands > 2) {
        return cli_error(args, "--output: it takes %s of one source", curve->name);
    }
    if (!cli_sources_check(args, 1, c.trials, 0)) {
        return CLI_USAGE;
    }
    row_sink sink = {.sink = {.row = put_row}, .curve = curve};
    int code = cli_try_output(args, c.output);
    for (int i = 1; i < args->n_operands && !code; i++) {
        sink.source = args->operands[i];
        code = curve->compute(&c, sink.source, &sink.sink);
    }
    return cli_rows_close(code);
}

static const cli_option options[] = {
    CLI_SOURCE_OPTIONS,
    CLI_CURVE_OPTIONS("curve", "2 sqrt(n); quality: 7 sqrt(n)",
                      "rings, pairs and screen have standard errors, and quality is that of the mean spectrum"),
    {'f', "filter", "FILTER", "{curve:filter}: as of `koksma mask` (default: gaussian:sigma=1.5)"},
    {'o', "output", "FILE.npy|.csv|.txt|{images}",
     "{curve:output}: write all values to this file, as numbers or as a grey image"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_curve = {
    .name = "curve",
    .summary = "print measures whose values are functions, such as power spectra",
    .synopsis = "{curve} FILE|-|SPEC@N... [-p PATTERN,..|all -n N,..] [--trials T] [--json]",
    .details = "{curve-meanings}`koksma plot --curve` draws them.",
    .examples = "koksma curve rings pattern:poisson-disk-maximal@1024\n"
                "koksma curve screen ranking-keys@4@2 --trials 8\n"
                "koksma curve pairs points.txt\n",
    .options = options,
    .run = run,
};
