/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma study` has one function for each verb, and one table, `verbs`, of the options that each verb takes. The
 * verb `new` writes an example of a plan. `run` measures and renders what plans list, writes the results into a
 * folder, and continues an earlier run in that folder.
 * `export` and `report` write the results of a run again, `audit` computes results again and compares them.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <koksma/plot.h>
#include <koksma/study.h>

#include "cli.h"
#include "rendering.h"
#include "studying.h"

/* The plan that `koksma study new` writes. Every object of a plan may have a `comment`, which is ignored. */
static const char example[] =
    "{\n"
    "  \"comment\": \"A plan of koksma study; every object may have a 'comment'. studies/README.md has all "
    "fields.\",\n"
    "  \"name\": \"%s\",\n"
    "  \"title\": \"Which pattern for 64 samples a pixel?\",\n"
    "  \"metric\": \"mae\",\n"
    "  \"discrepancies\": [\n"
    "    {\n"
    "      \"comment\": \"patterns x n x measures, each over `trials` point sets; `quick` trials with --quick\",\n"
    "      \"patterns\": [\"random\", \"jittered\", \"n-rooks\", \"sobol:scramble=owen\"],\n"
    "      \"measures\": [\"star\", \"l2-star\", \"l2-edge\"],\n"
    "      \"n\": [4, 16, 64],\n"
    "      \"trials\": 100,\n"
    "      \"quick\": 20\n"
    "    }\n"
    "  ],\n"
    "  \"images\": [\n"
    "    {\n"
    "      \"comment\": \"scenes x patterns x spp x all combinations of options, each over `trials` renders\",\n"
    "      \"scenes\": [\"checker\", \"ball\"],\n"
    "      \"patterns\": [\"random\", \"jittered\", \"n-rooks\", \"sobol:scramble=owen\"],\n"
    "      \"spp\": [4, 16, 64],\n"
    "      \"options\": {\"pairing\": [\"shuffled\"]},\n"
    "      \"size\": [64, 48],\n"
    "      \"trials\": 20,\n"
    "      \"quick\": 6,\n"
    "      \"references\": [\n"
    "        {\"comment\": \"the mean of `replicates` renders\",\n"
    "         \"name\": \"converged\", \"pattern\": \"jittered\", \"spp\": 1024, \"replicates\": 8}\n"
    "      ]\n"
    "    }\n"
    "  ]\n"
    "}\n";

static const char *ending_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    return dot ? dot + 1 : "";
}

static int new_plan(const cli_arguments *arguments)
{
    const char *path = cli_text(arguments, "output", arguments->n_operands > 1 ? arguments->operands[1] : "-");
    if (arguments->n_operands > 2 || (arguments->n_operands > 1 && cli_text(arguments, "output", NULL))) {
        return cli_usage_error(arguments, "new takes one file, as in new plan.json or new -o plan.json");
    }
    if (*ending_of(path) && strcmp(ending_of(path), "json") != 0) {
        return cli_usage_error(arguments, "%s: a plan's name ends in .json", path);
    }
    struct stat info;
    if (!stat(path, &info) && S_ISREG(info.st_mode)) { /* never overwrite a file that a user may have edited */
        return cli_usage_error(arguments, "%s: it exists already, and 'new' overwrites no file", path);
    }
    const char *base = strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
    int length = (int)strcspn(base, ".");
    char name[64], text[sizeof example + sizeof name];
    length = strspn(base, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_") < (size_t)length
                 ? 0
                 : length;
    snprintf(name, sizeof name, "%.*s", length, base);
    const bool named = name[0] && strcmp(name, "-") != 0;
    const int size = snprintf(text, sizeof text, example, named ? name : "my-study");
    const koksma_status status = koksma_plot_write(path, (const unsigned char *)text, (size_t)size);
    return status ? cli_fail(arguments, status) : CLI_YES;
}

/* ---- run ----------------------------------------------------------------------------------------------- */

static double percent(double part, double of)
{
    return of > 0 ? 100 * part / of : 0;
}

static const double RUN_SHARE = 0.95; /* fraction of the progress bar for the run; the rest is for the report */

static void say_left_out(const char *line, size_t length)
{
    fprintf(stderr, "left out: %.*s\n", (int)length, line);
}

int cli_study_run(const cli_arguments *arguments, const koksma_study_options *options, cli_work *work,
                  cli_of_study *then, void *context)
{
    koksma_study *study;
    koksma_study_summary summary = {0};
    koksma_status status = koksma_study_open(options, &study);
    if (status) {
        return cli_fail(arguments, status);
    }
    work->share = options->folder ? RUN_SHARE : 1;
    status = koksma_study_run(study, &work->run, &summary);
    const int refused = status == KOKSMA_IMPOSSIBLE ? cli_fail(arguments, status) : 0;
    status = refused ? KOKSMA_OK : status;
    if (!status && options->folder) {
        work->run.time_limit_s = 0;
        cli_work_rest(work, RUN_SHARE);
        status = koksma_study_report(study, &work->run);
    }
    status = status || !then || !options->folder ? status : then(arguments, study, context);
    const char *line;
    const bool speaks = !cli_flag(arguments, "quiet") && koksma_study_mpi_rank() == 0;
    cli_work_end();
    for (size_t i = 0; speaks && (line = koksma_study_left_out_at(study, i));
         i++) { /* combinations without results */
        say_left_out(line, strlen(line));
    }
    const koksma_status closed = koksma_study_close(study);
    status = status ? status : closed;
    if (status == KOKSMA_INTERRUPTED) {
        if (options->folder) {
            cli_say(arguments->command->name,
                    "interrupted; finished work is kept in %s, and the same command continues it", options->folder);
        }
        return koksma_status_exit_code(KOKSMA_INTERRUPTED);
    }
    if (status) {
        return cli_fail(arguments, status);
    }
    cli_work_end();
    if (options->folder && !cli_flag(arguments, "quiet")) {
        fprintf(
            stderr,
            "%zu jobs, %zu of them done before, %zu now in %.1f s (workers idle %.1f %% of the time, in the database "
            "%.1f %% of the processor time)%s; report: %s/report.html\n",
            summary.jobs, summary.done_before, summary.done_now, summary.seconds,
            percent(summary.idle_seconds, summary.workers * summary.seconds),
            percent(summary.store_seconds, summary.processor_seconds),
            summary.complete || refused ? "" : "; the time limit ended the run; the same command continues it",
            cli_one_line(options->folder));
    }
    if (refused) {
        return refused;
    }
    return !options->folder || summary.complete ? CLI_YES : CLI_NO;
}

static bool study_options(const cli_arguments *arguments, koksma_study_options *options, cli_work *work)
{
    uint64_t trials;
    if (!cli_whole(arguments, "trials", 0, 1, 100000000, &trials) || !cli_work_begin(arguments, "studying", work) ||
        !cli_real(arguments, "time-limit", 0, 0, 1e9, &work->run.time_limit_s)) {
        return false;
    }
    *options = (koksma_study_options){.plans = (const char *const *)arguments->operands + 1,
                                      .n_plans = (size_t)arguments->n_operands - 1,
                                      .folder = cli_text(arguments, "output", NULL),
                                      .trials = (long long)trials,
                                      .quick = cli_flag(arguments, "quick")};
    return true;
}

static int run_plans(const cli_arguments *arguments)
{
    cli_work work;
    koksma_study_options options;
    if (arguments->n_operands < 2 || !cli_text(arguments, "output", NULL)) {
        return cli_usage_error(arguments, "run takes a plan and a folder, as in run plan.json -o DIR");
    }
    if (!study_options(arguments, &options, &work)) {
        return CLI_USAGE;
    }
    if (koksma_study_mpi_rank() > 0) {
        options.folder = NULL;
    }
    const int code = cli_study_run(arguments, &options, &work, NULL, NULL);
    cli_work_end();
    return code;
}

/* ---- export and report --------------------------------------------------------------------------------- */

static int export_rows(const cli_arguments *arguments)
{
    static const char *const formats[] = {"csv", "json", "sha256", NULL};
    const char *path = cli_text(arguments, "output", "-");
    const bool given = cli_text(arguments, "format", NULL) != NULL;
    const char *name = given ? "" : ending_of(path);
    int format = 0;
    if (arguments->n_operands != 2) {
        return cli_usage_error(arguments, "export takes a study's folder, as in export DIR --format csv");
    }
    while (*name && formats[format] && strcmp(formats[format], name) != 0) {
        format++;
    }
    if (!formats[format]) {
        return cli_usage_error(arguments, "%s: the name of an export must end in .csv, .json or .sha256", path);
    }
    if (!cli_choice(arguments, "format", &format)) {
        return CLI_USAGE;
    }
    koksma_status status = koksma_study_export(arguments->operands[1], (koksma_export_format)format, path);
    char *left_out = NULL;
    if (!status && !cli_flag(arguments, "quiet")) { /* report what the export lacks */
        status = koksma_study_left_out(arguments->operands[1], &left_out);
    }
    for (const char *line = left_out; line && *line; line += strcspn(line, "\n") + 1) {
        say_left_out(line, strcspn(line, "\n"));
    }
    free(left_out);
    return status ? cli_fail(arguments, status) : CLI_YES;
}

static int report(const cli_arguments *arguments)
{
    cli_work work;
    koksma_study *study = NULL;
    if (arguments->n_operands != 2) {
        return cli_usage_error(arguments, "report takes a study's folder, as in report DIR");
    }
    if (!cli_work_begin(arguments, "reporting", &work)) {
        return CLI_USAGE;
    }
    if (koksma_study_mpi_rank() > 0) {
        return CLI_YES;
    }
    const koksma_study_options options = {.folder = arguments->operands[1]};
    koksma_status status = koksma_study_open(&options, &study);
    status = status ? status : koksma_study_report(study, &work.run);
    size_t jobs = 0, undone = 0;
    status = status ? status : koksma_study_undone(study, &jobs, &undone);
    cli_work_end();
    const koksma_status closed = koksma_study_close(study);
    status = status ? status : closed;
    if (!status && undone && !cli_flag(arguments, "quiet")) {
        cli_say(
            "study",
            "%zu of %zu jobs have no rows: a run ended before them, or made rows of files, scenes or code that have "
            "changed since; 'koksma study run' does them",
            undone, jobs);
    }
    return status ? cli_fail(arguments, status) : CLI_YES;
}

/* ---- The command --------------------------------------------------------------------------------------- */

/* Returns false, after an error, if an option is given that the verb does not accept. own: the names of the options
   of this verb, separated by blanks. */
static bool takes_options(const cli_arguments *arguments, const char *own)
{
    static const char common[] = " threads progress quiet allow-exec exec-seconds unknown help ";
    for (int i = 0; arguments->command->options[i].name; i++) {
        char name[32];
        snprintf(name, sizeof name, " %s ", arguments->command->options[i].name);
        if (arguments->values[i] && !strstr(own, name) && !strstr(common, name)) {
            cli_usage_error(arguments, "%s takes no --%s", arguments->operands[0],
                            arguments->command->options[i].name);
            return false;
        }
    }
    return true;
}

static int run(const cli_arguments *arguments)
{
    static const struct {
        const char *name;
        int (*run)(const cli_arguments *arguments);
        const char *options; /* names of the options that the verb accepts in addition to the common ones */
    } verbs[] = {{"run", run_plans, " output trials quick time-limit "},
                 {"new", new_plan, " output "},
                 {"export", export_rows, " output format "},
                 {"report", report, " "},
                 {"audit", cli_study_audit, " rows seed json digits long "}};
    for (size_t i = 0; arguments->n_operands > 0 && i < sizeof verbs / sizeof *verbs; i++) {
        if (!strcmp(verbs[i].name, arguments->operands[0])) {
            return takes_options(arguments, verbs[i].options) ? verbs[i].run(arguments) : CLI_USAGE;
        }
    }
    static const char names[] = "run, new, export, report or audit";
    char meant[96] = "";
    return cli_usage_error(arguments, "%sit takes %s",
                           arguments->n_operands ? cli_meant_of(arguments->operands[0], names, meant) : "", names);
}

static const cli_option options[] = {
    CLI_UNKNOWN_OPTION,
    {'o', "output", "PATH", "run: the folder; new, export: the file (default: -, standard output)"},
    {0, "trials", "T", "run: number of trials, instead of the numbers in the plan"},
    {0, "quick", NULL, "run: use the 'quick' number of trials of each block"},
    {0, "time-limit", "S", "run: stop after S seconds, with exit code 1 if jobs remain (default: 0, no limit)"},
    {0, "rows", "N|all", "audit: rows to draw at random (default: 200)"},
    {'s', "seed", "SEED", "audit: seed of the random draw (default: a random one, which is printed)"},
    {0, "format", "csv|json|sha256",
     "export: the format; json: one object per line (default: by the file's ending, else csv)"},
    CLI_JSON_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_study = {
    .name = "study",
    .summary = "evaluate patterns with measures or scenes, as a plan says",
    .synopsis = "run PLAN... -o DIR [--trials T] [--quick] [--time-limit S]\n"
                "new [FILE]\n"
                "export DIR [--format csv|json|sha256] [-o FILE]\n"
                "report DIR\n"
                "audit DIR [--rows N|all] [--seed SEED] [--json]",
    .details =
        "PLAN is the name of a plan in the library, a JSON file (./plan.json), or the plan itself, which begins "
        "with '{\"'. Paths in a plan are relative to the plan's file, or without a file to the current folder. If "
        "they are relative, 'report' and 'audit' must be started where 'run' was.\n"
        "run: runs all jobs; each result is written to DIR/results.sqlite when it is finished. An interrupted run "
        "continues when it is started again. If a pattern fails for some trials, the summary, the report and "
        "'export' list them with the reason, and all other trials are done. The exit code is then 2, or 0 if the "
        "block of the plan has \"skip\": true.\n"
        "new: writes an example plan; it overwrites no file.\n"
        "export: writes all results sorted by key: the same bytes for any number of threads and interruptions. "
        "'json' is JSON Lines: one object per line, with a key for each column of the CSV. 'sha256' is the hash of "
        "the CSV, which report.json has, too. 'export' and 'report' change no byte of the results, fail while a "
        "run uses DIR.\n"
        "report: writes DIR/report.html, and says how many jobs have no rows.\n"
        "audit: computes rows of DIR by the stored plan and, whichever rows are drawn, all reference images again, "
        "and compares them bit for bit. It prints each difference, and an upper bound of the fraction of wrong rows "
        "(95 % confidence), which holds because nobody knows before which rows are drawn; --seed repeats a draw. "
        "The exit code is 1 if anything differs. Rows of other plans, files and revisions are counted only, and so "
        "are rows that are missing before the last trial of their series, because a run that is killed leaves such "
        "gaps; missing rows at the end can't be seen. audit changes nothing, and also works under mpirun.\n",
    .examples = "koksma study new plan.json\n"
                "koksma study run ./plan.json -o results --quick\n"
                "koksma study export results --format csv -o rows.csv\n"
                "koksma study report results\n"
                "koksma study audit results --rows all\n",
    .options = options,
    .run = run,
};
