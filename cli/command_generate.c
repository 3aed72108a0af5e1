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

/* Ends the progress line if the points follow it on the terminal. */
static void make_way(const cli_arguments *arguments, cli_work *work)
{
    if (!strcmp(cli_text(arguments, "output", "-"), "-") && isatty(STDOUT_FILENO)) {
        cli_work_hide(work);
    }
}

/* Generates all points in memory and writes them. If points->n is 0, the pattern determines the number of points. */
static int generate(const cli_arguments *arguments, const koksma_spec *spec, const koksma_warp *warp, uint64_t seed,
                    cli_work *work, koksma_points *points)
{
    char text[KOKSMA_MAX_SPEC], comment[KOKSMA_MAX_SPEC + 128];
    const koksma_run *run = &work->run;
    koksma_status status = points->n ? koksma_generate(spec, seed, run, points)
                                     : koksma_generate_whole(spec, seed, run, points->dim, points);
    if (!status) {
        koksma_spec_text(spec, text);
        int used = snprintf(comment, sizeof comment, "pattern %s\nseed %llu", text, (unsigned long long)seed);
        double distance;
        if (!warp && spec->pattern->claims & KOKSMA_CLAIM_BLUE && points->dim == 2 && points->n > 1 &&
            !koksma_smallest_distance(points, true, run, &distance)) {
            used += snprintf(comment + used, sizeof comment - (size_t)used, "\ndistance-torus %.17g", distance);
        }
        if (warp) {
            snprintf(comment + used, sizeof comment - (size_t)used, "\nwarp %s", warp->name);
            status = points->dim == 2 ? cli_map_points(warp, points) : KOKSMA_OK;
        }
    }
    if (!status) {
        make_way(arguments, work);
        status = (warp ? koksma_points_write_mapped : koksma_points_write)(cli_text(arguments, "output", "-"), points,
                                                                           comment, run);
    }
    return status ? cli_fail(arguments, status) : CLI_YES;
}

/* Generates and writes the points piece by piece, without the whole set in memory. */
static int stream(const cli_arguments *arguments, const cli_source *source, uint64_t first, uint64_t seed,
                  cli_work *work)
{
    make_way(arguments, work);
    char text[KOKSMA_MAX_SPEC], comment[KOKSMA_MAX_SPEC + 128];
    koksma_spec_text(&source->spec, text);
    const int used = snprintf(comment, sizeof comment, "pattern %s\nseed %llu", text, (unsigned long long)seed);
    if (first) {
        snprintf(comment + used, sizeof comment - (size_t)used, "\nfirst %llu", (unsigned long long)first);
    }
    const koksma_status status = koksma_generate_write(&source->spec, seed, first, source->n, source->dim,
                                                       cli_text(arguments, "output", "-"), comment, &work->run);
    return status ? cli_fail(arguments, status) : CLI_YES;
}

static int run(const cli_arguments *arguments)
{
    cli_source source;
    koksma_points points;
    cli_work work;
    uint64_t dim, seed, first;
    if (arguments->n_operands != 1) {
        char known[CLI_KNOWN];
        const char *n = cli_text(arguments, "n", "");
        const int is_number = arguments->n_operands < 2 || !isdigit((unsigned char)*arguments->operands[0]);
        return strchr(n, ',')
                   ? cli_usage_error(arguments, "-n %s: it takes one number of points, without commas", n)
                   : cli_usage_error(arguments, "it takes one pattern, such as n-rooks or poisson-disk:d=0.2%s",
                                     arguments->n_operands > 1
                                         ? cli_operand_hint(arguments, arguments->operands[is_number], known)
                                         : "");
    }
    int code = cli_pattern_open(arguments, arguments->operands[0], &source);
    if (code) {
        return code;
    }
    const koksma_pattern *pattern = source.spec.pattern;
    if (!source.n && !pattern->whole) {
        return cli_usage_error(arguments, "-n N, the number of points, is missing");
    }
    if (!cli_whole(arguments, "first", 0, 0, KOKSMA_MAX_INDEX, &first) ||
        !cli_whole(arguments, "dim", 2, 1, KOKSMA_MAX_DIM, &dim) ||
        !cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &seed) || !cli_work_begin(arguments, "generating", &work)) {
        return CLI_USAGE;
    }
    if (cli_flag(arguments, "seed") && koksma_has_one_set(&source.spec) && !cli_flag(arguments, "quiet")) {
        char text[KOKSMA_MAX_SPEC];
        koksma_spec_text(&source.spec, text);
        cli_warn_one_set(arguments, text);
    }
    dim = source.n ? (uint64_t)source.dim : dim;
    const char *name = cli_text(arguments, "warp", NULL);
    const koksma_warp *warp = name ? cli_find_warp(arguments, name) : NULL;
    if (name && (!warp || dim != 2)) {
        return warp ? cli_usage_error(arguments, "--warp maps points of 2 dimensions, not %d", (int)dim) : CLI_USAGE;
    }
    if (first && (name || !source.n)) {
        return cli_usage_error(arguments, "--first needs -n N and excludes --warp");
    }
    code = cli_try_output(arguments, cli_text(arguments, "output", "-"));
    if (code) {
        return code;
    }
    if (source.n && !warp && (first || koksma_has_ranges(&source.spec))) {
        code = stream(arguments, &source, first, seed, &work);
        cli_work_end();
        return code;
    }
    const bool given = cli_text(arguments, "dim", NULL) || !pattern->operand;
    points = (koksma_points){.dim = given ? (int)dim : 0};
    const koksma_status status = source.n ? koksma_points_init(&points, source.n, source.dim) : KOKSMA_OK;
    if (status) {
        return cli_fail(arguments, status);
    }
    code = generate(arguments, &source.spec, warp, seed, &work, &points);
    cli_work_end();
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
