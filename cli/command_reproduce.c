/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma reproduce`: runs the plans that reproduce papers, writes the report, and prints a table beside the
 * published numbers. The plans run as in `koksma study run`. If both papers are given, the plan open-questions is
 * added. Under mpirun only rank 0 has a folder and prints.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <koksma/study.h>

#include "cli.h"
#include "studying.h"

enum { MAX_PLANS = 16 };

/* Prints table `id` of the plan: our numbers and the published numbers. */
static koksma_status put_table(koksma_study *study, const char *id)
{
    koksma_study_row row;
    bool found = true;
    for (size_t i = 0; found; i++) {
        const koksma_status status = koksma_study_table_row(study, id, i, &row, &found);
        if (status || !found) {
            return status;
        }
        cli_row("table %s pattern %s n %lld published %g mean %g low %g high %g converged %g "
                "published_sd %g sd %g published_max %g max %g trials %llu verdict %s\n",
                id, row.pattern, row.n, row.published[0], row.mean, row.low, row.high, row.converged,
                row.published[1], row.sd, row.published[2], row.max, (unsigned long long)row.trials,
                koksma_study_verdict_name(row.verdict));
    }
    return KOKSMA_OK;
}

/* Checks that --table names a table of the plans, which are opened without a folder: a wrong command line makes none.
   What else is wrong with the plans is reported when they are opened to run. Returns the exit code. */
static int check_table(const cli_args *args, const koksma_study_options *options)
{
    koksma_study_options without = *options;
    const char *table = cli_text(args, "table", "none");
    koksma_study *study = NULL;
    koksma_study_row row;
    bool found;
    int code = CLI_YES;
    without.folder = NULL;
    if (strcmp(table, "none") != 0 && strcmp(table, "all") != 0 && !koksma_study_open(&without, &study) &&
        koksma_study_table_row(study, table, SIZE_MAX, &row, &found)) {
        code = cli_error(args, "%s", koksma_error_text());
    }
    koksma_study_close(study);
    return code;
}

/* Prints the tables that --table wants. */
static koksma_status put_tables(const cli_args *args, koksma_study *study)
{
    const char *table = cli_text(args, "table", koksma_study_table_at(study, 0));
    koksma_status status = KOKSMA_OK;
    if (!table || !strcmp(table, "none")) {
        return KOKSMA_OK;
    }
    if (strcmp(table, "all") != 0) {
        return put_table(study, table);
    }
    for (size_t i = 0; !status && koksma_study_table_at(study, i); i++) {
        status = put_table(study, koksma_study_table_at(study, i));
    }
    return status;
}

/* Collects the plans of the operands. If both papers are given, it also adds the plan open-questions, which --papers-only
   leaves out. Returns the number of plans, or 0 after an error. */
static size_t choose_plans(const cli_args *args, const char *plans[MAX_PLANS])
{
    bool shirley = false, mitchell = false, open = false;
    size_t n = 0;
    for (int i = 0; i < args->n_operands; i++) {
        plans[n++] = args->operands[i];
        shirley |= !strcmp(args->operands[i], "shirley1991");
        mitchell |= !strcmp(args->operands[i], "mitchell1992");
        open |= !strcmp(args->operands[i], "open-questions");
    }
    const bool both = shirley && mitchell && !open, papers_only = cli_flag(args, "papers-only");
    if (papers_only && !both) {
        cli_error(args, "--papers-only has an effect only with both papers, shirley1991 mitchell1992, and "
                        "without open-questions");
        return 0;
    }
    if (both && !papers_only) {
        plans[n++] = "open-questions";
    }
    return n;
}

static int run(const cli_args *args)
{
    cli_work work;
    uint64_t trials;
    const char *folder = cli_text(args, "output", NULL);
    if (args->n_operands < 1 || args->n_operands >= MAX_PLANS || !folder) {
        return cli_error(args, "it takes a paper and a folder, as in shirley1991 -o DIR");
    }
    const char *plans[MAX_PLANS];
    const size_t n_plans = choose_plans(args, plans);
    if (!n_plans || !cli_whole(args, "trials", 0, 1, 100000000, &trials) ||
        !cli_work_begin(args, "reproducing", &work)) {
        return CLI_USAGE;
    }
    folder = koksma_study_mpi_rank() > 0 ? NULL : folder; /* under MPI only rank 0 keeps the results */
    const koksma_study_options options = {.plans = plans,
                                          .n_plans = n_plans,
                                          .folder = folder,
                                          .trials = (long long)trials,
                                          .quick = cli_flag(args, "quick")};
    if (check_table(args, &options)) {
        return CLI_USAGE;
    }
    const int code = cli_study_run(args, &options, &work, put_tables);
    return cli_rows_close(code);
}

static const cli_option option_table[] = {
    {'o', "output", "DIR",
     "folder for results.sqlite, report.html and report.json; an interrupted run continues there"},
    {0, "trials", "T", "number of trials of every cell, instead of the numbers in the plan"},
    {0, "quick", NULL, "use the 'quick' number of trials of each block that has one"},
    {0, "papers-only", NULL, "leave out the plan open-questions, which is added if both papers are given"},
    {0, "table", "ID|all|none",
     "table to print at the end (default: the first one); if several plans have a table with this ID, that of the "
     "first plan"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_reproduce = {
    .name = "reproduce",
    .summary = "reproduce the tables and figures of papers",
    .synopsis = "PAPER... -o DIR [--quick] [--papers-only] [--trials T] [--table ID] [--json]",
    .details =
        "PAPER is shirley1991 or mitchell1992, or your own plan (./my.json; studies/README.md lists the fields). "
        "If both papers are given, the plan open-questions is added; it answers questions that the papers leave "
        "open. Results go to DIR/results.sqlite as they are computed. An interrupted run continues when it is "
        "started again, and ends with the same report. The verdict compares our mean with the published one: "
        "agrees, fitted (within 25 % in a scene that was fitted to the published numbers), explained (differs for "
        "a known reason), unexplained, untested (a note says why the printed number is no test), new (the paper "
        "has no number) or waiting (too few trials).\n",
    .examples = "koksma reproduce shirley1991 -o thesis --quick\n"
                "koksma reproduce shirley1991 mitchell1992 -o both\n",
    .options = option_table,
    .run = run,
};
