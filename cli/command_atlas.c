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

static int build(const cli_args *args)
{
    cli_work work;
    koksma_atlas_summary summary;
    char program[PATH_MAX] = "";
    const koksma_atlas_options options = {.questions = args->n_operands > 1 ? args->operands[1] : NULL,
                                          .folder = cli_text(args, "output", NULL),
                                          .program = program,
                                          .quick = cli_flag(args, "quick")};
    if (!options.folder) {
        return cli_error(args, "--output is missing: it takes a folder");
    }
    if (args->n_operands > 2) {
        return cli_error(args, "build takes at most one file of questions");
    }
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length < 0) {
        return cli_error(args, "this system has no /proc/self/exe, by which the program runs itself");
    }
    program[length] = '\0';
    if (!cli_work_begin(args, "building", &work)) {
        return CLI_USAGE;
    }
    const koksma_status status = koksma_atlas_build(&options, &work.run, &summary);
    cli_work_end();
    if (status) {
        return cli_fail(args, status);
    }
    if (koksma_study_mpi_rank()) {
        return CLI_YES;
    }
    cli_row("folder %s pages %zu computed %zu kept %zu without_datasheet %zu\n", options.folder, summary.pages,
            summary.computed, summary.kept, summary.failed);
    return cli_rows_close(CLI_YES);
}

/* ---- submit and check ------------------------------------------------------------------------------------------- */

static int submit(const cli_args *args)
{
    cli_work work;
    koksma_spec measure;
    koksma_points points = {0};
    char *json = NULL;
    const char *author = cli_text(args, "author", ""), *output = cli_text(args, "output", "-");
    if (args->n_operands != 2 || !*author) {
        return cli_error(args, *author ? "submit takes one set of points, a file or SPEC@N"
                                       : "--author is missing: whom the table of records names");
    }
    const char *slash = strrchr(output, '/'), *ending = strrchr(slash ? slash : output, '.');
    if (ending && strcmp(ending, ".json") != 0) {
        return cli_error(args, "%s: an entry's name ends in .json", output);
    }
    if (koksma_measure_spec(cli_text(args, "measure", "star"), &measure)) {
        return cli_fail(args, KOKSMA_ARGUMENT);
    }
    if (!cli_work_begin(args, "measuring", &work)) {
        return CLI_USAGE;
    }
    int code = cli_try_output(args, output);
    code = code ? code : cli_source_points(args, args->operands[1], 0, &work.run, &points);
    if (!code) {
        koksma_status status = koksma_entry_text(&points, &measure, author, &work.run, &json);
        cli_work_end();
        status = status ? status : koksma_plot_write(output, (const unsigned char *)json, strlen(json));
        code = status ? cli_fail(args, status) : CLI_YES;
    }
    free(json);
    koksma_points_fini(&points);
    return code;
}

static int check(const cli_args *args)
{
    cli_work work;
    const size_t n = (size_t)args->n_operands - 1;
    if (!n) {
        return cli_error(args, "check takes entries, files that 'koksma atlas submit' wrote");
    }
    koksma_entry_result *results = calloc(n, sizeof *results);
    if (!results) {
        return cli_no_memory();
    }
    if (!cli_work_begin(args, "checking", &work)) {
        free(results);
        return CLI_USAGE;
    }
    const char **paths = (const char **)args->operands + 1;
    const koksma_status status = koksma_entries_check(paths, n, &work.run, results);
    cli_work_end();
    int code = CLI_YES;
    for (size_t i = 0; i < n && results[i].verdict; i++) {
        const koksma_entry_result *r = &results[i];
        const int one = r->status                         ? koksma_status_exit_code(r->status)
                        : !strcmp(r->verdict, "accepted") ? CLI_YES
                                                          : CLI_NO;
        code = one > code ? one : code;
        r->status ? cli_say(args->command->name, "%s", r->reason) : (void)0;
        cli_row("entry %s verdict %s measure %s n %zu dim %d claimed %g value %g record %g "
                "reason %s\n",
                paths[i], r->verdict, *r->measure ? r->measure : "-", r->n, r->dim, r->claimed, r->value, r->record,
                *r->reason ? r->reason : "-");
    }
    free(results);
    return cli_rows_close(status ? cli_fail(args, status) : code);
}

static int run(const cli_args *args)
{
    static const struct {
        const char *name, *refused;
        int (*run)(const cli_args *args);
    } verbs[] = {{"build", "measure author", build},
                 {"submit", "quick json", submit},
                 {"check", "output quick measure author", check}};
    for (size_t i = 0; args->n_operands && i < sizeof verbs / sizeof *verbs; i++) {
        if (!strcmp(args->operands[0], verbs[i].name)) {
            return cli_refuse(args, verbs[i].refused, "is not for %s", verbs[i].name) ? verbs[i].run(args)
                                                                                      : CLI_USAGE;
        }
    }
    return cli_takes(args, "", args->n_operands ? args->operands[0] : NULL, "build, submit or check");
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
        "claims. worse: not better than the record or an entry before it by more than 1e-9, as no copy is; where no "
        "record is known, than the best listed pattern, up to 512 coordinates. invalid: the file is missing or no "
        "entry. Exit codes, the worst of all entries: 0 accepted; 1 refused; 2 for a wrong command line; 3 "
        "invalid.\n",
    .examples = "koksma atlas build -o atlas --quick\n"
                "koksma atlas submit points.txt --author 'A. Name' -o entry.json\n"
                "koksma atlas check entry.json\n",
    .options = options,
    .run = run,
};
