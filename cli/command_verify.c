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

static void put_rows(cli_rows *rows, const char *source, const koksma_points *points, const koksma_findings *findings)
{
    for (size_t i = 0; i < findings->count; i++) {
        const koksma_finding *f = &findings->items[i];
        cli_row_text(rows, "source", source);
        cli_row_whole(rows, "n", points->n);
        cli_row_whole(rows, "dim", (uint64_t)points->dim);
        cli_row_text(rows, "property", f->property);
        cli_row_text(rows, "subject", f->subject);
        cli_row_flag(rows, "holds", f->holds);
        cli_row_number(rows, "value", f->value);
        cli_row_text(rows, "detail", f->detail);
        cli_row_end(rows);
    }
}

static const koksma_property *find_property(const char *name)
{
    const koksma_property *known;
    for (size_t i = 0; (known = koksma_property_at(i)); i++) {
        if (!strcmp(name, known->name)) {
            return known;
        }
    }
    return NULL;
}

static const char *all_properties(char *text, size_t size)
{
    const koksma_property *known;
    size_t used = 0;
    for (size_t i = 0; (known = koksma_property_at(i)) && used < size; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", known->name);
    }
    return text;
}

/* Returns the first name of the list that is no property, or NULL if all are properties. */
static const char *misspelt(const char *list, char *name, size_t size)
{
    for (size_t i = 0; cli_list_item(list, i, name, size); i++) {
        if (!find_property(name)) {
            return name;
        }
    }
    return NULL;
}

