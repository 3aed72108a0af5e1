/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma mask`: arranges a mask for a filter and writes it with a recipe, FILE.json, that makes it again;
   `koksma mask check` measures masks in files, whoever made them. */
#include <koksma/maskfile.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

enum { PATH = 4096, MOST_RINGS = 1024 };

static const char six[] = "binomial:size=3,binomial:size=4,box:size=3,box:size=5,gaussian:sigma=0.7,gaussian:sigma=1";

typedef struct job {
    const cli_arguments *arguments;
    const char *output, *filter, *from; /* from: the file of the first arrangement, or NULL */
    char recipe[PATH];                  /* path of the recipe beside the output */
    koksma_mask_options options;
    koksma_mask mask;  /* the mask that is made */
    koksma_mask first; /* that of `from` */
    koksma_mask_result result;
    uint64_t bits;
    cli_work work;
} job;

static const char *space_name(const void *table, size_t i)
{
    (void)table;
    return koksma_mask_space_at(i) ? koksma_mask_space_at(i)->name : NULL;
}

/* Reads --space. Returns false after an error. */
static bool parse_space(const cli_arguments *arguments, const koksma_mask_space **space)
{
    const char *name = cli_text(arguments, "space", NULL);
    char meant[96];
    *space = name ? koksma_mask_space_find(name) : NULL;
    if (name && !*space) {
        cli_usage_error(arguments,
                        "--space %s: %sit takes scalar, tent, gaussian, vector2 to vector4, disk, circle, "
                        "sphere or hemisphere",
                        name, cli_meant(name, space_name, NULL, meant));
    }
    return !name || *space;
}

/* Makes the path of the recipe beside a mask. Returns false after an error. */
static bool recipe_of(const cli_arguments *arguments, const char *path, char recipe[PATH])
{
    const int length = snprintf(recipe, PATH, "%s.json", path);
    if (length >= PATH) {
        cli_usage_error(arguments, "the path is longer than %d bytes", PATH - 6);
    }
    return length < PATH;
}

/* Returns false, after an error, if an option is given that the other one decides. */
static bool check_alone(const cli_arguments *arguments, const char *decides, const char *const *names)
{
    for (; cli_text(arguments, decides, NULL) && *names; names++) {
        if (cli_text(arguments, *names, NULL)) {
            cli_usage_error(arguments, "--%s has no effect with --%s", *names, decides);
            return false;
        }
    }
    return true;
}

/* Reads the options of a new mask. Returns the exit code. */
static int parse_new(job *j)
{
    koksma_mask_options *o = &j->options;
    uint64_t levels;
    o->width = o->height = 128;
    if (!parse_space(j->arguments, &o->space) || !cli_size(j->arguments, &o->width, &o->height) ||
        !cli_whole(j->arguments, "levels", 0, 2, KOKSMA_MASK_MAX * KOKSMA_MASK_MAX, &levels) ||
        !cli_whole(j->arguments, "seed", 0, 0, UINT64_MAX, &o->seed) ||
        !cli_real(j->arguments, "swaps", 4000, 0, 1e6, &o->swaps) ||
        !cli_real(j->arguments, "until", 0, 0, 1e100, &o->target)) {
        return CLI_USAGE;
    }
    o->open = cli_flag(j->arguments, "open");
    o->levels = (int)levels;
    koksma_status status = koksma_mask_filter_parse(j->filter, &o->filter);
    if (!status && j->from) {
        status = koksma_mask_read(j->from, o->space, &j->first);
        if (!status && cli_text(j->arguments, "size", NULL) &&
            (j->first.width != o->width || j->first.height != o->height)) {
            return cli_usage_error(j->arguments, "--from %s: its size is %d x %d; --size may be left out", j->from,
                                   j->first.width, j->first.height);
        }
        o->width = j->first.width;
        o->height = j->first.height;
        o->space = j->first.space;
        o->from = j->first.values;
    }
    return status ? cli_fail(j->arguments, status) : CLI_YES;
}

/* Reads the mask of --resume and its recipe. Returns the exit code. */
static int parse_resumed(job *j)
{
    const char *path = cli_text(j->arguments, "resume", NULL);
    char recipe[PATH];
    if (!recipe_of(j->arguments, path, recipe)) {
        return CLI_USAGE;
    }
    koksma_status status = koksma_mask_read_recipe(recipe, &j->options);
    status = status ? status : koksma_mask_read(path, j->options.space, &j->first);
    if (!status && (j->first.width != j->options.width || j->first.height != j->options.height)) {
        return cli_usage_error(j->arguments, "--resume %s: its size is %d x %d, and %d x %d in its recipe", path,
                               j->first.width, j->first.height, j->options.width, j->options.height);
    }
    j->options.levels = 0; /* those of the values that were read */
    j->options.from = j->first.values;
    return status ? cli_fail(j->arguments, status) : CLI_YES;
}

static int report(const job *j, const koksma_mask_quality *q)
{
    cli_rows *rows = cli_rows_open(cli_flag(j->arguments, "json"));
    cli_row_text(rows, "output", j->output);
    cli_row_whole(rows, "width", (uint64_t)j->mask.width);
    cli_row_whole(rows, "height", (uint64_t)j->mask.height);
    cli_row_text(rows, "space", j->mask.space->name);
    cli_row_text(rows, "filter", j->filter);
    cli_row_number(rows, "error", q->error);
    cli_row_number(rows, "white", q->white);
    cli_row_number(rows, "ratio", q->error / q->white);
    cli_row_whole(rows, "swaps", j->result.done);
    cli_row_flag(rows, "finished", j->result.finished);
    cli_row_end(rows);
    return cli_rows_close(rows);
}

static int tests_of(const koksma_mask_space *space)
{
    return space->dim == 1 ? 256 : 400;
}

/* Makes, writes and measures the mask. Returns the exit code. */
static int make(job *j)
{
    const size_t count = (size_t)j->options.width * (size_t)j->options.height * (size_t)j->options.space->dim;
    j->mask = (koksma_mask){j->options.width, j->options.height, j->options.space, malloc(count * sizeof(float))};
    if (!j->mask.values) {
        return cli_no_memory();
    }
    koksma_mask_quality q;
    koksma_status status = koksma_mask_optimise(&j->options, &j->work.run, j->mask.values, &j->result);
    cli_work_end();
    status = status ? status : koksma_mask_write(j->output, &j->mask, (int)j->bits);
    status = status ? status
                    : koksma_mask_write_recipe(j->recipe, &j->options, strcmp(j->filter, "-") ? j->filter : NULL,
                                               j->from, &j->result);
    j->work.run.time_limit_s = 0;
    status = status ? status
                    : koksma_mask_measure(j->mask.width, j->mask.height, j->mask.space, j->mask.values,
                                          &j->options.filter, tests_of(j->mask.space), &j->work.run, &q);
    return status ? cli_fail(j->arguments, status) : report(j, &q);
}

static int run_make(const cli_arguments *arguments)
{
    static const char *const decided[] = {"filter", "size",  "space", "open", "levels",
                                          "swaps",  "until", "seed",  "from", NULL};
    static const char *const of_check[] = {"tests", "rings"};
    job j = {.arguments = arguments,
             .output = cli_text(arguments, "output", cli_text(arguments, "resume", NULL)),
             .filter = cli_text(arguments, "filter", "gaussian:sigma=1"),
             .from = cli_text(arguments, "from", NULL)};
    if (arguments->n_operands) {
        return cli_usage_error(arguments, "%s: it takes 'check' and files, or options alone", arguments->operands[0]);
    }
    for (size_t i = 0; i < 2; i++) {
        if (cli_text(arguments, of_check[i], NULL)) {
            return cli_usage_error(arguments, "--%s is of 'koksma mask check'", of_check[i]);
        }
    }
    if (!j.output) {
        return cli_usage_error(arguments, "-o FILE, the file for the mask, is missing");
    }
    if (!check_alone(arguments, "resume", decided) || !recipe_of(arguments, j.output, j.recipe) ||
        !cli_whole(arguments, "bits", 0, 8, 32, &j.bits) || !cli_work_begin(arguments, "arranging", &j.work) ||
        !cli_real(arguments, "time-limit", 0, 0, 1e9, &j.work.run.time_limit_s)) {
        return CLI_USAGE;
    }
    const bool resumed = cli_text(arguments, "resume", NULL) != NULL;
    j.filter = resumed ? "-" : j.filter;
    int code = resumed ? parse_resumed(&j) : parse_new(&j);
    j.options.space = j.options.space ? j.options.space : koksma_mask_space_at(0);
    const koksma_status status = code ? KOKSMA_OK : koksma_mask_check_path(j.output, j.options.space, (int)j.bits);
    code = status ? cli_fail(arguments, status) : code;
    code = code ? code : cli_try_output(arguments, j.output);
    code = code ? code : make(&j);
    koksma_mask_fini(&j.mask);
    koksma_mask_fini(&j.first);
    return code;
}

/* ---- check ----------------------------------------------------------------------------------------------- */

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return x < y ? -1 : x > y;
}

/* Prints the number of different values of a mask of one number, and how often the rarest and the most frequent one
   occurs. Returns false without memory. */
static bool put_histogram(cli_rows *rows, const koksma_mask *mask)
{
    const size_t n = (size_t)mask->width * (size_t)mask->height;
    float *sorted = malloc(n * sizeof *sorted);
    if (!sorted) {
        return false;
    }
    memcpy(sorted, mask->values, n * sizeof *sorted);
    qsort(sorted, n, sizeof *sorted, ascending);
    size_t levels = 0, least = n, most = 0;
    for (size_t i = 0, next; i < n; i = next) {
        for (next = i + 1; next < n && !(sorted[i] < sorted[next]); next++) {
        }
        levels++;
        least = next - i < least ? next - i : least;
        most = next - i > most ? next - i : most;
    }
    free(sorted);
    cli_row_whole(rows, "levels", levels);
    cli_row_whole(rows, "least_often", least);
    cli_row_whole(rows, "most_often", most);
    return true;
}

static int put_quality(cli_rows *rows, const char *path, const koksma_mask *mask, const char *filter,
                       const koksma_mask_quality *q)
{
    cli_row_text(rows, "file", path);
    cli_row_whole(rows, "width", (uint64_t)mask->width);
    cli_row_whole(rows, "height", (uint64_t)mask->height);
    cli_row_text(rows, "space", mask->space->name);
    cli_row_text(rows, "filter", filter);
    cli_row_number(rows, "error", q->error);
    cli_row_number(rows, "white", q->white);
    cli_row_number(rows, "ratio", q->error / q->white);
    cli_row_number(rows, "inside", q->inside);
    cli_row_number(rows, "seam", q->seam);
    const bool ok = mask->space->dim > 1 || put_histogram(rows, mask);
    cli_row_end(rows);
    return ok ? CLI_YES : cli_no_memory();
}

/* Prints a row for each ring of the spectrum. */
static int put_rings(const cli_arguments *arguments, cli_rows *rows, const char *path, const koksma_mask *mask,
                     int rings)
{
    double power[MOST_RINGS], anisotropy[MOST_RINGS];
    const koksma_status status = koksma_mask_rings(mask, rings, power, anisotropy);
    for (int r = 0; r < rings && !status; r++) {
        cli_row_text(rows, "file", path);
        cli_row_number(rows, "frequency", (r + 0.5) / (2 * rings));
        cli_row_number(rows, "power", power[r]);
        cli_row_number(rows, "anisotropy_db", anisotropy[r]);
        cli_row_end(rows);
    }
    return status ? cli_fail(arguments, status) : CLI_YES;
}

/* Measures a mask with each filter. */
static int put_filters(const cli_arguments *arguments, cli_rows *rows, const char *path, const koksma_mask *mask,
                       const koksma_run *run)
{
    const char *list = cli_text(arguments, "filter", six);
    char text[KOKSMA_MAX_SPEC];
    uint64_t tests;
    int code = CLI_YES;
    if (!cli_whole(arguments, "tests", (uint64_t)tests_of(mask->space), 1, 65536, &tests)) {
        return CLI_USAGE;
    }
    for (size_t i = 0; !code && cli_list_item(list, i, text, sizeof text); i++) {
        koksma_mask_filter filter;
        koksma_mask_quality q;
        koksma_status status = koksma_mask_filter_parse(text, &filter);
        status = status ? status
                        : koksma_mask_measure(mask->width, mask->height, mask->space, mask->values, &filter,
                                              (int)tests, run, &q);
        code = status ? cli_fail(arguments, status) : put_quality(rows, path, mask, text, &q);
    }
    return code;
}

static int run_check(const cli_arguments *arguments)
{
    static const char *const of_make[] = {"output", "size", "open",   "levels", "swaps",      "until",
                                          "seed",   "from", "resume", "bits",   "time-limit", NULL};
    const koksma_mask_space *space;
    cli_work work;
    uint64_t rings;
    for (const char *const *name = of_make; *name; name++) {
        if (cli_text(arguments, *name, NULL)) {
            return cli_usage_error(arguments, "--%s has no effect on 'check'", *name);
        }
    }
    if (arguments->n_operands < 2) {
        return cli_usage_error(arguments, "check: it takes one mask or more");
    }
    if (!parse_space(arguments, &space) || !cli_whole(arguments, "rings", 0, 1, MOST_RINGS, &rings) ||
        !cli_work_begin(arguments, "measuring", &work)) {
        return CLI_USAGE;
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    int code = CLI_YES;
    for (int i = 1; i < arguments->n_operands && !code; i++) {
        koksma_mask mask;
        const koksma_status status = koksma_mask_read(arguments->operands[i], space, &mask);
        cli_work_part(&work, (size_t)i - 1, (size_t)arguments->n_operands - 1);
        code = status  ? cli_fail(arguments, status)
               : rings ? put_rings(arguments, rows, arguments->operands[i], &mask, (int)rings)
                       : put_filters(arguments, rows, arguments->operands[i], &mask, &work.run);
        koksma_mask_fini(&mask);
    }
    cli_work_end();
    const int rows_code = cli_rows_close(rows);
    return code ? code : rows_code;
}

static int run(const cli_arguments *arguments)
{
    const bool check = arguments->n_operands && !strcmp(arguments->operands[0], "check");
    return check ? run_check(arguments) : run_make(arguments);
}

static const cli_option options[] = {
    {'o', "output", "FILE.png|.exr|.npy|.raw|.h", "the mask; FILE.json beside it has what makes it again"},
    {'f', "filter", "FILTER",
     "the filter that will be applied: box:size=K, binomial:size=K, gaussian:sigma=S, one of 'koksma list "
     "filters', or file:PATH, rows of numbers (default: gaussian:sigma=1); check: a list (default: six common "
     "ones)"},
    {0, "size", "WxH", "size in pixels, 4 to 1024 a side (default: 128x128)"},
    {0, "space", "scalar|tent|gaussian|vector2|vector3|vector4|disk|circle|sphere|hemisphere",
     "the numbers of a pixel (default: scalar; check and --from: by the file's channels)"},
    {0, "open", NULL, "the mask has borders (default: a tile that repeats)"},
    {0, "levels", "L", "scalars: L different values, each equally often (default: as many as pixels)"},
    {0, "swaps", "K", "proposed swaps a pixel (default: 4000); more give a smaller error"},
    {0, "until", "E", "end once the error is at most E"},
    {0, "time-limit", "SECONDS", "end the search and write the mask; --resume continues it; 0: no limit (default)"},
    {'s', "seed", "S", "seed (default: 0)"},
    {0, "from", "FILE", "rearrange the values of this mask; the result is never worse"},
    {0, "resume", "FILE.npy|.exr", "continue the search that made this mask, by its FILE.json; -o: the same file"},
    {0, "bits", "8|16|32", "bits of a number: .png 16 or 8, .raw 8, 16 or 32 (float), .h 32, 8 or 16"},
    {0, "tests", "N", "check: thresholds or half-spaces (default: 256, 400)"},
    {0, "rings", "N", "check: print the power spectrum in N rings instead of errors"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_mask = {
    .name = "mask",
    .summary = "make blue-noise masks for a filter, and measure masks",
    .synopsis = "-o FILE [--filter FILTER] [--size WxH] [--space SPACE] [--swaps K]\n"
                "--resume FILE [-o FILE] [--time-limit SECONDS]\n"
                "check FILE... [--filter FILTER,..] [--space SPACE] [--tests N] [--rings N]",
    .details =
        "A mask has a number, a vector or a direction for each pixel of a tile. Noise that is made with it, "
        "such as one random number a pixel, nearly vanishes under the filter. The search swaps pixels by "
        "simulated annealing, and minimises the variance of the filtered image of (value < t) over all "
        "thresholds t, of vectors over all half-spaces, exactly and without sampling.\n"
        "error: the root of this variance, for 256 thresholds or 400 fixed half-spaces. white: the same for "
        "values in random order. ratio: error / white. inside and seam (check): the error of pixels whose "
        "filter lies within the mask, and of those whose filter spans two opposite sides; a tile repeats "
        "without a visible seam if they are equal. levels, least_often and most_often: the histogram of a mask "
        "of one number. --rings: the mean power at each frequency, 1 for white noise, and its anisotropy.\n"
        "Equal options give equal bits on every machine and with any number of threads (the search uses one). "
        "A mask with borders (--open) has the error that the filter leaves if all beyond is exact.\n",
    .examples = "koksma mask -o m.png --filter gaussian:sigma=1 --size 64x64\n"
                "koksma mask -o v.npy -f box:size=3 --size 32x48 --space vector2\n"
                "koksma mask check m.png\n"
                "koksma mask check m.png --rings 16\n",
    .options = options,
    .run = run,
};
