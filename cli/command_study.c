/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma study` has one function for each verb, and one table, `verbs`, of the options that each verb takes. The
 * verb `new` writes an example of a plan. `run` measures and renders what plans list, writes the results into a
 * folder, and continues an earlier run in that folder.
 * `export` and `report` write the results of a run again, `audit` computes results again and compares them.
 */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __APPLE__
#include <sys/random.h> /* getentropy, which others have in unistd.h */
#endif
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

static int new_plan(const cli_args *args)
{
    const char *path = cli_text(args, "output", args->n_operands > 1 ? args->operands[1] : "-");
    if (args->n_operands > 2 || (args->n_operands > 1 && cli_text(args, "output", NULL))) {
        return cli_error(args, "new takes one file, as in new plan.json or new -o plan.json");
    }
    if (*ending_of(path) && strcmp(ending_of(path), "json") != 0) {
        return cli_error(args, "%s: a plan's name ends in .json", path);
    }
    struct stat info;
    if (!stat(path, &info) && S_ISREG(info.st_mode)) { /* never overwrite a file that a user may have edited */
        return cli_error(args, "%s: it exists already, and 'new' overwrites no file", path);
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
    return status ? cli_fail(args, status) : CLI_YES;
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

int cli_study_run(const cli_args *args, const koksma_study_options *options, cli_work *work, cli_of_study *then)
{
    koksma_study *study;
    koksma_study_summary summary = {0};
    koksma_status status = koksma_study_open(options, &study);
    if (status) {
        return cli_fail(args, status);
    }
    work->share = options->folder ? RUN_SHARE : 1;
    status = koksma_study_run(study, &work->run, &summary);
    const int refused = status == KOKSMA_IMPOSSIBLE ? cli_fail(args, status) : 0;
    status = refused ? KOKSMA_OK : status;
    if (!status && options->folder) {
        work->run.time_limit_s = 0;
        cli_work_rest(work, RUN_SHARE);
        status = koksma_study_report(study, &work->run);
    }
    status = status || !then || !options->folder ? status : then(args, study);
    const char *line;
    const bool speaks = !cli_flag(args, "quiet") && koksma_study_mpi_rank() == 0;
    cli_work_end();
    for (size_t i = 0; speaks && (line = koksma_study_left_out_at(study, i));
         i++) { /* combinations without results */
        say_left_out(line, strlen(line));
    }
    const koksma_status closed = koksma_study_close(study);
    status = status ? status : closed;
    if (status == KOKSMA_INTERRUPTED) {
        if (options->folder) {
            cli_say(args->command->name,
                    "interrupted; finished work is kept in %s, and the same command continues it", options->folder);
        }
        return koksma_status_exit_code(KOKSMA_INTERRUPTED);
    }
    if (status) {
        return cli_fail(args, status);
    }
    cli_work_end();
    if (options->folder && !cli_flag(args, "quiet")) {
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

static bool study_options(const cli_args *args, koksma_study_options *options, cli_work *work)
{
    uint64_t trials;
    if (!cli_whole(args, "trials", 0, 1, 100000000, &trials) || !cli_work_begin(args, "studying", work) ||
        !cli_real(args, "time-limit", 0, 0, 1e9, &work->run.time_limit_s)) {
        return false;
    }
    *options = (koksma_study_options){.plans = (const char *const *)args->operands + 1,
                                      .n_plans = (size_t)args->n_operands - 1,
                                      .folder = cli_text(args, "output", NULL),
                                      .trials = (long long)trials,
                                      .quick = cli_flag(args, "quick")};
    return true;
}

static int run_plans(const cli_args *args)
{
    cli_work work;
    koksma_study_options options;
    if (args->n_operands < 2 || !cli_text(args, "output", NULL)) {
        return cli_error(args, "run takes a plan and a folder, as in run plan.json -o DIR");
    }
    if (!study_options(args, &options, &work)) {
        return CLI_USAGE;
    }
    if (koksma_study_mpi_rank() > 0) {
        options.folder = NULL;
    }
    const int code = cli_study_run(args, &options, &work, NULL);
    cli_work_end();
    return code;
}

/* ---- export and report --------------------------------------------------------------------------------- */

static int export_rows(const cli_args *args)
{
    static const char *const formats[] = {"csv", "json", "sha256", NULL};
    const char *path = cli_text(args, "output", "-");
    const bool given = cli_text(args, "format", NULL) != NULL;
    const char *name = given ? "" : ending_of(path);
    int format = 0;
    if (args->n_operands != 2) {
        return cli_error(args, "export takes a study's folder, as in export DIR --format csv");
    }
    while (*name && formats[format] && strcmp(formats[format], name) != 0) {
        format++;
    }
    if (!formats[format]) {
        return cli_error(args, "%s: the name of an export must end in .csv, .json or .sha256", path);
    }
    if (!cli_choice(args, "format", &format)) {
        return CLI_USAGE;
    }
    koksma_status status = koksma_study_export(args->operands[1], (koksma_export_format)format, path);
    char *left_out = NULL;
    if (!status && !cli_flag(args, "quiet")) { /* report what the export lacks */
        status = koksma_study_left_out(args->operands[1], &left_out);
    }
    for (const char *line = left_out; line && *line; line += strcspn(line, "\n") + 1) {
        say_left_out(line, strcspn(line, "\n"));
    }
    free(left_out);
    return status ? cli_fail(args, status) : CLI_YES;
}

static int report(const cli_args *args)
{
    cli_work work;
    koksma_study *study = NULL;
    if (args->n_operands != 2) {
        return cli_error(args, "report takes a study's folder, as in report DIR");
    }
    if (!cli_work_begin(args, "reporting", &work)) {
        return CLI_USAGE;
    }
    if (koksma_study_mpi_rank() > 0) {
        return CLI_YES;
    }
    const koksma_study_options options = {.folder = args->operands[1]};
    koksma_status status = koksma_study_open(&options, &study);
    status = status ? status : koksma_study_report(study, &work.run);
    size_t jobs = 0, undone = 0;
    status = status ? status : koksma_study_undone(study, &jobs, &undone);
    cli_work_end();
    const koksma_status closed = koksma_study_close(study);
    status = status ? status : closed;
    if (!status && undone && !cli_flag(args, "quiet")) {
        cli_say(
            "study",
            "%zu of %zu jobs have no rows: a run ended before them, or made rows of files, scenes or code that have "
            "changed since; 'koksma study run' does them",
            undone, jobs);
    }
    return status ? cli_fail(args, status) : CLI_YES;
}

/* ---- audit: under mpirun rank 0 prints ------------------------------------------------------------------- */

/* Prints a difference as it is found. context: the arguments. */
static void put_difference(void *context, const char *text)
{
    if (cli_flag(context, "json")) {
        cli_row("differs %s\n", text);
    } else {
        cli_work_end();
        printf("differs: %s\n", text);
    }
}

static void put_audit_row(const koksma_audit *a, uint64_t seed)
{
    cli_row("rows %lld seed %llu drawn %lld agree %lld wrong_below %g other_revisions %lld "
            "references %zu references_agree %zu references_missing %zu rows_missing %lld "
            "differences %zu\n",
            a->rows, (unsigned long long)seed, a->drawn, a->agree, a->bound, a->other_rows, a->references,
            a->references_agree, a->references_missing, a->rows_missing, a->differences);
}

/* Prints the result of an audit. The bound on the share of wrong rows is rounded up to two digits, so that the
   printed bound holds. */
static void print_audit(const koksma_audit *a, uint64_t seed)
{
    if (a->drawn == a->rows) {
        printf("%lld rows drawn, of which %lld agree: these are all\n", a->drawn, a->agree);
    } else {
        const double unit = pow(10, floor(log10(100 * a->bound)) - 1);
        printf("%lld rows drawn with seed %llu, of which %lld agree", a->drawn, (unsigned long long)seed, a->agree);
        printf(": with 95 %% confidence fewer than %g %% are wrong\n", ceil(100 * a->bound / unit - 1e-9) * unit);
    }
    printf("%zu reference images rendered again, of which %zu agree", a->references, a->references_agree);
    printf(a->references_missing ? "; the files of %zu are missing" : "", a->references_missing);
    puts("");
    if (a->rows_missing) {
        printf(
            "not there: %lld rows of earlier trials: a run was cut short, jobs failed, or somebody removed them; the "
            "next run makes them\n",
            a->rows_missing);
    }
    if (a->other_rows) {
        printf("not compared: %lld rows of other plans, files or revisions\n", a->other_rows);
    }
}

/* Reads --seed. Without it, the operating system gives 64 random bits, because whoever knows the seed knows which
   rows are drawn and can change all others: the confidence limit would not hold. Returns the exit code. */
static int audit_seed(const cli_args *args, uint64_t *seed)
{
    if (cli_text(args, "seed", NULL)) {
        return cli_whole(args, "seed", 0, 0, UINT64_MAX, seed) ? CLI_YES : CLI_USAGE;
    }
    if (getentropy(seed, sizeof *seed)) {
        cli_say(args->command->name, "the operating system gives no random seed: %s; give one with --seed",
                strerror(errno));
        return koksma_status_exit_code(KOKSMA_SYSTEM);
    }
    return CLI_YES;
}

/* Reads --rows; 0 stands for all. */
static bool audit_rows(const cli_args *args, uint64_t *rows)
{
    const char *text = cli_text(args, "rows", "200");
    char *end, meant[96];
    const bool all = !strcmp(text, "all");
    errno = 0;
    *rows = all ? 0 : strtoull(text, &end, 10);
    if (!all && (text[0] < '0' || text[0] > '9' || *end || errno || *rows < 1 || *rows > INT64_MAX)) {
        return !cli_error(args, "--rows %s: %sit takes 'all', or a whole number from 1 to %lld", text,
                          cli_meant_of(text, "all", meant), (long long)INT64_MAX);
    }
    return true;
}

static int audit(const cli_args *args)
{
    cli_work work;
    koksma_audit found;
    uint64_t n, seed;
    const bool json = cli_flag(args, "json");
    if (args->n_operands != 2) {
        return cli_error(args, "audit takes a study's folder, as in audit DIR");
    }
    if (!audit_rows(args, &n) || !cli_work_begin(args, "auditing", &work)) {
        return CLI_USAGE;
    }
    const int failed = audit_seed(args, &seed);
    if (failed) {
        return failed;
    }
    const bool speaks = koksma_study_mpi_rank() == 0;
    const koksma_audit_options options = {.folder = args->operands[1],
                                          .rows = (long long)n,
                                          .seed = seed,
                                          .differs = speaks ? put_difference : NULL,
                                          .context = (void *)args};
    const koksma_status status = koksma_study_audit(&options, &work.run, &found);
    cli_work_end();
    if (status) {
        return speaks ? cli_fail(args, status) : koksma_status_exit_code(status);
    }
    if (!speaks) {
        return CLI_YES;
    }
    if (json) {
        put_audit_row(&found, seed);
        return cli_rows_close(found.differences ? CLI_NO : CLI_YES);
    }
    print_audit(&found, seed);
    return found.differences ? CLI_NO : CLI_YES;
}

/* ---- The command --------------------------------------------------------------------------------------- */

/* Returns false, after an error, if an option is given that the verb does not accept. own: the names of the options
   of this verb, separated by blanks. */
static bool takes_options(const cli_args *args, const char *own)
{
    static const char common[] = " threads progress quiet allow-exec exec-seconds unknown help ";
    for (int i = 0; args->command->options[i].name; i++) {
        char name[32];
        snprintf(name, sizeof name, " %s ", args->command->options[i].name);
        if (args->values[i] && !strstr(own, name) && !strstr(common, name)) {
            return !cli_error(args, "%s takes no --%s", args->operands[0], args->command->options[i].name);
        }
    }
    return true;
}

static int run(const cli_args *args)
{
    static const struct {
        const char *name;
        int (*run)(const cli_args *args);
        const char *options; /* names of the options that the verb accepts in addition to the common ones */
    } verbs[] = {{"run", run_plans, " output trials quick time-limit "},
                 {"new", new_plan, " output "},
                 {"export", export_rows, " output format "},
                 {"report", report, " "},
                 {"audit", audit, " rows seed json digits long "}};
    for (size_t i = 0; args->n_operands > 0 && i < sizeof verbs / sizeof *verbs; i++) {
        if (!strcmp(verbs[i].name, args->operands[0])) {
            return takes_options(args, verbs[i].options) ? verbs[i].run(args) : CLI_USAGE;
        }
    }
    return cli_takes(args, "", args->n_operands ? args->operands[0] : NULL, "run, new, export, report or audit");
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
