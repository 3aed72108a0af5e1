/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma verify`: reports which properties points have, or how the points of many sets, one for each seed, are
   distributed; with --expect the exit code tells whether given properties hold. */
#include <koksma/optimise.h>
#include <koksma/verify.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "source.h"

static void put_rows(const char *source, const koksma_points *points, const koksma_findings *findings)
{
    for (size_t i = 0; i < findings->count; i++) {
        const koksma_finding *f = &findings->items[i];
        cli_row("source %s n %zu dim %d property %s subject %s holds? %d value %g detail %s\n", source, points->n,
                points->dim, f->property, f->subject, f->holds, f->value, f->detail);
    }
}

static const koksma_property *find_property(const char *name)
{
    size_t i = 0;
    while (koksma_property_at(i) && strcmp(name, koksma_property_at(i)->name) != 0) {
        i++;
    }
    return koksma_property_at(i);
}

/* Returns whether a property of the list fails, was not tested, or was tested only in some coordinates. A message on
   stderr reports a property that was not tested in all coordinates. */
static bool disappoints(const char *list, const char *source, const koksma_points *points,
                        const koksma_findings *findings)
{
    char name[64];
    for (size_t i = 0; cli_list_item(list, i, name, sizeof name); i++) {
        bool seen = false;
        for (size_t j = 0; j < findings->count; j++) {
            if (!strcmp(findings->items[j].property, name)) {
                seen = true;
                if (!findings->items[j].holds) {
                    return true;
                }
            }
        }
        const bool of_sets = find_property(name)->of_sets,
                   many = findings->count && find_property(findings->items[0].property)->of_sets;
        if (!seen && of_sets != many) {
            cli_say("verify", "%s: %s was not tested: it is a property of %s", source, name,
                    of_sets ? "many sets, which --seeds R or a name with {seed} gives"
                            : "one set; test it by a command without --seeds");
            return true;
        }
        if (!seen) {
            cli_say("verify", "%s: %s was not tested: it does not apply to %zu points in %d dimensions", source, name,
                    points->n, points->dim);
            return true;
        }
        const int coordinates = find_property(name)->coordinates;
        if (coordinates && points->dim > coordinates) {
            cli_say("verify", "%s: %s was tested only in the first %d coordinates", source, name, coordinates);
            return true;
        }
    }
    return false;
}

/* Returns the set that the pattern `record` stores for the measure of this canonical text, or NULL if it has none. */
static const koksma_record *find_record(const char *measure, const koksma_points *points)
{
    const koksma_record *r, *found = NULL;
    for (size_t i = 0; (r = koksma_record_at(i)); i++) {
        found = r->n == points->n && r->dim == points->dim && !strcmp(r->measure, measure) ? r : found;
    }
    return found;
}

/* --record: prints the exact value of a measure for the points, and the best known value for this number of points
   and dimensions, which is the value of the set that the pattern `record` stores. *is_record: the points have a better
   value. Without a known value nothing can be compared, which a message says. Returns the exit code. */
static int put_record(const cli_args *args, const char *source, const koksma_points *points, const koksma_run *run,
                      bool *is_record)
{
    koksma_spec measure;
    koksma_value value;
    const char *text = cli_text(args, "measure", "star");
    koksma_status status = koksma_measure_spec(text, &measure);
    if (status) {
        return cli_fail(args, status);
    }
    char name[KOKSMA_MAX_SPEC];
    koksma_spec_text(&measure, name);
    if (measure.measure->answer != KOKSMA_ANSWER_EXACT) {
        return cli_error(args, "-m %s: it takes a measure with exact values, such as star or l2-star", text);
    }
    const koksma_record *here = find_record(name, points);
    status = koksma_evaluate(&measure, points, run, &value);
    if (status) {
        return cli_fail(args, status);
    }
    /* The stored coordinates of the known sets are rounded, so the same set with unrounded coordinates can have a
       slightly better value. The value of a record must be better by more than this difference. */
    const double sign = measure.measure->larger_is_better ? 1 : -1;
    *is_record = here && sign * (value.value - here->value) > 1e-11;
    if (!here) {
        cli_say("verify",
                "%s: nothing is known to compare with: %s has no set for n = %zu, dim = %d in 'koksma list records'",
                source, name, points->n, points->dim);
    }
    cli_row("source %s n %zu dim %d measure %s value %g best_here %g published %g", source, points->n, points->dim,
            name, value.value, here ? here->value : (double)NAN,
            here && here->published > 0 ? here->published : (double)NAN);
    cli_row_json("record", here ? *is_record ? "true" : "false" : "null",
                 here ? *is_record ? "yes" : "no" : "unknown");
    cli_row_end();
    return CLI_YES;
}

/* Prints the properties of the points, or of n_sets > 1 sets. *missed: a property of --expect does not hold. Returns the
   exit code. */
static int put_findings(const cli_args *args, const char *source, const koksma_points *points, size_t n_sets,
                        cli_work *work, bool *missed)
{
    const char *expect = cli_text(args, "expect", NULL);
    koksma_findings findings = {0};
    const koksma_status status = n_sets > 1 ? koksma_verify_sets(points, n_sets, &work->run, &findings)
                                            : koksma_verify(points, &work->run, &findings);
    cli_work_end();
    if (!status) {
        put_rows(source, points, &findings);
        *missed = *missed || (expect && disappoints(expect, source, points, &findings));
    }
    koksma_findings_fini(&findings);
    return status ? cli_fail(args, status) : CLI_YES;
}

static int by_size(const void *a, const void *b)
{
    const koksma_points *p = a, *q = b;
    const int order = (p->n > q->n) - (p->n < q->n);
    return order ? order : (p->dim > q->dim) - (p->dim < q->dim);
}

/* Prints the properties of sets that a pattern makes or files have, together for all sets of a size. Returns the exit
   code. */
static int put_sets(const cli_args *args, const char *source, uint64_t seed, size_t seeds, cli_work *work,
                    bool *missed)
{
    glob_t files = {0};
    const bool of_files = cli_is_family(source);
    const size_t n_sets = of_files ? cli_family_files(source, &files) : seeds;
    koksma_points *sets = calloc(n_sets + 1, sizeof *sets);
    int code = sets ? CLI_YES : cli_no_memory();
    if (!code && !n_sets) {
        cli_error(args, "%s: no file has such a name, with digits for {n} and {seed}", source);
        code = koksma_status_exit_code(KOKSMA_MISSING);
    }
    for (size_t i = 0; i < n_sets && !code; i++) {
        code = cli_source_points(args, of_files ? files.gl_pathv[i] : source, seed + i, &work->run, &sets[i]);
    }
    if (!code && of_files) {
        qsort(sets, n_sets, sizeof *sets, by_size);
    }
    for (size_t first = 0, end; first < n_sets && !code; first = end) {
        for (end = first + 1; end < n_sets && !by_size(&sets[first], &sets[end]);) {
            end++;
        }
        code = end - first > 1 ? put_findings(args, source, sets + first, end - first, work, missed)
                               : cli_error(args,
                                           "%s: there is one set of %zu points; a distribution takes "
                                           "many, one file for each seed",
                                           source, sets[first].n);
    }
    for (size_t i = 0; sets && i < n_sets; i++) {
        koksma_points_fini(&sets[i]);
    }
    free(sets);
    globfree(&files);
    return code;
}

/* Fails if --seeds is given and an operand names one set. */
static bool check_seeds(const cli_args *args)
{
    const bool seeds = cli_text(args, "seeds", NULL) != NULL;
    for (int i = 0; i < args->n_operands && seeds; i++) {
        const char *source = args->operands[i];
        if (!cli_source_is_pattern(source) && !cli_is_family(source)) {
            return !cli_error(args, "--seeds: '%s' is one set; it takes patterns, SPEC@N", source);
        }
        if (cli_flag(args, "record")) {
            return !cli_error(args, "--seeds has no effect with --record, which looks at single sets");
        }
    }
    return true;
}

static int run(const cli_args *args)
{
    uint64_t seed, seeds;
    cli_work work;
    const char *expect = cli_text(args, "expect", NULL);
    char name[64];
    for (size_t i = 0; expect && cli_list_item(expect, i, name, sizeof name); i++) {
        if (!find_property(name)) {
            char names[512], what[96];
            snprintf(what, sizeof what, "no property '%s'; ", name);
            return cli_takes(args, what, name,
                             cli_join(cli_noun_of("PROPERTY", 8)->name, NULL, ", ", ", ", names, sizeof names));
        }
    }
    if (cli_text(args, "measure", NULL) && !cli_flag(args, "record")) {
        return cli_error(args, "-m MEASURE has an effect only with --record");
    }
    if (expect && cli_flag(args, "record")) {
        return cli_error(args, "-e PROPERTY has no effect with --record, which tests no properties; check "
                               "them by a command without --record");
    }
    if (args->n_operands == 0) {
        return cli_error(args, "it takes files of points, - for stdin, or SPEC@N");
    }
    if (!cli_sources_check(args, 0, 1, 0) || !cli_whole(args, "seed", 0, 0, UINT64_MAX, &seed) ||
        !cli_whole(args, "seeds", 0, KOKSMA_VERIFY_SETS, 1 << 20, &seeds) || !check_seeds(args) ||
        !cli_work_begin(args, "verifying", &work)) {
        return CLI_USAGE;
    }
    bool missed = false;
    int code = CLI_YES;
    for (int i = 0; i < args->n_operands && !code; i++) {
        koksma_points points = {0};
        const char *source = args->operands[i];
        bool one = false;
        cli_work_part(&work, (size_t)i, (size_t)args->n_operands);
        if (!cli_flag(args, "record") && (seeds || cli_is_family(source))) {
            code = put_sets(args, source, seed, (size_t)seeds, &work, &missed);
            continue;
        }
        code = cli_source_points(args, source, seed, &work.run, &points);
        if (!code && cli_flag(args, "record")) {
            code = put_record(args, source, &points, &work.run, &one);
            one = !one;
        } else if (!code) {
            code = put_findings(args, source, &points, 1, &work, &one);
        }
        missed = missed || one;
        koksma_points_fini(&points);
    }
    return cli_rows_close(code ? code : missed ? CLI_NO : CLI_YES);
}

static const cli_option options[] = {
    {'e', "expect", "PROPERTY,..", "exit with code 1 unless all these properties hold"},
    {0, "record", NULL,
     "compare the star discrepancy with the best known value for this number of points; exit with code 1 unless it "
     "is lower (of distances: larger), also if none is known"},
    {'m', "measure", "MEASURE", "with --record: measure to compare instead of star, such as l2-star"},
    CLI_SOURCE_OPTIONS,
    {'s', "seed", "S", "seed of patterns, or the first of --seeds (default: 0)"},
    {0, "seeds", "R", "test how points are distributed in R sets of each pattern, one for each seed; at least 32"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_verify = {
    .name = "verify",
    .summary = "check which properties points have",
    .synopsis =
        "FILE|-|SPEC@N[@DIM]|'my_{n}_{seed}.npy'... [-e PROPERTY,..|--record [-m MEASURE]] [--seeds R] [--json]",
    .details = "Each property is desirable; 'yes' means that the points have it, and the detail explains the value.\n"
               "{property-meanings}\n"
               "The last two are properties of many sets. A name with {seed} stands for many files, such as "
               "my_256_3.npy for 256 points of seed 3; sets of equal sizes are tested together. A pattern that has "
               "such a property fails the test with a probability of at most .001, if its sets are independent.\n"
               "Exit codes: 0 for any findings without --expect; 1 when a property of --expect fails or was not "
               "tested, or when points of --record are no record or no value is known to compare with; 2 for a wrong "
               "command line, such as an unknown property; 3 for points that are missing or malformed.",
    .examples = "koksma verify pattern:sobol@1024\n"
                "koksma verify points.txt --expect distinct\n"
                "koksma verify jittered@16 poisson-disk:d=.1@16 --seeds 1000\n"
                "koksma verify 'my_{n}_{seed}.npy' --expect unbiased\n",
    .options = options,
    .run = run,
};
