/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma atlas`: builds pages that answer questions by commands, and makes and checks entries, the files by which the
   table of records grows. */
#include <koksma/atlas.h>

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/plot.h>

#include "cli.h"
#include "source.h"

/* ---- build ------------------------------------------------------------------------------------------------------ */

static int build(const cli_arguments *arguments)
{
    cli_work work;
    koksma_atlas_summary summary;
    char program[PATH_MAX] = "";
    const koksma_atlas_options options = {.questions = arguments->n_operands > 1 ? arguments->operands[1] : NULL,
                                          .folder = cli_text(arguments, "output", NULL),
                                          .program = program,
                                          .quick = cli_flag(arguments, "quick")};
    if (!options.folder) {
        return cli_usage_error(arguments, "--output is missing: it takes a folder");
    }
    if (arguments->n_operands > 2) {
        return cli_usage_error(arguments, "build takes at most one file of questions");
    }
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length < 0) {
        return cli_usage_error(arguments, "this system has no /proc/self/exe, by which the program runs itself");
    }
    program[length] = '\0';
    if (!cli_work_begin(arguments, "building", &work)) {
        return CLI_USAGE;
    }
    const koksma_status status = koksma_atlas_build(&options, &work.run, &summary);
    cli_work_end();
    if (status) {
        return cli_fail(arguments, status);
    }
    if (koksma_study_mpi_rank()) {
        return CLI_YES;
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    cli_row_text(rows, "folder", options.folder);
    cli_row_whole(rows, "pages", summary.pages);
    cli_row_whole(rows, "computed", summary.computed);
    cli_row_whole(rows, "kept", summary.kept);
    cli_row_whole(rows, "without_datasheet", summary.failed);
    cli_row_end(rows);
    return cli_rows_close(rows, CLI_YES);
}

/* ---- submit and check ------------------------------------------------------------------------------------------- */

static int submit(const cli_arguments *arguments)
{
    cli_work work;
    koksma_spec measure;
    koksma_points points = {0};
    char *json = NULL;
    const char *author = cli_text(arguments, "author", ""), *output = cli_text(arguments, "output", "-");
    if (arguments->n_operands != 2 || !*author) {
        return cli_usage_error(arguments, *author ? "submit takes one set of points, a file or SPEC@N"
                                                  : "--author is missing: whom the table of records names");
    }
    const char *slash = strrchr(output, '/'), *ending = strrchr(slash ? slash : output, '.');
    if (ending && strcmp(ending, ".json") != 0) {
        return cli_usage_error(arguments, "%s: an entry's name ends in .json", output);
    }
    if (koksma_measure_spec(cli_text(arguments, "measure", "star"), &measure)) {
        return cli_fail(arguments, KOKSMA_ARGUMENT);
    }
    if (!cli_work_begin(arguments, "measuring", &work)) {
        return CLI_USAGE;
    }
    int code = cli_try_output(arguments, output);
    code = code ? code : cli_source_points(arguments, arguments->operands[1], 0, &work.run, &points);
    if (!code) {
        koksma_status status = koksma_entry_text(&points, &measure, author, &work.run, &json);
        cli_work_end();
        status = status ? status : koksma_plot_write(output, (const unsigned char *)json, strlen(json));
        code = status ? cli_fail(arguments, status) : CLI_YES;
    }
    free(json);
    koksma_points_fini(&points);
    return code;
}

static int check(const cli_arguments *arguments)
{
    cli_work work;
    const size_t n = (size_t)arguments->n_operands - 1;
    if (!n) {
        return cli_usage_error(arguments, "check takes entries, files that 'koksma atlas submit' wrote");
    }
    koksma_entry_result *results = calloc(n, sizeof *results);
    if (!results) {
        return cli_no_memory();
    }
    if (!cli_work_begin(arguments, "checking", &work)) {
        free(results);
        return CLI_USAGE;
    }
    const char **paths = (const char **)arguments->operands + 1;
    const koksma_status status = koksma_entries_check(paths, n, &work.run, results);
    cli_work_end();
    int code = CLI_YES;
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    for (size_t i = 0; i < n && results[i].verdict; i++) {
        const koksma_entry_result *r = &results[i];
        const int one = r->status                         ? koksma_status_exit_code(r->status)
                        : !strcmp(r->verdict, "accepted") ? CLI_YES
                                                          : CLI_NO;
        code = one > code ? one : code;
        r->status ? cli_say(arguments->command->name, "%s", r->reason) : (void)0;
        cli_row_text(rows, "entry", paths[i]);
        cli_row_text(rows, "verdict", r->verdict);
        cli_row_text(rows, "measure", *r->measure ? r->measure : "-");
        cli_row_whole(rows, "n", r->n);
        cli_row_whole(rows, "dim", (uint64_t)r->dim);
        cli_row_number(rows, "claimed", r->claimed);
        cli_row_number(rows, "value", r->value);
        cli_row_number(rows, "record", r->record);
        cli_row_text(rows, "reason", *r->reason ? r->reason : "-");
        cli_row_end(rows);
    }
    free(results);
    return cli_rows_close(rows, status ? cli_fail(arguments, status) : code);
}

static int run(const cli_arguments *arguments)
{
    static const struct {
        const char *name, *refused;
        int (*run)(const cli_arguments *arguments);
    } verbs[] = {{"build", "measure author", build},
                 {"submit", "quick json", submit},
                 {"check", "output quick measure author", check}};
    for (size_t i = 0; arguments->n_operands && i < sizeof verbs / sizeof *verbs; i++) {
        if (!strcmp(arguments->operands[0], verbs[i].name)) {
            return cli_refuse(arguments, verbs[i].refused, "is not for %s", verbs[i].name) ? verbs[i].run(arguments)
                                                                                           : CLI_USAGE;
        }
    }
    char meant[96] = "";
    return cli_usage_error(
        arguments, "%sit takes build, submit or check",
        arguments->n_operands ? cli_meant_of(arguments->operands[0], "build, submit or check", meant) : "");
}

static const cli_option options[] = {
    {'o', "output", "PATH", "build: the folder; submit: the entry (default: -, standard output)"},
    {0, "quick", NULL, "build: fewer trials, sets and images; takes some minutes"},
    {'m', "measure", "MEASURE", "submit: the measure for which the set is a record (default: star)"},
    {0, "author", "NAME", "submit: whom to credit"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_atlas = {
    .name = "atlas",
    .summary = "answer questions on static pages; submit and check records",
    .synopsis = "build [FILE.json] -o DIR [--quick] [--json]\n"
                "submit FILE|-|SPEC@N[@DIM] --author NAME [-m MEASURE] [-o ENTRY.json]\n"
                "check ENTRY.json... [--json]",
    .details =
        "build: writes DIR/index.html and a page for each of twenty questions that people ask about sampling, for"
        " each pattern, and for the records. Pages need no server, network or script. Each number stands below "
        "the command that computed it, with its interval if it is random; DIR/rows has all digits. A result is "
        "kept for the next build while the command, the version and the revisions of the patterns and measures "
        "that it names are the same, so that a new pattern computes only its own datasheet. FILE.json has other "
        "questions (studies/README.md). Under mpirun the ranks share the commands.\n"
        "submit: measures a set exactly and writes an entry: the points, the value, the author and a digest.\n"
        "check: measures entries again, in their order. verdict: accepted, or why not. altered: the points, "
        "measure or author are not those of the digest. false: the points have another value than the entry "
        "claims. duplicate: the set is that of the pattern record or of an entry before it, up to the order of "
        "the points, shifts on the torus, and in up to four dimensions reflections and permutations of the axes. "
        "worse: not better than the record or an entry before it by more than 1e-11; where no record is known, than "
        "the "
        "best listed pattern, up to 512 coordinates. invalid: the file is missing or no entry. Exit codes, the worst "
        "of "
        "all entries: 0 accepted; 1 refused; 2 for a wrong command line; 3 invalid.\n",
    .examples = "koksma atlas build -o atlas --quick\n"
                "koksma atlas submit points.txt --author 'A. Name' -o entry.json\n"
                "koksma atlas check entry.json\n",
    .options = options,
    .run = run,
};
