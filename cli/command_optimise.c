/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma optimise`: searches for a point set with a small value of a measure, and writes the best set to a file
   after each improvement, or at the end to a stream, where sets would follow each other. */
#include <koksma/spectrum.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "rendering.h"
#include "source.h"

enum { MOST_PROJECTIONS = 4096 };

typedef struct job {
    const cli_args *args;
    const koksma_spec *measure;
    cli_work work;
    koksma_optimise_options options;
    koksma_status written; /* status of the last write of the set */
    uint64_t last_gain;
    double gained_s;
    uint64_t projections[MOST_PROJECTIONS];
    double weights[MOST_PROJECTIONS];
    double *power; /* --power: the target at each frequency; NULL: minimise a measure */
    double first;  /* the value of the initial set; NaN before it is measured */
    bool stream;   /* whether the set is written to a stream, once */
    char name[KOKSMA_MAX_SPEC], line[KOKSMA_MAX_SPEC + 128];
} job;

/* Writes the best set. A file is replaced as a whole, so that it always has a complete set, even if the program is
   killed while it writes. */
static koksma_status write_best(const job *j, const koksma_optimum *best)
{
    char comment[KOKSMA_MAX_SPEC + 256];
    const bool partial = best->last_gain > best->steps;
    snprintf(comment, sizeof comment, "optimised for %s\nvalue %.17g\nseed %llu\nsteps %llu%s\nkoksma %s", j->name,
             best->value, (unsigned long long)j->options.seed, (unsigned long long)best->last_gain,
             partial ? ", the last not completed: --steps does not give this set" : "", koksma_version());
    const char *path = cli_text(j->args, "output", NULL);
    return j->options.keep == KOKSMA_KEEP_SEQUENCE ? koksma_net_write(path, &best->points, comment)
                                                   : koksma_points_write(path, &best->points, comment, NULL);
}

static bool progress(void *context, const koksma_optimum *best)
{
    job *j = context;
    const double now_s = cli_seconds();
    if (j->first != j->first || best->last_gain > j->last_gain) {
        j->first = j->first != j->first ? best->value : j->first;
        j->last_gain = best->last_gain;
        j->gained_s = now_s;
        j->written = j->stream ? KOKSMA_OK : write_best(j, best);
    }
    char bound[48] = "";
    if (best->lower == best->lower) {
        snprintf(bound, sizeof bound, " (at least %.6g)", best->lower);
    }
    snprintf(j->line, sizeof j->line, "%s %.10g%s, last gain %.0f s ago, step %llu,", j->name, best->value, bound,
             now_s - j->gained_s, (unsigned long long)best->steps);
    const char *steps = cli_text(j->args, "steps", NULL);
    return !j->written && (!steps || best->steps < j->options.steps);
}

static int report(job *j, const koksma_optimum *best)
{
    cli_row("measure %s n %zu dim %d value %g", j->name, best->points.n, best->points.dim, best->value);
    if (j->options.keep >= KOKSMA_KEEP_SEQUENCE) {
        cli_row("first %g", j->first);
    }
    cli_row("lower %g method %s seed %llu steps %llu last_gain %llu version %s\n", best->lower, best->method,
            (unsigned long long)j->options.seed, (unsigned long long)best->steps, (unsigned long long)best->last_gain,
            koksma_version());
    return cli_rows_close(CLI_YES);
}

/* Whether a file has generator matrices, as --keep sequence writes them: it then is a pattern. `source` has the number
   of its points, or 0 where the file does not give it as a power of 2, and of its dimensions. */
static bool is_net(const char *path, cli_source *source)
{
    char line[256] = "";
    int numbers[3], n = 0;
    FILE *file = cli_is_stream(path) || strlen(path) >= sizeof source->spec.path ? NULL : fopen(path, "r");
    if (!file) {
        return false;
    }
    const bool is = fgets(line, sizeof line, file) && !strncmp(line, "# dnet", 6) && strchr("\r\n ", line[6]);
    while (is && n < 3 && fgets(line, sizeof line, file)) { /* the base, the dimensions, the columns */
        n += line[0] != '#' && sscanf(line, "%d", &numbers[n]) == 1;
    }
    fclose(file);
    *source = (cli_source){.is_pattern = true, .spec = {.pattern = koksma_pattern_find("net-file")}};
    memcpy(source->spec.path, path, strlen(path) + 1);
    if (n == 3) {
        source->n = numbers[0] == 2 && numbers[2] > 0 && numbers[2] < 63 ? (size_t)1 << numbers[2] : 0;
        source->dim = numbers[1];
        source->n = source->dim > 0 && source->n > KOKSMA_MAX_COORDINATES / (size_t)source->dim ? 0 : source->n;
    }
    return is;
}

/* Makes the initial set by a pattern, which may give the number of points and dimensions. Returns the exit code. */
static int generate_first(job *j, const cli_source *source, bool counted, koksma_points *from)
{
    const char *text = cli_text(j->args, "from", NULL);
    const bool dim_given = cli_text(j->args, "dim", NULL) != NULL;
    if (!source->n && !counted) {
        return cli_error(j->args, "-n N, the number of points, is missing");
    }
    if (source->n && ((counted && source->n != j->options.n) || (dim_given && source->dim != j->options.dim))) {
        return cli_error(j->args, "--from %s: its number of points or dimensions differs from -n or -d", text);
    }
    j->options.n = source->n ? source->n : j->options.n;
    j->options.dim = source->n ? source->dim : j->options.dim;
    koksma_status status = koksma_points_init(from, j->options.n, j->options.dim);
    status = status ? status : koksma_generate(&source->spec, j->options.seed, &j->work.run, from);
    return status ? cli_fail(j->args, status) : CLI_YES;
}

/* Reads --from: a file, or a pattern, which may give the number of points as @N. counted: whether -n gives
   that number. Returns the exit code. */
static int first_set(job *j, bool counted, koksma_points *from)
{
    const char *text = cli_text(j->args, "from", NULL);
    const bool dim_given = cli_text(j->args, "dim", NULL) != NULL;
    if (!text) {
        return CLI_YES;
    }
    j->options.first = from;
    const bool is_pattern = cli_source_is_pattern(text) || cli_names_pattern(text);
    cli_source source;
    if (is_pattern) {
        const int code = cli_pattern_open(j->args, text, &source);
        return code ? code : generate_first(j, &source, counted, from);
    }
    if (is_net(text, &source)) { /* its first N points in its first DIM dimensions */
        j->options.dim = dim_given || source.dim < 1 ? j->options.dim : source.dim;
        source.dim = j->options.dim;
        source.n = counted ? j->options.n : source.n;
        return generate_first(j, &source, counted, from);
    }
    const koksma_status status = koksma_points_read(text, from);
    if (status) {
        return cli_fail(j->args, status);
    }
    if ((counted && from->n != j->options.n) || (dim_given && from->dim != j->options.dim)) {
        return cli_error(j->args, "--from %s: it has %zu points of dim = %d, which differs from -n or -d", text,
                         from->n, from->dim);
    }
    j->options.n = from->n;
    j->options.dim = from->dim;
    return CLI_YES;
}

/* Reads --weights W,..: one weight for each projection. Returns false after an error. */
static bool parse_weights(job *j)
{
    const char *text = cli_text(j->args, "weights", NULL);
    if (!text) {
        return true;
    }
    const size_t n = cli_reals(text, DBL_MIN, DBL_MAX, j->weights, MOST_PROJECTIONS);
    j->options.weights = j->weights;
    if (!n) {
        return !cli_error(j->args, "--weights %s: it takes numbers above 0, such as 1,1,4", text);
    }
    if (!j->options.n_projections) {
        return cli_refuse(j->args, "weights", "has an effect only with --projections");
    }
    return n == j->options.n_projections ||
           !cli_error(j->args, "--weights %s: it takes one weight for each of the %zu --projections", text,
                      j->options.n_projections);
}

/* Returns false, after an error, if two projections are equal: one that counts twice has the weight 2. */
static bool check_different(const job *j, const char *text)
{
    for (size_t p = 1; p < j->options.n_projections; p++) {
        for (size_t q = 0; q < p; q++) {
            if (j->projections[p] == j->projections[q]) {
                return !cli_error(j->args, "--projections %s: groups %zu and %zu are equal", text, q + 1, p + 1);
            }
        }
    }
    return true;
}

/* Reads --projections, such as 0+1,2, as sets of coordinates; bit k of a set is coordinate k. Returns false after an
   error. */
static bool parse_projections(job *j)
{
    const char *text = cli_text(j->args, "projections", NULL), *at = text;
    koksma_optimise_options *o = &j->options;
    o->projections = j->projections;
    if (text && !strcmp(text, "pairs")) {
        if (o->dim < 2) {
            return !cli_error(j->args, "--projections pairs: it needs 2 or more dimensions, not %d", o->dim);
        }
        for (int k = 0; k < o->dim && k < 64; k++) {
            for (int l = 0; l < k; l++) {
                j->projections[o->n_projections++] = UINT64_C(1) << k | UINT64_C(1) << l;
            }
        }
        return true;
    }
    while (at && *at) {
        char *end;
        const unsigned long k = *at >= '0' && *at <= '9' ? strtoul(at, &end, 10) : 64;
        const bool one = k < 64 && (*end == '+' || *end == ',' || !*end) && (!*end || end[1]);
        if (!one || o->n_projections == MOST_PROJECTIONS) {
            return !cli_error(j->args, "--projections %s: it takes pairs, or coordinates from 0 on, such as 0+1,0+2",
                              text);
        }
        if (j->projections[o->n_projections] >> k & 1) {
            return !cli_error(j->args, "--projections %s: a group has coordinate %lu twice", text, k);
        }
        j->projections[o->n_projections] |= UINT64_C(1) << k;
        o->n_projections += *end != '+';
        at = *end ? end + 1 : end;
    }
    return check_different(j, text);
}

static bool parse(job *j)
{
    const cli_args *args = j->args;
    uint64_t n, dim;
    int keep = KOKSMA_KEEP_NONE; /* the option's argument lists them in the order of koksma_keep */
    if (!cli_choice(args, "keep", &keep) || !cli_whole(args, "n", 0, 1, KOKSMA_MAX_COORDINATES, &n) ||
        !cli_whole(args, "dim", 2, 1, KOKSMA_MAX_DIM, &dim) ||
        !cli_whole(args, "seed", 0, 0, UINT64_MAX, &j->options.seed) ||
        !cli_whole(args, "steps", 0, 0, UINT64_MAX, &j->options.steps) ||
        !cli_work_begin(args, "optimising", &j->work)) {
        return false;
    }
    j->options.n = n;
    j->options.dim = (int)dim;
    j->options.keep = (koksma_keep)keep;
    return cli_real(args, "time-limit", cli_text(args, "steps", NULL) ? 0 : 60, 0, 1e9, &j->work.run.time_limit_s);
}

/* Reads --power, whose frequencies end at --band times the root of the number of points. Returns the exit code. */
static int target(job *j)
{
    const char *text = cli_text(j->args, "power", NULL);
    double band;
    if (!cli_real(j->args, "band", 2, 0.1, 64, &band)) {
        return CLI_USAGE;
    }
    if (!text) {
        return cli_text(j->args, "band", NULL) ? cli_error(j->args, "--band has an effect only with --power")
                                               : CLI_YES;
    }
    j->options.rings = (int)ceil(fmin(band * sqrt((double)j->options.n), KOKSMA_SPECTRUM_MAX_HALF));
    j->power = malloc((size_t)j->options.rings * sizeof *j->power);
    j->options.power = j->power;
    if (!j->power) {
        return cli_no_memory();
    }
    const koksma_status status = koksma_radial_power(text, j->options.n, j->options.rings, &j->work.run, j->power);
    return status ? cli_fail(j->args, status) : CLI_YES;
}

/* Checks what the command line has. Returns false after an error. */
static bool check_arguments(const cli_args *args)
{
    const char *power = cli_text(args, "power", NULL), *output = cli_text(args, "output", NULL);
    if (args->n_operands != !power) {
        char known[CLI_KNOWN] = "";
        const bool more = !power && args->n_operands > 1;
        return !cli_error(args,
                          power ? "it takes a measure or --power, not both%s"
                                : "it takes one measure, such as star or l2-disk:r=0.25%s",
                          more ? cli_operand_hint(args, args->operands[1], known) : "");
    }
    if (!output) {
        return !cli_error(args, "-o FILE, the file for the best set, is missing");
    }
    const char *end = strrchr(output, '.');
    if (!strcmp(cli_text(args, "keep", "none"), "sequence") && end && cli_has_word(".npy .csv", end)) {
        return !cli_error(args, "-o %s: --keep sequence writes generator matrices, for net-file:FILE, as .txt only",
                          output);
    }
    if (cli_flag(args, "json") && cli_is_stdout(output)) {
        return !cli_error(args, "--json: it excludes -o %s, which writes the points to standard output", output);
    }
    return true;
}

static int run(const cli_args *args)
{
    koksma_spec measure;
    koksma_points from = {0};
    koksma_optimum best = {0};
    job j = {.args = args, .measure = &measure, .first = NAN, .options = {.progress = progress, .context = &j}};
    const char *power = cli_text(args, "power", NULL), *output = cli_text(args, "output", NULL);
    if (!check_arguments(args)) {
        return CLI_USAGE;
    }
    j.stream = cli_is_stream(output);
    koksma_status status = power ? KOKSMA_OK : koksma_measure_spec(args->operands[0], &measure);
    if (status) {
        return cli_fail(args, status);
    }
    const bool counted = cli_text(args, "n", NULL), given = cli_text(args, "from", NULL);
    if (!counted && !given) {
        return cli_error(args, "-n N, the number of points, is missing");
    }
    if (power) {
        snprintf(j.name, sizeof j.name, "power %s", power);
    } else {
        koksma_spec_text(&measure, j.name);
    }
    if (!parse(&j)) {
        return CLI_USAGE;
    }
    int code = first_set(&j, counted, &from);
    code = code || (parse_projections(&j) && parse_weights(&j)) ? code : CLI_USAGE;
    code = code ? code : target(&j);
    if (!code) {
        j.work.what = j.line;
        j.gained_s = cli_seconds();
        status = koksma_optimise(power ? NULL : &measure, &j.options, &j.work.run, &best);
        cli_work_end();
        j.last_gain = best.last_gain;
        j.written = j.stream && best.points.n && !j.written ? write_best(&j, &best) : j.written;
        status = j.written ? j.written : status;
        if (best.points.n && !j.written && !cli_is_stdout(output)) {
            code = report(&j, &best);
        }
        code = status ? cli_fail(args, status) : code;
    }
    koksma_optimum_fini(&best);
    koksma_points_fini(&from);
    free(j.power);
    return code;
}

static const cli_option options[] = {
    {'n', "n", "N", "number of points (may be left out with --from FILE)"},
    {'d', "dim", "DIM", "number of dimensions (default: 2)"},
    {0, "from", "FILE", "the initial set: a file, PATTERN or SPEC@N (default: the best that a listed pattern makes)"},
    {0, "keep", "none|latin|net|sequence|every-prefix",
     "a structure of the initial set that the search preserves (default: none)"},
    {0, "projections", "0+1,0+2,..|pairs",
     "groups of coordinates that are measured separately (default: one group of all coordinates)"},
    {0, "weights", "W,..",
     "weights of the projections in the root mean square of their values, 1e-100 to 1e100 (default: 1)"},
    {0, "steps", "K",
     "number of steps, of eight searches each; equal --seed and --steps give equal sets; 0: the initial set"},
    {0, "time-limit", "SECONDS",
     "time limit in seconds, which ends the search within a step; the first set may take ten times as long; 0: no "
     "limit (default: 60; with --steps: 0)"},
    {'s', "seed", "S", "seed of the search, and of --from PATTERN (default: 0)"},
    {'o', "output", "FILE.txt|.csv|.npy",
     "the best set; a file is rewritten after each gain, -, a pipe or a device gets only the last set"},
    {0, "power", "step|gaussian|PATTERN|FILE",
     "instead of MEASURE: a target for the radial mean of the power spectrum of 2D points"},
    {0, "band", "B", "with --power: frequencies up to B sqrt(n) (default: 2)"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_optimise = {
    .name = "optimise",
    .summary = "search for points with a small value of a measure",
    .synopsis = "MEASURE -n N [-d DIM] [--from FILE] [--keep WHAT] [--projections LIST] [--steps K] -o FILE | "
                "--power TARGET -n N [--band B] -o FILE",
    .details =
        "MEASURE is any measure with exact values, such as star or l2-disk:law=area; the search maximises "
        "distances and minimises all other measures. Equal arguments with --steps give equal sets, on any number "
        "of threads. In a step eight searches start from the best set, and the best of their results is taken. "
        "Each is a fixed amount of work, which grows with n and DIM: on one thread a step takes from tenths of a "
        "second to many minutes. If a time limit or Ctrl-C ends the search, the best set of the step in progress "
        "counts, too. The printed row has the number of steps that were completed; --steps with this number gives "
        "the same set, unless last_gain is larger: then the set is of the step that was not completed. FILE holds "
        "the best set of this search from when the initial set is measured: after Ctrl-C (exit code 130) or a "
        "kill, --from FILE continues it. A search without --from FILE begins anew, and its first set replaces "
        "FILE. A stream (-, a pipe, a device) gets the best set once, at the end or after Ctrl-C. With -o - the "
        "table is not printed; comments above the points have the value, the seed and the steps.\n"
        "\n"
        "Without --from the search starts from the best set of the listed patterns by this measure: no result is "
        "worse than a pattern, record included. With a time limit random patterns get an eighth of it.\n"
        "\n"
        "--keep latin permutes the coordinates on each axis; --keep net moves each coordinate only within its "
        "interval of length 1/n. --keep sequence changes the generator matrices of a digital sequence in base 2; "
        "the value is then the geometric mean of the measure over the first 2, 4, .., n points. FILE.txt has the "
        "matrices, which --from FILE.txt and the pattern net-file:FILE.txt read. --keep every-prefix keeps no "
        "structure, and minimises the geometric mean over the first 8, 9, .., n points: a sequence for any number of "
        "points, as the pattern every-n is.\n"
        "\n"
        "--power minimises the root mean square difference between the power spectrum and a target, over the plane "
        "of frequencies f. The target step is 0 for f below sqrt(n / pi) and 1 above, gaussian is 1 - exp(-pi f^2 "
        "/ n), and PATTERN is the mean spectrum of 16 of its sets. Each line of FILE has a frequency, in units of "
        "sqrt(n), and a power of 0 to 1e100. The search starts from gaussian-blue-noise.",
    .examples = "koksma optimise star -n 64 --time-limit 60 -o best.txt\n"
                "koksma optimise star -n 64 --from best.txt --time-limit 60 -o best.txt\n"
                "koksma optimise l2-centered -n 50 -d 5 --keep latin --steps 4 -o design.csv\n"
                "koksma optimise star -n 256 --keep sequence --steps 4 -o net.txt\n"
                "koksma optimise l2-star -n 64 -d 3 --keep every-prefix -o any.txt\n"
                "koksma optimise --power step -n 256 --steps 2 -o step.txt\n",
    .options = options,
    .run = run,
};
