/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Checks the options of `koksma study quick` before it writes its plan. The plan's reader would find the same errors,
 * but would name a line of a file that the user did not write. Each item of a list is parsed once, by the function that
 * the reader uses for it, and its canonical text is compared with those of earlier items. Then the patterns are tried
 * with the numbers of points: the plan leaves out sizes that a pattern does not have, but not all of them. A measure must
 * accept a size of which there are sets, and a program or library of a new plan must be allowed to run and make a set.
 */
#include "studying.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/integrate.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "source.h"

/* As many as the plan's reader accepts in a list; it tries sets of at most MOST_TRIED points. */
enum { MOST_ITEMS = 4096, MOST_TRIED = 1 << 16 };

/* Parses an item and writes its canonical text. */
typedef koksma_status (*item_parser)(const char *item, char text[PATH_MAX]);

static koksma_status parse_pattern(const char *item, char text[PATH_MAX])
{
    koksma_spec spec;
    const koksma_status status = koksma_pattern_spec(item, &spec);
    if (!status) {
        koksma_spec_text(&spec, text);
    }
    return status;
}

/* koksma_evaluate checks the dimension of the one point. */
static koksma_status parse_measure(const char *item, char text[PATH_MAX])
{
    double xs[] = {0.5, 0.5};
    const koksma_points point = {1, 2, xs};
    koksma_spec spec;
    koksma_value value;
    const koksma_status status = koksma_measure_spec(item, &spec);
    if (status) {
        return status;
    }
    koksma_spec_text(&spec, text);
    return koksma_evaluate(&spec, &point, NULL, &value) == KOKSMA_DIM ? KOKSMA_DIM : KOKSMA_OK;
}

static koksma_status parse_integrand(const char *item, char text[PATH_MAX])
{
    koksma_integral *integral;
    koksma_integral_facts facts;
    const koksma_status status = koksma_integral_open(item, 2, &integral);
    if (!status) {
        koksma_integral_about(integral, &facts);
        snprintf(text, PATH_MAX, "%s", facts.text);
        koksma_integral_close(integral);
    }
    return status;
}

static koksma_status parse_scene(const char *item, char text[PATH_MAX])
{
    koksma_scene *scene;
    const koksma_status status = koksma_scene_open(item, &scene);
    if (!status) {
        koksma_scene_close(scene);
        snprintf(text, PATH_MAX, "%s", item);
    }
    return status;
}

static void append(char *list, const char *name)
{
    const size_t used = strlen(list);
    snprintf(list + used, CLI_QUICK_LIST - used, "%s%s", used ? "," : "", name);
}

const char *cli_quick_measures(const cli_arguments *arguments, const char *list, const char *points,
                               char names[CLI_QUICK_LIST])
{
    char text[PATH_MAX], left_out[CLI_QUICK_LIST] = "";
    const koksma_measure *measure;
    if (strcmp(list, "all") != 0) {
        return list;
    }
    *names = '\0';
    for (size_t i = 0; (measure = koksma_measure_at(i)); i++) {
        bool fits = true;
        for (size_t k = 0; fits && cli_list_item(points, k, text, sizeof text); k++) {
            const size_t n = strtoull(text, NULL, 10); /* 0 if it is no number, which is reported later */
            fits = !n || koksma_plan_try_measure(measure->name, n, 2) != KOKSMA_N;
        }
        append(!fits || parse_measure(measure->name, text) ? left_out : names, measure->name);
    }
    if (*left_out && !cli_flag(arguments, "quiet") && koksma_study_mpi_rank() == 0) {
        cli_say(arguments->command->name, "-m all leaves out measures that do not accept -n %s: %s", points,
                left_out);
    }
    return names;
}

const char *cli_quick_integrands(const char *list, char names[CLI_QUICK_LIST])
{
    char text[PATH_MAX];
    const koksma_integrand *integrand;
    if (!list || strcmp(list, "all") != 0) {
        return list;
    }
    *names = '\0';
    for (size_t i = 0; (integrand = koksma_integrand_at(i)); i++) {
        if (!parse_integrand(integrand->name, text)) {
            append(names, integrand->name);
        }
    }
    return names;
}

/* The canonical texts of the items of a list. */
typedef struct canonical {
    size_t n;
    char *at[MOST_ITEMS];
} canonical;

