/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Options that render, rank and scene check share. Reads pairing, scope, lights, depth, integrator, filter and the
 * patterns of uses into koksma_render_options. Prints the warnings about a scene, and about patterns that have no
 * effect in it.
 */
#include "render_options.h"
#include "source.h"

#include <stdio.h>
#include <string.h>

/* Reads an option that is one of several names. *out: the index of the name. Returns false after an error that lists
   all names. */
static bool parse_choice(const cli_arguments *arguments, const char *option, const char *(*name_of)(int), int *out)
{
    const char *text = cli_text(arguments, option, NULL);
    char all[128] = "";
    for (int i = 0; text && name_of(i); i++) {
        const size_t used = strlen(all);
        if (!strcmp(name_of(i), text)) {
            *out = i;
            return true;
        }
        snprintf(all + used, sizeof all - used, "%s%s", i ? ", " : "", name_of(i));
    }
    if (text) {
        char meant[96];
        cli_usage_error(arguments, "--%s %s: %sit takes one of %s", option, text, cli_meant_of(text, all, meant),
                        all);
    }
    return !text;
}

static const char *pairing_name(int i)
{
    return koksma_pairing_name((koksma_pairing)i);
}

static const char *scope_name(int i)
{
    return koksma_scope_name((koksma_scope)i);
}

static const char *lights_name(int i)
{
    return koksma_light_selection_name((koksma_light_selection)i);
}

const char *cli_integrator_name(const void *table, size_t i)
{
    (void)table;
    return koksma_integrator_at(i) ? koksma_integrator_at(i)->name : NULL;
}

const char *cli_filter_name(const void *table, size_t i)
{
    (void)table;
    return koksma_filter_at(i) ? koksma_filter_at(i)->name : NULL;
}

bool cli_integrator_and_filter(const cli_arguments *arguments, const koksma_integrator **integrator,
                               const koksma_filter **filter)
{
    const char *integrator_name = cli_text(arguments, "integrator", (*integrator)->name);
    char meant[96];
    const char *filter_name = cli_text(arguments, "filter", (*filter)->name);
    *integrator = koksma_integrator_find(integrator_name);
    *filter = koksma_filter_find(filter_name);
    if (!*integrator) {
        cli_usage_error(arguments, "--integrator %s: %s'koksma list integrators' names them", integrator_name,
                        cli_meant(integrator_name, cli_integrator_name, NULL, meant));
    } else if (!*filter) {
        cli_usage_error(arguments, "--filter %s: %s'koksma list filters' names them", filter_name,
                        cli_meant(filter_name, cli_filter_name, NULL, meant));
    }
    return *integrator && *filter;
}

bool cli_sampling_options(const cli_arguments *arguments, koksma_render_options *options)
{
    int pairing = options->pairing, scope = options->scope, lights = options->lights;
    uint64_t depth = 0;
    if (!parse_choice(arguments, "pairing", pairing_name, &pairing) ||
        !parse_choice(arguments, "scope", scope_name, &scope) ||
        !parse_choice(arguments, "lights", lights_name, &lights) ||
        !cli_whole(arguments, "depth", 0, 0, KOKSMA_MAX_DEPTH, &depth)) {
        return false;
    }
    options->pairing = (koksma_pairing)pairing;
    options->scope = (koksma_scope)scope;
    options->lights = (koksma_light_selection)lights;
    options->depth = cli_flag(arguments, "depth") ? (int)depth : -1;
    options->splat = cli_flag(arguments, "splat");
    return cli_integrator_and_filter(arguments, &options->integrator, &options->filter);
}

bool cli_use_patterns(const cli_arguments *arguments, const char *lines, koksma_render_options *options, int *code)
{
    uint64_t n = 0, spp;
    bool common = false; /* whether a line gave the pattern of all uses that have none of their own */
    while (*lines) {
        static char line[KOKSMA_MAX_PATTERNS_TEXT];
        const size_t length = strcspn(lines, "\n");
        if (length >= sizeof line) {
            *code =
                cli_usage_error(arguments, "--pattern %.20s...: longer than %zu characters", lines, sizeof line - 1);
            return false;
        }
        memcpy(line, lines, length);
        line[length] = '\0';
        lines += lines[length] ? length + 1 : length;
        if (!cli_take_counts(arguments, line, &n)) {
            *code = CLI_USAGE;
            return false;
        }
        const koksma_spec before = options->pattern;
        options->pattern = (koksma_spec){0}; /* a line that names no uses sets it */
        const koksma_status status = koksma_render_patterns(line, options);
        if (status) {
            *code = cli_fail(arguments, status);
            return false;
        }
        if (options->pattern.pattern && common) {
            *code = cli_usage_error(
                arguments,
                "-p %s: another -p has the pattern of all uses; name the uses of this one, as in -p lens=PATTERN",
                line);
            return false;
        }
        common = common || options->pattern.pattern;
        options->pattern = options->pattern.pattern ? options->pattern : before;
    }
    const bool valid = cli_whole(arguments, "spp", n ? n : 16, 1, KOKSMA_MAX_SPP, &spp);
    if (valid && n && n != spp) {
        cli_usage_error(arguments, "-p has @%llu, but -n is %llu", (unsigned long long)n, (unsigned long long)spp);
    }
    options->spp = (int)spp;
    *code = CLI_USAGE;
    return valid && (!n || n == spp);
}

void cli_idle_uses(const cli_arguments *arguments, const char *name, const koksma_scene *scene,
                   const koksma_render_options *options)
{
    for (size_t i = 0; koksma_use_at(i); i++) {
        if (options->patterns[i].pattern && !koksma_use_is_spent(scene, options, i)) {
            cli_say(arguments->command->name,
                    "%s: warning: this scene needs no samples for %s; the pattern for it has no effect", name,
                    koksma_use_at(i)->name);
        }
    }
    for (size_t g = 0; g < KOKSMA_MAX_USE_GROUPS; g++) {
        const koksma_use_group *group = &options->groups[g];
        char text[KOKSMA_MAX_SPEC];
        koksma_use_group_text(group, text);
        for (int i = 0; i < group->n_uses; i++) {
            if (!koksma_use_is_spent(scene, options, (size_t)group->uses[i])) {
                cli_say(arguments->command->name,
                        "%s: warning: this scene needs no samples for %s; its coordinates in %s have no effect", name,
                        koksma_use_at((size_t)group->uses[i])->name, text);
            }
        }
    }
}

size_t cli_scene_warnings(const cli_arguments *arguments, const char *name, const koksma_scene *scene,
                          const koksma_render_options *options, size_t most)
{
    char text[512];
    size_t n = 0;
    for (; options ? koksma_render_warning(scene, options, n, text, sizeof text)
                   : koksma_scene_warning(scene, n, text, sizeof text);
         n++) {
        if (n < most) {
            cli_say(arguments->command->name, "%s: warning: %s", name, text);
        }
    }
    if (n > most) {
        cli_say(arguments->command->name, "%s: %zu more warnings; 'koksma scene check' prints all", name, n - most);
    }
    return n;
}