static bool findings_of_sets(const koksma_findings *findings)
{
    return findings->count && find_property(findings->items[0].property)->of_sets;
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
        const bool of_sets = find_property(name)->of_sets, many = findings_of_sets(findings);
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
static int put_record(const cli_arguments *arguments, cli_rows *rows, const char *source, const koksma_points *points,
                      const koksma_run *run, bool *is_record)
{
    koksma_spec measure;
    koksma_value value;
    const char *text = cli_text(arguments, "measure", "star");
    koksma_status status = koksma_measure_spec(text, &measure);
    if (status) {
        return cli_fail(arguments, status);
    }
    char name[KOKSMA_MAX_SPEC];
    koksma_spec_text(&measure, name);
    if (measure.measure->answer != KOKSMA_ANSWER_EXACT) {
        return cli_usage_error(arguments, "-m %s: it takes a measure with exact values, such as star or l2-star",
                               text);
    }
    const koksma_record *here = find_record(name, points);
    status = koksma_evaluate(&measure, points, run, &value);
    if (status) {
        return cli_fail(arguments, status);
    }
    /* The stored coordinates of the known sets are rounded, so the same set with unrounded coordinates can have a
       slightly better value. The value of a record must be better by more than this difference. */
    const double sign = measure.measure->larger_is_better ? 1 : -1;
    *is_record = here && sign * (value.value - here->value) > 1e-11;
    cli_row_text(rows, "source", source);
    cli_row_whole(rows, "n", points->n);
    cli_row_whole(rows, "dim", (uint64_t)points->dim);
    cli_row_text(rows, "measure", name);
    cli_row_number(rows, "value", value.value);
    cli_row_number(rows, "best_here", here ? here->value : (double)NAN);
    cli_row_number(rows, "published", here && here->published > 0 ? here->published : (double)NAN);
    if (here) {
        cli_row_flag(rows, "record", *is_record);
    } else {
        cli_row_json(rows, "record", "null", "unknown");
        cli_say("verify",
                "%s: nothing is known to compare with: %s has no set for n = %zu, dim = %d in 'koksma list records'",
                source, name, points->n, points->dim);
    }
    cli_row_end(rows);
    return CLI_YES;
}

/* Prints the properties of the points, or of n_sets > 1 sets. *missed: a property of --expect does not hold. Returns the
   exit code. */
static int put_findings(const cli_arguments *arguments, cli_rows *rows, const char *source,
                        const koksma_points *points, size_t n_sets, cli_work *work, bool *missed)
{
    const char *expect = cli_text(arguments, "expect", NULL);
    koksma_findings findings = {0};
    const koksma_status status = n_sets > 1 ? koksma_verify_sets(points, n_sets, &work->run, &findings)
                                            : koksma_verify(points, &work->run, &findings);
    cli_work_end();
    if (!status) {
        put_rows(rows, source, points, &findings);
        *missed = *missed || (expect && disappoints(expect, source, points, &findings));
    }
    koksma_findings_fini(&findings);
    return status ? cli_fail(arguments, status) : CLI_YES;
}

static int by_size(const void *a, const void *b)
{
    const koksma_points *p = a, *q = b;
    const int order = (p->n > q->n) - (p->n < q->n);
    return order ? order : (p->dim > q->dim) - (p->dim < q->dim);
}

/* Prints the properties of sets that a pattern makes or files have, together for all sets of a size. Returns the exit
   code. */
static int put_sets(const cli_arguments *arguments, cli_rows *rows, const char *source, uint64_t seed, size_t seeds,
                    cli_work *work, bool *missed)
{
    glob_t files = {0};
    const bool of_files = cli_is_family(source);
    const size_t n_sets = of_files ? cli_family_files(source, &files) : seeds;
    koksma_points *sets = calloc(n_sets + 1, sizeof *sets);
    int code = sets ? CLI_YES : cli_no_memory();
    if (!code && !n_sets) {
        cli_usage_error(arguments, "%s: no file has such a name, with digits for {n} and {seed}", source);
        code = koksma_status_exit_code(KOKSMA_MISSING);
    }
    for (size_t i = 0; i < n_sets && !code; i++) {
        code = cli_source_points(arguments, of_files ? files.gl_pathv[i] : source, seed + i, &work->run, &sets[i]);
    }
    if (!code && of_files) {
        qsort(sets, n_sets, sizeof *sets, by_size);
    }
    for (size_t first = 0, end; first < n_sets && !code; first = end) {
        for (end = first + 1; end < n_sets && !by_size(&sets[first], &sets[end]);) {
            end++;
        }
        code = end - first > 1 ? put_findings(arguments, rows, source, sets + first, end - first, work, missed)
                               : cli_usage_error(arguments,
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
static bool check_seeds(const cli_arguments *arguments)
{
    const bool seeds = cli_text(arguments, "seeds", NULL) != NULL;
    for (int i = 0; i < arguments->n_operands && seeds; i++) {
        const char *source = arguments->operands[i];
        if (!cli_source_is_pattern(source) && !cli_is_family(source)) {
            cli_usage_error(arguments, "--seeds: '%s' is one set; it takes patterns, SPEC@N", source);
            return false;
        }
        if (cli_flag(arguments, "record")) {
            cli_usage_error(arguments, "--seeds has no effect with --record, which looks at single sets");
            return false;
        }
    }
    return true;
}

static int run(const cli_arguments *arguments)
{
    uint64_t seed, seeds;
    cli_work work;
    const char *expect = cli_text(arguments, "expect", NULL);
    char name[64];
    if (expect && misspelt(expect, name, sizeof name)) {
        char names[512];
        char meant[96];
        all_properties(names, sizeof names);
        return cli_usage_error(arguments, "no property '%s'; %sit takes %s", name, cli_meant_of(name, names, meant),
                               names);
    }
    if (cli_text(arguments, "measure", NULL) && !cli_flag(arguments, "record")) {
        return cli_usage_error(arguments, "-m MEASURE has an effect only with --record");
    }
    if (expect && cli_flag(arguments, "record")) {
        return cli_usage_error(arguments, "-e PROPERTY has no effect with --record, which tests no properties; check "
                                          "them by a command without --record");
    }
    if (arguments->n_operands == 0) {
        return cli_usage_error(arguments, "it takes files of points, - for stdin, or SPEC@N");
    }
    if (!cli_sources_check(arguments, 0, 1, 0) || !cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &seed) ||
        !cli_whole(arguments, "seeds", 0, KOKSMA_VERIFY_SETS, 1 << 20, &seeds) || !check_seeds(arguments) ||
        !cli_work_begin(arguments, "verifying", &work)) {
        return CLI_USAGE;
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    bool missed = false;
    int code = CLI_YES;
    for (int i = 0; i < arguments->n_operands && !code; i++) {
        koksma_points points = {0};
        const char *source = arguments->operands[i];
        bool one = false;
        cli_work_part(&work, (size_t)i, (size_t)arguments->n_operands);
        if (!cli_flag(arguments, "record") && (seeds || cli_is_family(source))) {
            code = put_sets(arguments, rows, source, seed, (size_t)seeds, &work, &missed);
            continue;
        }
        code = cli_source_points(arguments, source, seed, &work.run, &points);
        if (!code && cli_flag(arguments, "record")) {
            code = put_record(arguments, rows, source, &points, &work.run, &one);
            one = !one;
        } else if (!code) {
            code = put_findings(arguments, rows, source, &points, 1, &work, &one);
        }
        missed = missed || one;
        koksma_points_fini(&points);
    }
    return cli_rows_close(rows, code ? code : missed ? CLI_NO : CLI_YES);
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