/* Parses an item and adds its canonical text to those of earlier items. Returns the exit code. */
static int check_item(const cli_arguments *arguments, const char *option, const char *item, item_parser parser,
                      canonical *texts)
{
    char text[PATH_MAX];
    const koksma_status status = parser(item, text);
    if (status) {
        cli_usage_error(arguments, "--%s %s: %s", option, item, koksma_error_text());
        return koksma_status_exit_code(status);
    }
    for (size_t k = 0; k < texts->n; k++) {
        if (!strcmp(texts->at[k], text)) {
            return cli_usage_error(arguments, "--%s: '%s' is listed twice", option, text);
        }
    }
    if (texts->n == MOST_ITEMS) {
        return cli_usage_error(arguments, "--%s: at most %d items", option, MOST_ITEMS);
    }
    texts->at[texts->n] = strdup(text);
    return texts->at[texts->n++] ? CLI_YES : cli_no_memory();
}

static int check_items(const cli_arguments *arguments, const char *option, const char *list, item_parser parser)
{
    char item[PATH_MAX];
    canonical *texts = calloc(1, sizeof *texts);
    if (!texts) {
        return cli_no_memory();
    }
    int code = CLI_YES;
    for (size_t i = 0; !code && cli_list_item(list, i, item, sizeof item); i++) {
        code = strcmp(item, "all") || parser == parse_scene
                   ? check_item(arguments, option, item, parser, texts)
                   : cli_usage_error(arguments, "--%s: 'all' stands alone, without other items", option);
    }
    code = code || texts->n ? code : cli_usage_error(arguments, "--%s: an empty list", option);
    for (size_t i = 0; i < texts->n; i++) {
        free(texts->at[i]);
    }
    free(texts);
    return code;
}

/* Generates one set of a pattern that runs code of others, which koksma_plan_try does not. Returns the exit code, which is
   not CLI_YES if such code may not run or the program or library fails; it may have no set of n points. */
static int try_code(const cli_arguments *arguments, const char *item, size_t n)
{
    koksma_spec spec;
    koksma_points points;
    if (koksma_pattern_spec(item, &spec) || !spec.pattern->runs_code) {
        return CLI_YES;
    }
    koksma_status status = koksma_points_init(&points, n, 2);
    if (!status) {
        status = koksma_generate(&spec, 0, NULL, &points);
        koksma_points_fini(&points);
    }
    if (!status || status == KOKSMA_IMPOSSIBLE || status == KOKSMA_N) {
        return CLI_YES;
    }
    cli_usage_error(arguments, "--patterns %s: %s", item, koksma_error_text());
    return koksma_status_exit_code(status);
}

/* The numbers of points of an option. */
typedef struct sizes {
    const char *option, *list;
    size_t n, at[KOKSMA_MAX_SIZES];
    bool has_set[KOKSMA_MAX_SIZES]; /* whether some pattern has such a set, as far as it was tried */
} sizes;

/* Tries all patterns with all sizes. Returns the exit code, which is CLI_YES if one has a set, or if one is too large to
   be tried. */
static int try_sets(const cli_arguments *arguments, const char *patterns, sizes *of)
{
    char item[KOKSMA_MAX_SPEC], reason[512] = "";
    bool any = false;
    for (size_t i = 0; cli_pattern_item(patterns, i, item); i++) {
        for (size_t k = 0; k < of->n; k++) {
            const koksma_status tried = of->at[k] > MOST_TRIED ? KOKSMA_OK : koksma_plan_try(item, of->at[k], 2);
            of->has_set[k] |= !tried;
            any |= !tried;
            if (koksma_status_exit_code(tried) > CLI_USAGE) { /* it concerns a file, not this number of points */
                cli_usage_error(arguments, "--patterns %s: %s", item, koksma_error_text());
                return koksma_status_exit_code(tried);
            }
            if (tried && !*reason) {
                snprintf(reason, sizeof reason, "%s", koksma_error_text());
            }
        }
    }
    return any ? CLI_YES
               : cli_usage_error(arguments, "--%s %s: no pattern has such a set: %s", of->option, of->list, reason);
}

int cli_quick_try_code(const cli_arguments *arguments, const cli_quick *quick)
{
    char item[PATH_MAX];
    uint64_t least = UINT64_MAX;
    int code = CLI_YES;
    for (size_t k = 0; cli_list_item(quick->points, k, item, sizeof item); k++) {
        const uint64_t n = strtoull(item, NULL, 10);
        least = n < least ? n : least;
    }
    for (size_t i = 0; !code && least <= MOST_TRIED && cli_pattern_item(quick->patterns, i, item); i++) {
        code = try_code(arguments, item, (size_t)least);
    }
    return code;
}

