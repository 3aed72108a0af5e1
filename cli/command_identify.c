/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma identify`: says which known points a set is, or by which map it arises from them. */
#include <koksma/identify.h>

#include "cli.h"
#include "source.h"

static void put_rows(const char *source, const koksma_points *points, const koksma_identities *identities)
{
    for (size_t i = 0; i < identities->count; i++) {
        const koksma_identity *said = &identities->items[i];
        cli_row("source %s n %zu dim %d relation %s what %s spec %s first %zu seed %llu detail %s\n", source,
                points->n, points->dim, said->relation, *said->what ? said->what : "-",
                *said->spec ? said->spec : "-", said->first, (unsigned long long)said->seed, said->detail);
    }
}

/* Reads an operand: coordinates of files may be any numbers. Returns the exit code. */
static int read_points(const cli_args *args, const char *source, uint64_t seed, const koksma_run *run,
                       koksma_points *points)
{
    *points = (koksma_points){0};
    if (cli_source_is_pattern(source) || cli_flag(args, "scale")) {
        return cli_source_points(args, source, seed, run, points);
    }
    const koksma_status status = koksma_points_read_mapped(source, points);
    if (!status) {
        cli_warn_points(args, source, points, NULL);
    }
    return status ? cli_fail(args, status) : CLI_YES;
}

static int run(const cli_args *args)
{
    uint64_t seed;
    cli_work work;
    if (args->n_operands == 0) {
        return cli_error(args, "it takes files of points, - for stdin, or SPEC@N");
    }
    if (!cli_sources_check(args, 0, 1, 0) || !cli_whole(args, "seed", 0, 0, UINT64_MAX, &seed) ||
        !cli_work_begin(args, "identifying", &work)) {
        return CLI_USAGE;
    }
    bool named = true;
    int code = CLI_YES;
    for (int i = 0; i < args->n_operands && !code; i++) {
        koksma_points points;
        koksma_identities identities = {0};
        const char *source = args->operands[i];
        cli_work_part(&work, (size_t)i, (size_t)args->n_operands);
        code = read_points(args, source, seed, &work.run, &points);
        if (!code) {
            cli_work_unknown(&work, "identifying");
            const koksma_status status = koksma_identify(&points, &work.run, &identities);
            cli_work_end();
            code = status ? cli_fail(args, status) : CLI_YES;
        }
        bool one = false;
        for (size_t k = 0; k < identities.count; k++) {
            one = one || koksma_identity_names(&identities.items[k]);
        }
        named = named && one;
        put_rows(source, &points, &identities);
        koksma_identities_fini(&identities);
        koksma_points_fini(&points);
    }
    return cli_rows_close(code ? code : named ? CLI_YES : CLI_NO);
}

static const cli_option options[] = {
    CLI_SOURCE_OPTIONS, {'s', "seed", "S", "seed of patterns (default: 0)"}, CLI_ROW_OPTIONS, CLI_RUN_OPTIONS, {0},
};

const cli_command cli_command_identify = {
    .name = "identify",
    .summary = "say which known points a set is",
    .synopsis = "FILE|-|SPEC@N[@DIM]... [--json]",
    .details =
        "Compares points with the sequences, lattices and patterns that are known here, and says how the points "
        "arise from them. Sequences are those of Sobol' (direction numbers of Joe & Kuo, Bratley & Fox and ours), "
        "Niederreiter in base 2, Halton and Faure, from any first point, in natural order and that of Gray's code; "
        "then rank-1 lattices and lattice sequences, additive recurrences, Hammersley points, grids, and every "
        "pattern of 'koksma list patterns' with seeds from 0 on. Coordinates may be permuted, points in another "
        "order or left out, numbers rounded to float, to few digits, or scaled to [-1,1], [-1/2,1/2] or a box.\n"
        "relation: equal, reordered, part: the points are those, another order or some of what the row names; spec "
        "makes them, 'first' is the index of the first. shifted: one vector was added modulo 1. digital-shift, "
        "digit-permutation, linear-scramble, nested-scramble: what happened to the digits; nested-scramble is "
        "Owen's or one of its hashes. lattice, recurrence, grid: 'detail' has the numbers. Where no table here has "
        "the source: sequence, one in base 2 of other matrices, scrambled or shuffled; stratified, a Latin hypercube "
        "or jittered points. scaled, rounded: how the numbers were read. Each statement was tested for every "
        "point; a linear scramble may miss one point of 64, and its detail says how many.\n"
        "unknown: nothing that is known here makes these points. That is an answer, too; the docs page "
        "conventions-of-others.md has the conventions of other libraries. Exit codes: 0 when all sets are named; 1 "
        "when one is unknown; 2 for a wrong command line; 3 for points that are missing or malformed.",
    .examples = "koksma identify points.txt\n"
                "koksma identify sobol:scramble=owen@256@4 --seed 5\n",
    .options = options,
    .run = run,
};
