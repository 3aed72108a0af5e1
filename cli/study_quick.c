/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Writes the plan of `koksma study quick` to DIR/plan.json, which `koksma study run` accepts, too. The patterns,
 * measures, integrands and numbers of points of the command line become one block of points, the scenes one block of
 * images. Both blocks of the plan have `skip`, which leaves out sizes that a pattern does not have. Relative paths
 * become absolute, because a plan's paths are relative to the plan's folder.
 */
#include "study_quick.h"

#include "metric_option.h"

#include <errno.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <koksma/plot.h>
#include <koksma/study.h>

static const char default_patterns[] = "random,jittered,n-rooks,sobol:scramble=owen";

/* Prints at most `count` characters of a text, escaped for a JSON string. */
static void put_characters(FILE *out, const char *text, size_t count)
{
    for (; *text && count > 0; text++, count--) {
        fprintf(out, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
    }
}

/* Prints a pattern, measure or scene in quotes. Relative paths in the text become absolute, from the current directory. */
static void put_item(FILE *out, const char *item, bool is_scene)
{
    char here[PATH_MAX];
    size_t at = is_scene ? 0 : koksma_plan_path(item, 0), printed = 0;
    fputc('"', out);
    for (bool path = is_scene ? strpbrk(item, "/.") != NULL : at > 0; path; path = !is_scene && at > 0) {
        put_characters(out, item + printed, at - printed);
        printed = at;
        if (item[at] != '/' && getcwd(here, sizeof here)) {
            put_characters(out, here, SIZE_MAX);
            fputc('/', out);
        }
        at = koksma_plan_path(item, at);
    }
    put_characters(out, item + printed, SIZE_MAX);
    fputc('"', out);
}

static void put_list(FILE *out, const char *key, const char *list, bool is_scene)
{
    char item[PATH_MAX];
    fprintf(out, "\"%s\": [", key);
    for (size_t i = 0; cli_list_item(list, i, item, sizeof item); i++) {
        fputs(i ? ", " : "", out);
        put_item(out, item, is_scene);
    }
    fputs("]", out);
}

static bool is_named(const koksma_spec *spec, const char *name)
{
    char text[KOKSMA_MAX_SPEC];
    const size_t length = strlen(name);
    koksma_spec_text(spec, text);
    return !strncmp(text, name, length) && strchr(":", text[length]);
}

/* Prints every pattern that needs no file, once: a second name of a pattern, such as latin-hypercube, is left out. */
static void put_all_patterns(FILE *out)
{
    const koksma_pattern *pattern;
    koksma_spec spec;
    fputs("\"patterns\": [", out);
    for (size_t i = 0, n = 0; (pattern = koksma_pattern_at(i)); i++) {
        if (!pattern->operand && !koksma_pattern_spec(pattern->name, &spec) && is_named(&spec, pattern->name)) {
            fprintf(out, "%s\"%s\"", n++ ? ", " : "", pattern->name);
        }
    }
    fputs("]", out);
}

static void put_patterns(FILE *out, const char *list)
{
    if (!strcmp(list, "all")) {
        put_all_patterns(out);
    } else {
        put_list(out, "patterns", list, false);
    }
}

/* Prints the list of an option as JSON numbers. Returns false after an error if an item is not a whole number. */
static bool put_numbers(FILE *out, const cli_arguments *arguments, const char *key, const char *option,
                        const char *fallback)
{
    char item[32];
    const char *list = cli_text(arguments, option, fallback);
    fprintf(out, "\"%s\": [", key);
    for (size_t i = 0; cli_list_item(list, i, item, sizeof item); i++) {
        if (!*item || item[strspn(item, "0123456789")]) {
            cli_usage_error(arguments, "--%s %s: '%s' is not a whole number", option, list, item);
            return false;
        }
        fprintf(out, "%s%s", i ? ", " : "", item);
    }
    fputs("]", out);
    return true;
}

/* Prints the metrics of --metric: the first ranks the patterns, the others are measured, too. Returns false after an
   error. */
static bool put_metrics(FILE *out, const cli_arguments *arguments)
{
    cli_metrics metrics = {.n = 0};
    if (!cli_metrics_parse(arguments, &metrics)) {
        return false;
    }
    for (size_t i = 0; i < metrics.n; i++) {
        char name[KOKSMA_MAX_SPEC];
        koksma_metric_text(&metrics.specs[i], name);
        fprintf(out, i == 0 ? ",\n  \"metric\": \"%s\"" : i == 1 ? ",\n  \"metrics\": [\"%s\"" : ", \"%s\"", name);
    }
    fputs(metrics.n > 1 ? "]" : "", out);
    return true;
}

static bool put_plan(FILE *out, const cli_arguments *arguments)
{
    const char *patterns = cli_text(arguments, "patterns", default_patterns);
    const char *scenes = cli_text(arguments, "scene", NULL);
    const char *measures = cli_text(arguments, "measures", "star,l2-star");
    const char *integrands = cli_text(arguments, "integrands", NULL);
    if (!scenes && cli_text(arguments, "metric", NULL)) {
        cli_usage_error(arguments, "--metric needs --scene, because it measures the error of images");
        return false;
    }
    fputs("{\n  \"comment\": \"Made by koksma study quick; studies/README.md has all fields.\",\n"
          "  \"name\": \"quick\",\n  \"title\": \"Patterns by ",
          out);
    put_characters(out, measures, SIZE_MAX);
    fputs(scenes ? ", and in " : "", out);
    put_characters(out, scenes ? scenes : "", SIZE_MAX);
    fputs("\",\n  \"discrepancies\": [\n    {", out);
    put_patterns(out, patterns);
    fputs(",\n     ", out);
    put_list(out, "measures", measures, false);
    fputs(",\n     ", out);
    if (integrands) {
        put_list(out, "integrands", integrands, false);
        fputs(",\n     ", out);
    }
    if (!put_numbers(out, arguments, "n", "points", "16,64,256,1024")) {
        return false;
    }
    fputs(", \"trials\": 100, \"quick\": 10, \"skip\": true}\n  ]", out);
    if (scenes) {
        fputs(",\n  \"images\": [\n    {", out);
        put_list(out, "scenes", scenes, true);
        fputs(",\n     ", out);
        put_patterns(out, patterns);
        fputs(",\n     ", out);
        if (!put_numbers(out, arguments, "spp", "spp", "4,16,64")) {
            return false;
        }
        fputs(", \"size\": [96, 72], \"trials\": 20, \"quick\": 6, \"skip\": true,\n     \"references\": [{\"name\": "
              "\"converged\", \"pattern\": \"jittered\", \"spp\": 1024, \"replicates\": 4}]}\n  ]",
              out);
        if (!put_metrics(out, arguments)) {
            return false;
        }
    }
    fputs("\n}\n", out);
    return true;
}

/* Returns whether the plan may be written: the folder has no results, or its plan has exactly this text. */
static bool may_write(const char *folder, const char *path, const char *text, size_t size)
{
    char results[CLI_QUICK_PATH + 32];
    snprintf(results, sizeof results, "%s/results.sqlite", folder);
    FILE *f = access(results, F_OK) ? NULL : fopen(path, "r");
    if (!f) {
        return true;
    }
    bool same = true;
    for (size_t i = 0; same && i < size; i++) {
        same = getc(f) == (unsigned char)text[i];
    }
    same = same && getc(f) == EOF;
    fclose(f);
    return same;
}

int cli_write_quick_plan(const cli_arguments *arguments, const char *folder, char path[CLI_QUICK_PATH])
{
    char *text = NULL;
    size_t size = 0;
    int code = CLI_YES;
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        return cli_no_memory();
    }
    const bool good = put_plan(out, arguments);
    if (fclose(out) || !good) {
        free(text);
        return good ? cli_no_memory() : CLI_USAGE;
    }
    snprintf(path, CLI_QUICK_PATH, "%s/plan.json", folder);
    if (strlen(folder) > 1000) { /* as the library's functions on studies have it */
        code = cli_usage_error(arguments, "the name of a study's folder is longer than 1000 bytes: %.40s...", folder);
    } else if (mkdir(folder, 0777) && errno != EEXIST) {
        code = cli_usage_error(arguments, "%s: can't be made: %s", folder, strerror(errno));
    } else if (!may_write(folder, path, text, size)) {
        code = cli_usage_error(arguments,
                               "%s: the folder has another plan; use another folder, or 'koksma study run %s -o %s'",
                               path, path, folder);
    } else {
        const koksma_status status = koksma_plot_write(path, (const unsigned char *)text, size);
        code = status ? cli_fail(arguments, status) : CLI_YES;
    }
    free(text);
    return code;
}
