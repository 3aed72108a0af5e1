/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma mask`: arranges a mask for a filter and writes it with a recipe, FILE.json, that makes it again;
   `koksma mask check` measures masks in files, whoever made them. */
#include <koksma/maskfile.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

enum { PATH = 4096, MOST_RINGS = 1024, MOST_BINS = 4096, TABLES = 3 };

static const char six[] = "binomial:size=3,binomial:size=4,box:size=3,box:size=5,gaussian:sigma=0.7,gaussian:sigma=1";

typedef struct job {
    const cli_args *args;
    const char *output;
    char path[PATH]; /* of the recipe beside the output */
    koksma_mask_recipe recipe;
    koksma_mask mask;  /* the mask that is made */
    koksma_mask first; /* that of --from or --resume */
    uint64_t bits;
    cli_work work;
} job;

/* Reads --space, whose argument lists them in the order of their table; NULL without it. Returns false after an error. */
static bool parse_space(const cli_args *args, const koksma_mask_space **space)
{
    int choice = -1;
    const bool good = cli_choice(args, "space", &choice);
    *space = choice < 0 ? NULL : koksma_mask_space_at((size_t)choice);
    return good;
}

/* Makes the path of the recipe beside a mask. Returns false after an error. */
static bool recipe_of(const cli_args *args, const char *path, char recipe[PATH])
{
    const int length = snprintf(recipe, PATH, "%s.json", path);
    if (length >= PATH) {
        cli_error(args, "the path is longer than %d bytes", PATH - 6);
    }
    return length < PATH;
}

/* Reads the options of a new mask. Returns the exit code. */
static int parse_new(job *j)
{
    koksma_mask_options *o = &j->recipe.options;
    const char *from = cli_text(j->args, "from", "");
    uint64_t levels;
    o->width = o->height = 128;
    if (!parse_space(j->args, &o->space) || !cli_size(j->args, &o->width, &o->height) ||
        !cli_whole(j->args, "levels", 0, 2, KOKSMA_MASK_MAX * KOKSMA_MASK_MAX, &levels) ||
        !cli_whole(j->args, "seed", 0, 0, UINT64_MAX, &o->seed) ||
        !cli_real(j->args, "swaps", 4000, 0, 1e6, &o->swaps) ||
        !cli_real(j->args, "until", 0, 0, 1e100, &o->target)) {
        return CLI_USAGE;
    }
    o->open = cli_flag(j->args, "open");
    o->levels = (int)levels;
    snprintf(j->recipe.filter, KOKSMA_MASK_MAX_TEXT, "%s", cli_text(j->args, "filter", "gaussian:sigma=1"));
    snprintf(j->recipe.from, KOKSMA_MASK_MAX_TEXT, "%s", from);
    if (!strcmp(j->recipe.filter, "gaussian")) {
        cli_note(j->args,
                 "note: gaussian is the pixel filter; gaussian:sigma=1, in pixels, is the filter of most masks");
    }
    koksma_status status = koksma_mask_filter_parse(j->recipe.filter, &o->filter);
    if (!status && *from) {
        status = koksma_mask_read(from, o->space, &j->first);
        if (!status && cli_text(j->args, "size", NULL) &&
            (j->first.width != o->width || j->first.height != o->height)) {
            return cli_error(j->args, "--from %s: its size is %d x %d; --size may be left out", from, j->first.width,
                             j->first.height);
        }
        o->width = j->first.width;
        o->height = j->first.height;
        o->space = j->first.space;
        o->from = j->first.values;
    }
    return status ? cli_fail(j->args, status) : CLI_YES;
}

/* Reads the mask of --resume and its recipe. Returns the exit code. */
static int parse_resumed(job *j)
{
    const char *path = cli_text(j->args, "resume", NULL);
    char recipe[PATH];
    koksma_mask_options *o = &j->recipe.options;
    if (!recipe_of(j->args, path, recipe)) {
        return CLI_USAGE;
    }
    koksma_status status = koksma_mask_read_recipe(recipe, &j->recipe);
    status = status ? status : koksma_mask_read(path, o->space, &j->first);
    if (!status && (j->first.width != o->width || j->first.height != o->height)) {
        return cli_error(j->args, "--resume %s: its size is %d x %d, and %d x %d in its recipe", path, j->first.width,
                         j->first.height, o->width, o->height);
    }
    o->from = j->first.values;
    return status ? cli_fail(j->args, status) : CLI_YES;
}

static int report(const job *j, const koksma_mask_quality *q)
{
    cli_row("output %s width %d height %d space %s filter %s error %g white %g ratio %g "
            "swaps %llu finished? %d\n",
            j->output, j->mask.width, j->mask.height, j->mask.space->name, *j->recipe.filter ? j->recipe.filter : "-",
            q->error, q->white, q->error / q->white, (unsigned long long)j->recipe.result.done,
            j->recipe.result.finished);
    return cli_rows_close(CLI_YES);
}

static int tests_of(const koksma_mask_space *space)
{
    return space->dim == 1 ? 256 : 400;
}

/* Makes, writes and measures the mask. Returns the exit code. */
static int make(job *j)
{
    koksma_mask_options *o = &j->recipe.options;
    const size_t pixels = (size_t)o->width * (size_t)o->height;
    j->mask = (koksma_mask){o->width, o->height, o->space, malloc(pixels * (size_t)o->space->dim * sizeof(float))};
    o->state = o->done ? o->state : calloc(pixels, sizeof *o->state);
    if (!j->mask.values || (!o->done && !o->state)) {
        return cli_no_memory();
    }
    koksma_mask_quality q;
    koksma_status status = koksma_mask_optimise(o, &j->work.run, j->mask.values, &j->recipe.result);
    cli_work_end();
    status = status ? status : koksma_mask_write(j->output, &j->mask, (int)j->bits);
    status = status ? status : koksma_mask_write_recipe(j->path, &j->recipe);
    j->work.run.time_limit_s = 0;
    status = status ? status
                    : koksma_mask_measure(j->mask.width, j->mask.height, j->mask.space, j->mask.values, &o->filter,
                                          tests_of(j->mask.space), &j->work.run, &q);
    return status ? cli_fail(j->args, status) : report(j, &q);
}

static int run_make(const cli_args *args)
{
    job j = {.args = args, .output = cli_text(args, "output", cli_text(args, "resume", NULL))};
    koksma_mask_options *o = &j.recipe.options;
    if (args->n_operands) {
        return cli_error(args, "%s: it takes 'check' and files, or options alone", args->operands[0]);
    }
    if (!cli_refuse(args, "tests rings histogram correlation", "is of 'koksma mask check'")) {
        return CLI_USAGE;
    }
    if (!j.output) {
        return cli_error(args, "-o FILE, the file for the mask, is missing");
    }
    const bool resumed = cli_text(args, "resume", NULL) != NULL;
    if ((resumed &&
         !cli_refuse(args, "filter size space open levels swaps until seed from", "has no effect with --resume")) ||
        !recipe_of(args, j.output, j.path) || !cli_whole(args, "bits", 0, 8, 32, &j.bits) ||
        !cli_work_begin(args, "arranging", &j.work) ||
        !cli_real(args, "time-limit", 0, 0, 1e9, &j.work.run.time_limit_s)) {
        return CLI_USAGE;
    }
    int code = resumed ? parse_resumed(&j) : parse_new(&j);
    o->space = o->space ? o->space : koksma_mask_space_at(0);
    const koksma_status status = code ? KOKSMA_OK : koksma_mask_check_path(j.output, o->space, (int)j.bits);
    code = status ? cli_fail(args, status) : code;
    code = code ? code : cli_try_output(args, j.output);
    code = code ? code : make(&j);
    koksma_mask_fini(&j.mask);
    koksma_mask_fini(&j.first);
    koksma_mask_recipe_fini(&j.recipe);
    return code;
}

/* ---- check ----------------------------------------------------------------------------------------------- */

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return x < y ? -1 : x > y;
}

/* Prints the number of different values of a mask of one number, and how often the rarest and the most frequent one
   occurs; with a warning to stderr, if they are not equally often. warn: the file's name; NULL: no warning. Returns false
   without memory. */
static bool put_histogram(const koksma_mask *mask, const char *warn)
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
    /* One more where the levels of a picture do not divide the pixels; levels of a distribution are not equally often. */
    if (warn && mask->space->low >= 0 && most > least + 1) {
        cli_say("mask",
                "%s: warning: no permutation: some numbers occur %zu times, others %zu, so that a threshold keeps no "
                "exact share of the pixels; --from makes a mask of these numbers",
                warn, least, most);
    }
    cli_row("levels %zu least_often %zu most_often %zu", levels, least, most);
    return true;
}

static int put_quality(const char *path, const koksma_mask *mask, const char *filter, const koksma_mask_quality *q,
                       bool warn)
{
    cli_row("file %s width %d height %d space %s filter %s error %g white %g ratio %g inside %g "
            "seam %g",
            path, mask->width, mask->height, mask->space->name, filter, q->error, q->white, q->error / q->white,
            q->inside, q->seam);
    const bool ok = mask->space->dim > 1 || put_histogram(mask, warn ? path : NULL);
    cli_row_end();
    return ok ? CLI_YES : cli_no_memory();
}

/* Prints a row for each ring of the spectrum. */
static int put_rings(const cli_args *args, const char *path, const koksma_mask *mask, int rings)
{
    double power[MOST_RINGS], anisotropy[MOST_RINGS];
    const koksma_status status = koksma_mask_rings(mask, rings, power, anisotropy);
    for (int r = 0; r < rings && !status; r++) {
        cli_row("file %s frequency %g power %g anisotropy_db %g\n", path, (r + 0.5) / (2 * rings), power[r],
                anisotropy[r]);
    }
    return status ? cli_fail(args, status) : CLI_YES;
}

/* Prints a row for each number and interval of the histogram. */
static int put_bins(const cli_args *args, const char *path, const koksma_mask *mask, int bins)
{
    const koksma_mask_space *space = mask->space;
    const size_t count = (size_t)space->dim * (size_t)bins;
    size_t *counts = malloc(count * sizeof *counts);
    if (!counts) {
        return cli_no_memory();
    }
    const koksma_status status = koksma_mask_histogram(mask, bins, counts);
    for (size_t i = 0; i < count && !status; i++) {
        const double from = (double)(i % (size_t)bins) / bins;
        cli_row("file %s number %zu from %g pixels %zu\n", path, i / (size_t)bins,
                space->low + from * (space->high - space->low), counts[i]);
    }
    free(counts);
    return status ? cli_fail(args, status) : CLI_YES;
}

/* Prints the correlations of two masks, or of one with itself, at the offsets up to `reach` along each axis. */
static int put_offsets(const cli_args *args, const char *const paths[2], const koksma_mask *const masks[2], int reach)
{
    const int width = masks[0]->width, height = masks[0]->height;
    double *all = malloc((size_t)width * (size_t)height * sizeof *all);
    if (!all) {
        return cli_no_memory();
    }
    const koksma_status status = koksma_mask_correlation(masks[0], masks[1], all);
    const int across = reach < (width - 1) / 2 ? reach : (width - 1) / 2;
    const int down = reach < (height - 1) / 2 ? reach : (height - 1) / 2;
    for (int y = -down; y <= down && !status; y++) {
        for (int x = -across; x <= across; x++) {
            cli_row("file %s with %s dx %d dy %d correlation %g\n", paths[0], paths[1], x, y,
                    all[(y + height) % height * width + (x + width) % width]);
        }
    }
    free(all);
    return status ? cli_fail(args, status) : CLI_YES;
}

/* Says so if the first number of each pixel, as a mask of its own, is better than the whole: the four masks of an RGBA
   picture. */
static void tell_channels(const char *path, const koksma_mask *mask, const koksma_mask_filter *filter, double ratio,
                          const koksma_run *run)
{
    const koksma_mask_space *alone = koksma_mask_space_at(0), *space = mask->space;
    const size_t n = (size_t)mask->width * (size_t)mask->height;
    float *values = malloc(n * sizeof *values);
    koksma_mask_quality q;
    for (size_t i = 0; values && i < n; i++) {
        values[i] = (float)(((double)mask->values[i * (size_t)space->dim] - space->low) / (space->high - space->low));
    }
    if (values && !koksma_mask_measure(mask->width, mask->height, alone, values, filter, tests_of(alone), run, &q) &&
        q.error / q.white < 0.9 * ratio) {
        cli_say("mask",
                "%s: warning: read as %s; the first number alone has the ratio %.3g: are the %d numbers masks of "
                "their own?",
                path, space->name, q.error / q.white, space->dim);
    }
    free(values);
}

/* Measures a mask with each filter. */
static int put_filters(const cli_args *args, const char *path, const koksma_mask *mask, const koksma_run *run)
{
    const char *list = cli_text(args, "filter", six);
    char text[KOKSMA_MAX_SPEC];
    uint64_t tests;
    int code = CLI_YES;
    if (!cli_whole(args, "tests", (uint64_t)tests_of(mask->space), 1, 65536, &tests)) {
        return CLI_USAGE;
    }
    for (size_t i = 0; !code && cli_list_item(list, i, text, sizeof text); i++) {
        koksma_mask_filter filter;
        koksma_mask_quality q;
        koksma_status status = koksma_mask_filter_parse(text, &filter);
        status = status ? status
                        : koksma_mask_measure(mask->width, mask->height, mask->space, mask->values, &filter,
                                              (int)tests, run, &q);
        const bool warn = !i && !cli_flag(args, "quiet");
        if (!status && warn && mask->space->dim > 1) {
            tell_channels(path, mask, &filter, q.error / q.white, run);
        }
        code = status ? cli_fail(args, status) : put_quality(path, mask, text, &q, warn);
    }
    return code;
}

/* The tables that replace the errors: of rings, of a histogram or of correlations, with their sizes; 0: not asked for. */
typedef struct tables {
    uint64_t rings, bins, reach;
    bool correlation;
} tables;

/* Reads which table is asked for. Returns false after an error. */
static bool parse_tables(const cli_args *args, tables *t)
{
    const char *const options[TABLES] = {"rings", "histogram", "correlation"};
    const char *first = NULL;
    for (size_t i = 0; i < TABLES; i++) {
        const bool given = cli_text(args, options[i], NULL) != NULL;
        if (given && first) {
            return !cli_error(args, "--%s: it prints rows in place of --%s", options[i], first);
        }
        first = given ? options[i] : first;
    }
    t->correlation = cli_text(args, "correlation", NULL) != NULL;
    if (t->correlation && args->n_operands > 3) {
        return !cli_error(args, "--correlation: it takes one mask or two, not %d", args->n_operands - 1);
    }
    return cli_whole(args, "rings", 0, 1, MOST_RINGS, &t->rings) &&
           cli_whole(args, "histogram", 0, 1, MOST_BINS, &t->bins) &&
           cli_whole(args, "correlation", 0, 0, KOKSMA_MASK_MAX, &t->reach);
}

/* Prints the rows of one mask. */
static int put_mask(const cli_args *args, const tables *t, const char *path, const koksma_mask *mask,
                    const koksma_run *run)
{
    return t->rings  ? put_rings(args, path, mask, (int)t->rings)
           : t->bins ? put_bins(args, path, mask, (int)t->bins)
                     : put_filters(args, path, mask, run);
}

/* Correlates one mask with itself, or two with each other. */
static int put_correlation(const cli_args *args, const tables *t, const koksma_mask_space *space)
{
    koksma_mask masks[2] = {{0}};
    const char *const *paths = (const char *const *)args->operands + 1;
    const size_t n = (size_t)args->n_operands - 1;
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < n && !status; i++) {
        status = koksma_mask_read(paths[i], space, &masks[i]);
    }
    const int code = status ? cli_fail(args, status)
                            : put_offsets(args, (const char *const[]){paths[0], paths[n - 1]},
                                          (const koksma_mask *const[]){&masks[0], &masks[n - 1]}, (int)t->reach);
    koksma_mask_fini(&masks[0]);
    koksma_mask_fini(&masks[1]);
    return code;
}

static int run_check(const cli_args *args)
{
    const koksma_mask_space *space;
    cli_work work;
    tables t = {0};
    if (!cli_refuse(args, "output size open levels swaps until seed from resume bits time-limit",
                    "has no effect on 'check'")) {
        return CLI_USAGE;
    }
    if (args->n_operands < 2) {
        return cli_error(args, "check: it takes one mask or more");
    }
    if (!parse_space(args, &space) || !parse_tables(args, &t) || !cli_work_begin(args, "measuring", &work)) {
        return CLI_USAGE;
    }
    int code = t.correlation ? put_correlation(args, &t, space) : CLI_YES;
    for (int i = 1; i < args->n_operands && !code && !t.correlation; i++) {
        koksma_mask mask;
        const koksma_status status = koksma_mask_read(args->operands[i], space, &mask);
        cli_work_part(&work, (size_t)i - 1, (size_t)args->n_operands - 1);
        code = status ? cli_fail(args, status) : put_mask(args, &t, args->operands[i], &mask, &work.run);
        koksma_mask_fini(&mask);
    }
    cli_work_end();
    return cli_rows_close(code);
}

static int run(const cli_args *args)
{
    const bool check = args->n_operands && !strcmp(args->operands[0], "check");
    return check ? run_check(args) : run_make(args);
}

static const cli_option options[] = {
    {'o', "output", "FILE.png|.exr|.npy|.raw|.h", "the mask; FILE.json beside it has what makes it again"},
    {'f', "filter", "FILTER",
     "the filter that will be applied: box:size=K, binomial:size=K, gaussian:sigma=S, one of 'koksma list "
     "filters', or file:PATH, rows of numbers (default: gaussian:sigma=1); check: a list (default: six common ones)"},
    {0, "size", "WxH", "size in pixels, 4 to 1024 a side (default: 128x128)"},
    {0, "space", "scalar|tent|gaussian|vector2|vector3|vector4|disk|circle|sphere|hemisphere",
     "the numbers of a pixel (default: scalar; check and --from: by FILE.json beside the file, or by its channels)"},
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
    {0, "histogram", "N", "check: print how many pixels have each number in N equal intervals"},
    {0, "correlation", "R",
     "check: print the correlations at offsets up to R pixels: of one mask with itself, or of two with each other"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_mask = {
    .name = "mask",
    .summary = "make blue-noise masks for a filter, and measure masks",
    .synopsis = "-o FILE [--filter FILTER] [--size WxH] [--space SPACE] [--swaps K]\n"
                "--resume FILE [-o FILE] [--time-limit SECONDS]\n"
                "check FILE... [--filter FILTER,..] [--space SPACE] [--tests N]\n"
                "check FILE... --rings N|--histogram N|--correlation R",
    .details =
        "A mask has a number, a vector or a direction for each pixel of a tile. Noise that is made with it, such "
        "as one random number a pixel, nearly vanishes under the filter. The search swaps pixels by simulated "
        "annealing, and minimises the variance of the filtered image of (value < t) over all thresholds t, of "
        "vectors over all half-spaces, exactly and without sampling.\n"
        "error: the root of this variance, for 256 thresholds or 400 fixed half-spaces. white: the same for values "
        "in random order. ratio: error / white. inside and seam (check): the error of pixels whose filter lies "
        "within the mask, and of those whose filter spans two opposite sides; a tile repeats without a visible "
        "seam if they are equal. levels, least_often and most_often: the histogram of a mask of one number. "
        "--rings: the mean power at each frequency, 1 for white noise, and its anisotropy. --correlation: of all "
        "numbers of pixels p of the first mask and p + (dx, dy) of the second, on the torus; two masks that should "
        "be independent have about 0 everywhere. Equal options give equal bits on every "
        "machine and with any number of threads (the search uses one). A mask with borders (--open) has the error "
        "that the filter leaves if all beyond is exact.\n",
    .examples = "koksma mask -o m.png --filter gaussian:sigma=1 --size 64x64\n"
                "koksma mask -o v.npy -f box:size=3 --size 32x48 --space vector2\n"
                "koksma mask check m.png\n"
                "koksma mask check m.png --rings 16\n",
    .options = options,
    .run = run,
};
