/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma generate`: generates one point set of a pattern, or a range of its points, maps it by --warp, and writes it
 * to a file or to standard output. Points of patterns that can generate ranges are written piece by piece, unless
 * --warp is given. The comment in the file has the pattern and the seed, and for points of blue-noise patterns in the unit
 * square the smallest distance of two of them.
 */
#include <ctype.h>
#include <koksma/koksma.h>
#include <koksma/verify.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"
#include "measuring.h"
#include "source.h"

/* Generates the points and writes them. points: for all of them, whose number the pattern determines if it is 0; NULL: they
   are written piece by piece. */
static int write_points(const cli_args *args, const cli_source *source, const koksma_warp *warp, uint64_t first,
                        uint64_t seed, cli_work *work, koksma_points *points)
{
    char text[KOKSMA_MAX_SPEC], comment[KOKSMA_MAX_SPEC + 128];
    const char *output = cli_text(args, "output", "-");
    const koksma_spec *spec = &source->spec;
    const koksma_run *run = &work->run;
    koksma_status status = KOKSMA_OK;
    double distance;
    koksma_spec_text(spec, text);
    snprintf(comment, sizeof comment, "pattern %s\nseed %llu", text, (unsigned long long)seed);
    if (first) {
        CLI_APPEND(comment, sizeof comment, "\nfirst %llu", (unsigned long long)first);
    }
    if (points) {
        status = points->n ? koksma_generate(spec, seed, run, points)
                           : koksma_generate_whole(spec, seed, run, points->dim, points);
    }
    if (!status && points && warp) {
        CLI_APPEND(comment, sizeof comment, "\nwarp %s", warp->name);
        status = points->dim == 2 ? cli_map_points(warp, points) : KOKSMA_OK;
    } else if (!status && points && spec->pattern->claims & KOKSMA_CLAIM_BLUE && points->dim == 2 && points->n > 1 &&
               !koksma_smallest_distance(points, true, run, &distance)) {
        CLI_APPEND(comment, sizeof comment, "\ndistance-torus %.17g", distance);
    }
    if (!strcmp(output, "-") && isatty(STDOUT_FILENO)) {
        cli_work_hide(work); /* the points follow on the terminal */
    }
    status = status    ? status
             : !points ? koksma_generate_write(spec, seed, first, source->n, source->dim, output, comment, run)
             : warp    ? koksma_points_write_mapped(output, points, comment, run)
                       : koksma_points_write(output, points, comment, run);
    cli_work_end();
    return status ? cli_fail(args, status) : CLI_YES;
}

static int run(const cli_args *args)
{
    cli_source source;
    koksma_points points;
    cli_work work;
    uint64_t dim, seed, first;
    if (args->n_operands != 1) {
        char known[CLI_KNOWN];
        const char *n = cli_text(args, "n", "");
        const int is_number = args->n_operands < 2 || !isdigit((unsigned char)*args->operands[0]);
        return strchr(n, ',')
                   ? cli_error(args, "-n %s: it takes one number of points, without commas", n)
                   : cli_error(args, "it takes one pattern, such as n-rooks or poisson-disk:d=0.2%s",
                               args->n_operands > 1 ? cli_operand_hint(args, args->operands[is_number], known) : "");
    }
    int code = cli_pattern_open(args, args->operands[0], &source);
    if (code) {
        return code;
    }
    const koksma_pattern *pattern = source.spec.pattern;
    if (!source.n && !pattern->whole) {
        return cli_error(args, "-n N, the number of points, is missing");
    }
    if (!cli_whole(args, "first", 0, 0, KOKSMA_MAX_INDEX, &first) ||
        !cli_whole(args, "dim", 2, 1, KOKSMA_MAX_DIM, &dim) || !cli_whole(args, "seed", 0, 0, UINT64_MAX, &seed) ||
        !cli_work_begin(args, "generating", &work)) {
        return CLI_USAGE;
    }
    if (cli_flag(args, "seed") && koksma_has_one_set(&source.spec) && !cli_flag(args, "quiet")) {
        char text[KOKSMA_MAX_SPEC];
        koksma_spec_text(&source.spec, text);
        cli_warn_one_set(args, text);
    }
    dim = source.n ? (uint64_t)source.dim : dim;
    const char *name = cli_text(args, "warp", NULL);
    const koksma_warp *warp = name ? cli_find_warp(args, name) : NULL;
    if (name && (!warp || dim != 2)) {
        return warp ? cli_error(args, "--warp maps points of 2 dimensions, not %d", (int)dim) : CLI_USAGE;
    }
    if (first && (name || !source.n)) {
        return cli_error(args, "--first needs -n N and excludes --warp");
    }
    code = cli_try_output(args, cli_text(args, "output", "-"));
    if (code) {
        return code;
    }
    if (source.n && !warp && (first || koksma_has_ranges(&source.spec))) {
        return write_points(args, &source, NULL, first, seed, &work, NULL);
    }
    const bool given = cli_text(args, "dim", NULL) || !pattern->operand;
    points = (koksma_points){.dim = given ? (int)dim : 0};
    const koksma_status status = source.n ? koksma_points_init(&points, source.n, source.dim) : KOKSMA_OK;
    code = status ? cli_fail(args, status) : write_points(args, &source, warp, 0, seed, &work, &points);
    koksma_points_fini(&points);
    return code;
}

static const cli_option options[] = {
    {'n', "n", "N", "number of points (may be left out for file:PATH and poisson-disk-maximal:d=D)"},
    {'d', "dim", "DIM", "number of dimensions (default: 2)"},
    {'p', "patterns", "PATTERN", "the pattern, instead of the operand"},
    {0, "first", "I", "index of the first point, up to 2^51 - 1, for sequences that have ranges (default: 0)"},
    {'s', "seed", "S", "seed of the random numbers (default: 0)"},
    {0, "warp", "WARP", "map the points to a disk, triangle, hemisphere or sphere; see 'koksma list warps'"},
    {'o', "output", "FILE.txt|.csv|.npy", "the file (default: text on stdout)"},
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_generate = {
    .name = "generate",
    .summary = "generate the points of a pattern",
    .synopsis = "PATTERN|SPEC@N[@DIM] [-n N] [-d DIM] [-s S] [--warp WARP] [-o FILE]",
    .details =
        "PATTERN is a name with parameters, such as poisson-disk:d=0.2,torus=1; see 'koksma list patterns'. "
        "Modifiers follow the parameters, as in file:set.txt,shift=1; 'koksma list modifiers' describes them. For "
        "your own sampler use exec:PROGRAM, which is run with n, dim and seed, or plugin:LIBRARY.so; both need "
        "--allow-exec.\n"
        "\n"
        "Patterns that have ranges (see 'koksma list patterns') are written piece by piece, for any N. All other "
        "patterns are generated in memory, with at most 2^28 coordinates.\n"
        "\n"
        "Equal arguments give equal bits, on any number of threads. Some patterns use one thread, because each "
        "point depends on those before it: Poisson disks, best candidates, sample elimination, pmj02bn, scan-time, "
        "uniform-jittered and most of orthogonal-array.\n",
    .examples = "koksma generate sobol:scramble=owen -n 64 --seed 1 -o points.csv\n"
                "koksma generate n-rooks -n 16\n"
                "koksma generate sobol -n 1000000 --first 4000000000 -o far.npy\n"
                "koksma generate jittered -n 64 --warp concentric-disk -o disk.txt\n",
    .options = options,
    .run = run,
};
