/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma study audit`: draws the seed, calls koksma_study_audit, and prints its differences as they are found and its
   result at the end, as text or as JSON lines. Under mpirun rank 0 prints. */
#include "studying.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __APPLE__
#include <sys/random.h> /* getentropy, which others have in unistd.h */
#endif
#include <unistd.h>

#include <koksma/study.h>

typedef struct audited {
    cli_rows *rows; /* open for JSON output; NULL for text output */
} audited;

static void put_difference(void *context, const char *text)
{
    const audited *a = context;
    if (a->rows) {
        cli_row_text(a->rows, "differs", text);
        cli_row_end(a->rows);
    } else {
        cli_work_end();
        printf("differs: %s\n", text);
    }
}

static void put_audit_row(cli_rows *rows, const koksma_audit *a, uint64_t seed)
{
    cli_row_whole(rows, "rows", (uint64_t)a->rows);
    cli_row_whole(rows, "seed", seed);
    cli_row_whole(rows, "drawn", (uint64_t)a->drawn);
    cli_row_whole(rows, "agree", (uint64_t)a->agree);
    cli_row_number(rows, "wrong_below", a->bound);
    cli_row_whole(rows, "other_revisions", (uint64_t)a->other_rows);
    cli_row_whole(rows, "references", a->references);
    cli_row_whole(rows, "references_agree", a->references_agree);
    cli_row_whole(rows, "references_missing", a->references_missing);
    cli_row_whole(rows, "rows_missing", (uint64_t)a->rows_missing);
    cli_row_whole(rows, "differences", a->differences);
    cli_row_end(rows);
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
static int audit_seed(const cli_arguments *arguments, uint64_t *seed)
{
    if (cli_text(arguments, "seed", NULL)) {
        return cli_whole(arguments, "seed", 0, 0, UINT64_MAX, seed) ? CLI_YES : CLI_USAGE;
    }
    if (getentropy(seed, sizeof *seed)) {
        cli_say(arguments->command->name, "the operating system gives no random seed: %s; give one with --seed",
                strerror(errno));
        return koksma_status_exit_code(KOKSMA_SYSTEM);
    }
    return CLI_YES;
}

/* Reads --rows; 0 stands for all. */
static bool audit_rows(const cli_arguments *arguments, uint64_t *rows)
{
    const char *text = cli_text(arguments, "rows", "200");
    char *end, meant[96];
    const bool all = !strcmp(text, "all");
    errno = 0;
    *rows = all ? 0 : strtoull(text, &end, 10);
    if (!all && (text[0] < '0' || text[0] > '9' || *end || errno || *rows < 1 || *rows > INT64_MAX)) {
        cli_usage_error(arguments, "--rows %s: %sit takes 'all', or a whole number from 1 to %lld", text,
                        cli_meant_of(text, "all", meant), (long long)INT64_MAX);
        return false;
    }
    return true;
}

int cli_study_audit(const cli_arguments *arguments)
{
    cli_work work;
    koksma_audit found;
    uint64_t rows, seed;
    const bool json = cli_flag(arguments, "json");
    if (arguments->n_operands != 2) {
        return cli_usage_error(arguments, "audit takes a study's folder, as in audit DIR");
    }
    if (!audit_rows(arguments, &rows) || !cli_work_begin(arguments, "auditing", &work)) {
        return CLI_USAGE;
    }
    const int failed = audit_seed(arguments, &seed);
    if (failed) {
        return failed;
    }
    const bool speaks = koksma_study_mpi_rank() == 0;
    audited to = {json && speaks ? cli_rows_open(true) : NULL};
    const koksma_audit_options options = {.folder = arguments->operands[1],
                                          .rows = (long long)rows,
                                          .seed = seed,
                                          .differs = speaks ? put_difference : NULL,
                                          .context = &to};
    const koksma_status status = koksma_study_audit(&options, &work.run, &found);
    cli_work_end();
    if (status) {
        return speaks ? cli_fail(arguments, status) : koksma_status_exit_code(status);
    }
    if (!speaks) {
        return CLI_YES;
    }
    if (json) {
        put_audit_row(to.rows, &found, seed);
        return cli_rows_close(to.rows, found.differences ? CLI_NO : CLI_YES);
    }
    print_audit(&found, seed);
    return found.differences ? CLI_NO : CLI_YES;
}