/* Tries the measures with all sizes of which there are sets: each must accept one. Returns the exit code. */
static int try_measures(const cli_arguments *arguments, const char *measures, const sizes *of)
{
    char item[PATH_MAX];
    int code = CLI_YES;
    for (size_t i = 0; !code && cli_list_item(measures, i, item, sizeof item); i++) {
        bool any = false;
        for (size_t k = 0; !any && k < of->n; k++) {
            any = of->has_set[k] && koksma_plan_try_measure(item, of->at[k], 2) != KOKSMA_N;
        }
        code = any ? CLI_YES : cli_usage_error(arguments, "--measures %s: %s", item, koksma_error_text());
    }
    return code;
}

/* Checks the numbers of an option, and tries sets of them. `measured`: they are those of the sets that are measured. */
static int check_sizes(const cli_arguments *arguments, const cli_quick *quick, const char *option, const char *list,
                       uint64_t most, bool measured)
{
    sizes of = {.option = option, .list = list};
    if (!cli_sizes(arguments, option, list, "", most, of.at, &of.n)) {
        return CLI_USAGE;
    }
    const int code = try_sets(arguments, quick->patterns, &of);
    return code || !measured ? code : try_measures(arguments, quick->measures, &of);
}

/* Whether the pattern of `joined`, in which a relative path at `at` has become absolute, has that path. The name of a
   folder may end a pattern in the text of an image's uses; {n} or {seed} in it would make a file a family. */
static bool reads_as_meant(const char *joined, size_t at, const char *here, const char *relative, bool image)
{
    koksma_render_options options = {0};
    koksma_spec spec;
    const size_t length = strlen(here) + 1;
    if (koksma_pattern_spec(joined, &spec) || strncmp(spec.path, joined + at, length) ||
        strcmp(spec.path + length, relative) ||
        (spec.pattern->whole && (strstr(here, "{n}") || strstr(here, "{seed}")))) {
        return false;
    }
    return !image || (!koksma_render_patterns(joined, &options) && !strcmp(options.pattern.path, spec.path));
}

/* Relative paths become absolute in the plan. */
static int check_folder(const cli_arguments *arguments, const cli_quick *quick)
{
    char item[KOKSMA_MAX_SPEC], here[PATH_MAX], joined[KOKSMA_MAX_SPEC + PATH_MAX + 1];
    koksma_spec spec;
    for (size_t i = 0; cli_pattern_item(quick->patterns, i, item); i++) {
        const size_t at = koksma_plan_path(item, 0);
        if (!at || !cli_is_relative(item + at) || koksma_pattern_spec(item, &spec) || !getcwd(here, sizeof here)) {
            continue;
        }
        snprintf(joined, sizeof joined, "%.*s%s/%s", (int)at, item, here, item + at);
        if (strlen(joined) < KOKSMA_MAX_SPEC && !reads_as_meant(joined, at, here, spec.path, quick->scenes)) {
            return cli_usage_error(arguments,
                                   "--patterns %s: with the current folder '%s' before its path, it would be read as "
                                   "something else; rename the folder",
                                   item, here);
        }
    }
    return CLI_YES;
}

int cli_quick_check(const cli_arguments *arguments, const cli_quick *quick)
{
    const bool all = !strcmp(quick->patterns, "all");
    if (!quick->scenes && cli_text(arguments, "spp", NULL)) {
        return cli_usage_error(arguments,
                               "--spp needs --scene, because it is the number of samples a pixel of images");
    }
    if (!quick->scenes && cli_text(arguments, "metric", NULL)) {
        return cli_usage_error(arguments, "--metric needs --scene, because it measures the error of images");
    }
    int code = all ? CLI_YES : check_items(arguments, "patterns", quick->patterns, parse_pattern);
    code = code ? code : check_folder(arguments, quick);
    code = code ? code : check_items(arguments, "measures", quick->measures, parse_measure);
    code =
        code || !quick->integrands ? code : check_items(arguments, "integrands", quick->integrands, parse_integrand);
    code = code || !quick->scenes ? code : check_items(arguments, "scene", quick->scenes, parse_scene);
    code = code ? code : check_sizes(arguments, quick, "points", quick->points, KOKSMA_MAX_COORDINATES, true);
    return code || !quick->scenes ? code : check_sizes(arguments, quick, "spp", quick->spp, KOKSMA_MAX_SPP, false);
}
