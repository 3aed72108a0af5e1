/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma datasheet`: compares one sampler with others in all respects, and writes an HTML page, or the JSON that the
   page shows. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <koksma/datasheet.h>
#include <koksma/plot.h>
#include <koksma/render.h>

#include "cli.h"
#include "source.h"

/* The items of an option that is a list: `texts` has copies of the items, and `at` has pointers to these. The list
   "none" has no items. */
typedef struct list {
    char texts[KOKSMA_MAX_SHEET_SCENES][KOKSMA_MAX_SPEC];
    const char *at[KOKSMA_MAX_SHEET_SCENES];
    size_t n;
} list;

/* Reads the list of an option, with at most `most` items. Returns false after an error. */
static bool read_list(const cli_args *args, const char *option, size_t most, list *out)
{
    const char *text = cli_text(args, option, NULL);
    char item[KOKSMA_MAX_SPEC];
    *out = (list){0};
    while (text && strcmp(text, "none") != 0 && cli_list_item(text, out->n, item, sizeof item)) {
        if (out->n == most) {
            return !cli_error(args, "--%s: it takes up to %zu", option, most);
        }
        snprintf(out->texts[out->n], sizeof *out->texts, "%s", item);
        out->at[out->n] = out->texts[out->n];
        out->n++;
    }
    return true;
}

/* Takes pattern:SPEC as SPEC, as all commands do. Refuses SPEC@N, because a datasheet chooses the n, and points from a
   pipe, because they are read several times and commands on the page name them. Returns the exit code. */
static int take_sampler(const cli_args *args, const char **text)
{
    struct stat info;
    *text = cli_spec_in(*text);
    const char *at = strchr(*text, '@');
    if (at && at[1] && !at[1 + strspn(at + 1, "0123456789@")] && access(*text, F_OK)) {
        return cli_error(args, "%s: a datasheet chooses the numbers of points; it takes %.*s", *text,
                         (int)(at - *text), *text);
    }
    if (!strcmp(*text, "-") || (!stat(*text, &info) && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode))) {
        cli_error(args,
                  "%s: points are read several times, so they must be in a file, not a pipe; write "
                  "them to a file first",
                  *text);
        return koksma_status_exit_code(KOKSMA_MALFORMED);
    }
    return CLI_YES;
}

/* Writes the datasheet as an HTML page or as JSON. */
static koksma_status write_sheet(const char *output, bool is_page, const char *json)
{
    char *page = NULL;
    koksma_status status = is_page ? koksma_datasheet_page(json, &page) : KOKSMA_OK;
    const char *text = is_page ? page : json;
    status = status ? status : koksma_plot_write(output, (const unsigned char *)text, strlen(text));
    free(page);
    return status;
}

static int run(const cli_args *args)
{
    cli_work work;
    list beside, scenes;
    char *json = NULL;
    const bool to_stdout = cli_flag(args, "json");
    const char *output = cli_text(args, "output", to_stdout ? "-" : NULL);
    if (args->n_operands != 1) {
        return cli_error(args, "it takes one sampler: a pattern such as sobol:scramble=owen, a file of "
                               "points, or 'my_{n}_{seed}.npy'");
    }
    if (!output) {
        return cli_error(args, "--output is missing: it takes a file such as sheet.html");
    }
    const char *ending = strrchr(output, '.') && strrchr(output, '.') > output ? strrchr(output, '.') : "";
    const bool is_page = !strcmp(ending, ".html");
    if (to_stdout && strcmp(output, "-") != 0) {
        return cli_error(args, "--json: it prints the data, and excludes --output %s", output);
    }
    if (!is_page && strcmp(ending, ".json") != 0 && !to_stdout) {
        return cli_error(args, "--output %s: a datasheet is written as .html or .json", output);
    }
    if (!read_list(args, "beside", KOKSMA_MAX_BESIDE, &beside) ||
        !read_list(args, "scenes", KOKSMA_MAX_SHEET_SCENES, &scenes) || !cli_work_begin(args, "datasheet", &work)) {
        return CLI_USAGE;
    }
    const char *sampler = args->operands[0];
    int code = take_sampler(args, &sampler);
    for (size_t i = 0; !code && i < beside.n; i++) {
        code = take_sampler(args, &beside.at[i]);
    }
    if (code) {
        return code;
    }
    const koksma_datasheet_options options = {
        .sampler = sampler,
        .beside = cli_text(args, "beside", NULL) ? beside.at : NULL,
        .n_beside = beside.n,
        .scenes = cli_text(args, "scenes", NULL) ? scenes.at : NULL,
        .n_scenes = scenes.n,
        .metric = cli_text(args, "metric", NULL),
        .quick = cli_flag(args, "quick"),
    };
    code = cli_try_output(args, output);
    if (code) {
        return code;
    }
    koksma_status status = koksma_datasheet(&options, &work.run, &json);
    cli_work_end();
    status = status ? status : write_sheet(output, is_page, json);
    free(json);
    return status ? cli_fail(args, status) : CLI_YES;
}

static const cli_option options[] = {
    {'o', "output", "FILE", "the page (.html), or its data (.json)"},
    {'b', "beside", "PATTERN,..|none",
     "samplers to compare with, up to 7 (default: random,jittered,sobol:scramble=owen)"},
    {0, "scenes", "SCENE,..|none", "scenes to render (default: ball,checker,cornell)"},
    CLI_UNKNOWN_OPTION,
    {'m', "metric", "METRIC", "metric of the errors in scenes: mae (default), relmse, ldr-flip, ..."},
    {0, "quick", NULL, "use fewer sets, numbers of points and images; takes less than a minute"},
    {0, "json", NULL, "print the data on stdout instead of writing a file"},
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_datasheet = {
    .name = "datasheet",
    .summary = "describe one sampler on one page, compared with others",
    .synopsis = "SPEC|FILE|'my_{n}_{seed}.npy' -o FILE [--beside PATTERN,..|none] [--scenes SCENE,..|none] "
                "[--metric METRIC] [--quick] [--json]",
    .details =
        "Writes a page about the sampler: a verdict (where it is the best, where others are better, and how certain "
        "that is), its points, its errors and their coherence in scenes, all measures against n with slopes, errors "
        "of integration, spectra, pair correlation, verified properties, and projections in more dimensions. Each "
        "part names the commands that compute its numbers.\n"
        "\n"
        "A name with {n} and {seed} stands for many files: my_256_3.npy has the 256 points of seed 3. The command "
        "takes the files from the smallest seed on, up to the first that is missing. It measures at most six sizes "
        "n, spread evenly on a logarithmic scale up to 4,096 points (with --quick 1,024), and leaves out sizes that "
        "have less than half as many files as another. It renders scenes with as many samples per pixel as a file "
        "has points, such as 16; each pixel and use then takes one of the files of that size at random. --beside "
        "accepts such names, too. FILE is a single set of points. All are plain files, not pipes or -, because they "
        "are read several times.\n"
        "\n"
        "The numbers of sets and images are fixed, so that equal sets give equal results. There are 16 sets of each "
        "size from 16 to 4,096 points, and up to 64 images of each sampler in each scene; with --quick 8 sets of up "
        "to 256 points, and 8 images.\n",
    .examples = "koksma datasheet sobol:scramble=owen -o sheet.html --quick\n"
                "koksma datasheet jittered -b random,pmj02 --scenes ball -o s.html --quick\n",
    .options = options,
    .run = run,
};
