/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Writes the plan of `koksma study quick` to DIR/plan.json, which `koksma study run` accepts, too. The patterns,
 * measures, integrands and numbers of points of the command line become one block of points, the scenes one block of
 * images. Both blocks of the plan have `skip`, which leaves out sizes that a pattern does not have. Relative paths
 * become absolute, because a plan's paths are relative to the plan's folder. The options are checked before anything
 * is written, and the programs and libraries of a new plan are tried (study_quick_check.c). An existing plan.json of
 * another text stays (koksma_plan_write).
 *
 * Under mpirun only rank 0 uses DIR, which may be on its machine alone. Every rank makes the same text from the same
 * options, and the other ranks open it as a text.
 */
#include "studying.h"

#include "rendering.h"

#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <koksma/study.h>

static const char default_patterns[] = "random,jittered,n-rooks,sobol:scramble=owen";

/* Prints at most `count` characters of a text, escaped for a JSON string. */
static void put_characters(FILE *out, const char *text, size_t count)
{
    for (; *text && count > 0; text++, count--) {
        const unsigned char c = (unsigned char)*text;
        fprintf(out, c < 0x20 ? "\\u%04x" : c == '"' || c == '\\' ? "\\%c" : "%c", c);
    }
}

/* Prints a pattern, measure or scene in quotes. Relative paths in the text become absolute, from the current directory. */
static void put_item(FILE *out, const char *item, bool is_scene)
{
    char here[PATH_MAX];
    const size_t at = is_scene ? 0 : koksma_plan_path(item, 0);
    fputc('"', out);
    put_characters(out, item, at);
    if ((is_scene ? strpbrk(item, "/.") != NULL : at > 0) && cli_is_relative(item + at) &&
        getcwd(here, sizeof here)) {
        put_characters(out, here, SIZE_MAX);
        fputc('/', out);
    }
    put_characters(out, item + at, SIZE_MAX);
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

/* Prints a list as JSON numbers. */
static void put_numbers(FILE *out, const char *key, const char *list)
{
    char item[32];
    fprintf(out, "\"%s\": [", key);
    for (size_t i = 0; cli_list_item(list, i, item, sizeof item); i++) {
        fprintf(out, "%s%llu", i ? ", " : "", strtoull(item, NULL, 10)); /* JSON has no leading zeros */
    }
    fputs("]", out);
}

/* Prints the metrics of --metric: the first ranks the patterns, the others are measured, too. Returns false after an
   error. */
static bool put_metrics(FILE *out, const cli_arguments *arguments)
{
    cli_metrics metrics = {.n = 0};
    if (!cli_metrics_parse(arguments, true, &metrics)) {
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

static bool put_plan(FILE *out, const cli_arguments *arguments, const cli_quick *quick)
{
    const char *patterns = quick->patterns, *scenes = quick->scenes, *measures = quick->measures;
    const char *integrands = quick->integrands;
    fputs("{\n  \"comment\": \"Made by koksma study quick; studies/README.md has all fields.\",\n"
          "  \"name\": \"quick\",\n  \"title\": \"Patterns by ",
          out);
    put_characters(out, strcmp(cli_text(arguments, "measures", ""), "all") ? measures : "all measures", SIZE_MAX);
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
    put_numbers(out, "n", quick->points);
    fputs(", \"trials\": 100, \"quick\": 10, \"skip\": true}\n  ]", out);
    if (scenes) {
        fputs(",\n  \"images\": [\n    {", out);
        put_list(out, "scenes", scenes, true);
        fputs(",\n     ", out);
        put_patterns(out, patterns);
        fputs(",\n     ", out);
        put_numbers(out, "spp", quick->spp);
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

static void store_path(const char *folder, char path[CLI_QUICK_PATH])
{
    snprintf(path, CLI_QUICK_PATH, "%s/results.sqlite", folder);
}

/* Writes the plan's text and notes which names are new. Programs and libraries are tried only for a new plan: a study
   that goes on may be complete. Returns the exit code. */
static int write_plan(const cli_arguments *arguments, const cli_quick *quick, const char *folder, const char *text,
                      cli_quick_plan *plan)
{
    struct stat info;
    snprintf(plan->path, sizeof plan->path, "%s/plan.json", folder);
    if (strlen(folder) > 1000) { /* as the library's functions on studies have it */
        return cli_usage_error(arguments, "the name of a study's folder is longer than 1000 bytes: %.40s...", folder);
    }
    const int code = lstat(plan->path, &info) ? cli_quick_try_code(arguments, quick) : CLI_YES;
    if (code) {
        return code;
    }
    const bool new_folder = lstat(folder, &info);
    char store[CLI_QUICK_PATH];
    store_path(folder, store);
    plan->had_store = !lstat(store, &info);
    const koksma_status status = koksma_plan_write(folder, text, &plan->new_file);
    plan->new_folder = !status && new_folder;
    /* the text comes from the command line, and no file is malformed */
    return status == KOKSMA_MALFORMED ? cli_usage_error(arguments, "%s", koksma_error_text())
           : status                   ? cli_fail(arguments, status)
                                      : CLI_YES;
}

int cli_write_quick_plan(const cli_arguments *arguments, const char *folder, cli_quick_plan *plan)
{
    char all_measures[CLI_QUICK_LIST], all_integrands[CLI_QUICK_LIST];
    const char *points = cli_text(arguments, "points", "16,64,256,1024");
    const char *measures = cli_text(arguments, "measures", "star,l2-star");
    const char *integrands = cli_text(arguments, "integrands", NULL);
    const cli_quick quick = {.patterns = cli_text(arguments, "patterns", default_patterns),
                             .measures = cli_quick_measures(arguments, measures, points, all_measures),
                             .integrands = cli_quick_integrands(integrands, all_integrands),
                             .points = points,
                             .scenes = cli_text(arguments, "scene", NULL),
                             .spp = cli_text(arguments, "spp", "4,16,64")};
    char *text = NULL;
    size_t size = 0;
    *plan = (cli_quick_plan){.new_file = false};
    const int checked = cli_quick_check(arguments, &quick);
    if (checked) {
        return checked;
    }
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        return cli_no_memory();
    }
    const bool good = put_plan(out, arguments, &quick);
    const bool closed = !fclose(out);
    const bool keeps = good && closed && koksma_study_mpi_rank() > 0;
    const int code = !good     ? CLI_USAGE
                     : !closed ? cli_no_memory()
                     : keeps   ? CLI_YES
                               : write_plan(arguments, &quick, folder, text, plan);
    plan->text = keeps ? text : NULL;
    free(keeps ? NULL : text);
    return code;
}

void cli_remove_quick_plan(const char *folder, const cli_quick_plan *plan)
{
    char path[CLI_QUICK_PATH];
    struct stat info;
    if (!plan) {
        return;
    }
    store_path(folder, path);
    if (plan->new_file && (plan->had_store || lstat(path, &info))) { /* otherwise another run has begun this plan */
        unlink(plan->path);
    }
    if (plan->new_folder) {
        rmdir(folder);
    }
}
