/* SPDX-License-Identifier: Apache-2.0 */
/* The options of commands that render or compare images: how samples are drawn, adaptive sampling, metrics, and the
   colours of the AOV "id". */
#include "rendering.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "source.h"

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

int cli_one_scene(const cli_arguments *arguments)
{
    char known[CLI_KNOWN];
    return arguments->n_operands > 1
               ? cli_usage_error(arguments,
                                 "it takes one scene, and '%s' is one operand more%s; lists have commas, as in "
                                 "--spp 4,16 or -p random,n-rooks",
                                 arguments->operands[1], cli_operand_hint(arguments, arguments->operands[1], known))
               : cli_usage_error(arguments, "it takes one scene, such as ball or ./scene.json");
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
        cli_usage_error(arguments, "no integrator '%s'; %s'koksma list integrators' names them", integrator_name,
                        cli_meant(integrator_name, cli_integrator_name, NULL, meant));
    } else if (!*filter) {
        cli_usage_error(arguments, "no filter '%s'; %s'koksma list filters' names them", filter_name,
                        cli_meant(filter_name, cli_filter_name, NULL, meant));
    }
    return *integrator && *filter;
}

bool cli_sampling_options(const cli_arguments *arguments, koksma_render_options *options)
{
    int pairing = options->pairing, scope = options->scope, lights = options->lights;
    uint64_t depth = 0;
    if (!cli_choice(arguments, "pairing", &pairing) || !cli_choice(arguments, "scope", &scope) ||
        !cli_choice(arguments, "lights", &lights) || !cli_whole(arguments, "depth", 0, 0, KOKSMA_MAX_DEPTH, &depth)) {
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
    const char *const all = lines;
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
    for (const char *at = all; valid && *at; at += strcspn(at, "\n"), at += *at == '\n') {
        cli_warn_file(arguments, at, options->scope == KOKSMA_SCOPE_PIXEL ? spp : 0);
    }
    bool said =
        !valid || options->scope != KOKSMA_SCOPE_PIXEL || cli_warn_unbalanced(arguments, &options->pattern, spp);
    for (size_t i = 0; koksma_use_at(i) && !said; i++) {
        said = cli_warn_unbalanced(arguments, &options->patterns[i], spp);
    }
    return valid && (!n || n == spp);
}

void cli_warn_unused(const cli_arguments *arguments, const char *name, const koksma_scene *scene,
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

enum { SMALL = 32, SAMPLES = 16 }; /* the width of a small picture, and its samples a pixel */

void cli_say_black(const cli_arguments *arguments, const char *name, int width, int height)
{
    cli_say(arguments->command->name, "%s: warning: all pixels of %d x %d are black; is the scene in view, and lit?",
            name, width, height);
}

koksma_status cli_look(const cli_arguments *arguments, const char *name, const koksma_scene *scene,
                       const koksma_render_options *options, bool *is_black)
{
    koksma_image picture = {0};
    koksma_render_options small = *options;
    small.height = (int)fmax(1, SMALL * (double)small.height / small.width);
    small.width = SMALL;
    small.spp = SAMPLES;
    const koksma_status status = koksma_render(scene, &small, NULL, &picture);
    *is_black = !status && koksma_render_is_black(scene, &picture);
    if (*is_black) {
        cli_say_black(arguments, name, picture.width, picture.height);
    }
    koksma_image_fini(&picture);
    return status;
}

/*
 * Reads the options of adaptive sampling for `koksma render` and refuses options that have no effect
 * with the chosen method. Adds the statistics of the adaptive method to the row of results. Writes --counts,
 * an image of the number of samples of each pixel (in a PNG file divided by the largest number, so that 1 is white),
 * and --strata, a drawing of one pixel's strata.
 */

/* Reads --strata X,Y:FILE. Returns false after a usage error. */
static bool parse_strata(const cli_arguments *arguments, cli_adaptive *adaptive)
{
    const char *text = cli_text(arguments, "strata", NULL);
    int used = 0;
    if (!text) {
        return true;
    }
    if (sscanf(text, "%6d,%6d:%n", &adaptive->strata.x, &adaptive->strata.y, &used) != 2 || !used || !text[used]) {
        cli_usage_error(arguments, "--strata %s: it takes X,Y:FILE, such as 41,60:strata.svg", text);
        return false;
    }
    adaptive->strata_path = text + used;
    adaptive->options.strata = &adaptive->strata;
    return true;
}

bool cli_adaptive_options(const cli_arguments *arguments, cli_adaptive *adaptive, int *code)
{
    const char *text = cli_text(arguments, "adaptive", NULL), *counts = cli_text(arguments, "counts", NULL);
    double budget = 0;
    uint64_t probes = 0;
    *adaptive = (cli_adaptive){.options = {.method = NULL}};
    koksma_status status = counts ? koksma_image_check_path(counts) : KOKSMA_OK;
    status = status || !text ? status : koksma_adaptive_parse(text, &adaptive->options);
    if (!status && cli_flag(arguments, "strata")) {
        koksma_plot_format format;
        status = koksma_plot_format_of(cli_text(arguments, "strata", ""), &format);
    }
    if (status) {
        *code = cli_fail(arguments, status);
        return false;
    }
    *code = CLI_USAGE;
    const koksma_adaptive *method = adaptive->options.method;
    if ((!text && !cli_refuse(arguments, "budget probe strata", "needs --adaptive METHOD")) ||
        (text && method->own_samples &&
         !cli_refuse(arguments, "pattern pairing", "has no effect: the adaptive method %s places its own samples",
                     method->name)) ||
        !parse_strata(arguments, adaptive) || !cli_real(arguments, "budget", 0, 1, KOKSMA_MAX_SPP, &budget) ||
        !cli_whole(arguments, "probe", 0, 0, KOKSMA_MAX_PROBES, &probes)) {
        return false;
    }
    adaptive->options.budget = budget;
    adaptive->options.probes = (int)probes;
    return true;
}

void cli_adaptive_put(cli_rows *rows, const cli_adaptive *adaptive, double pixels)
{
    char method[KOKSMA_MAX_SPEC];
    const koksma_adaptive_report *report = &adaptive->report;
    if (!adaptive->options.method) {
        return;
    }
    koksma_adaptive_text(&adaptive->options, method);
    cli_row_text(rows, "adaptive", method);
    cli_row_number(rows, "mean_spp", (double)report->samples / pixels);
    cli_row_number(rows, "extra", (double)(report->samples - report->first) / pixels);
    if (report->splits) {
        cli_row_whole(rows, "splits", report->splits);
    }
    if (report->splits && adaptive->options.probes) {
        cli_row_number(rows, "needless", (double)report->needless / (double)report->splits);
    }
}

koksma_status cli_adaptive_counts(const cli_arguments *arguments, koksma_image *samples)
{
    const char *path = cli_text(arguments, "counts", NULL);
    const size_t pixels = (size_t)samples->width * (size_t)samples->height;
    float most = 0;
    if (!path) {
        return KOKSMA_OK;
    }
    for (size_t i = 0; i < pixels; i++) {
        most = samples->pixels[i] > most ? samples->pixels[i] : most;
    }
    for (size_t i = 0; cli_has_eight_bits(path) && most > 0 && i < pixels; i++) {
        samples->pixels[i] /= most;
    }
    return koksma_image_write(path, samples, "samples of each pixel");
}

koksma_status cli_adaptive_strata(cli_adaptive *adaptive)
{
    koksma_plot_format format;
    unsigned char *bytes = NULL;
    size_t size;
    char caption[96];
    const koksma_strata *strata = &adaptive->strata;
    if (!adaptive->strata_path) {
        return KOKSMA_OK;
    }
    koksma_strata_panel panels[KOKSMA_MAX_SPACES];
    for (size_t i = 0; i < strata->n_spaces; i++) {
        const koksma_space *space = &strata->spaces[i];
        panels[i] = (koksma_strata_panel){.strata = space->strata,
                                          .n = space->n,
                                          .splits = space->splits,
                                          .n_splits = space->n_splits,
                                          .caption = space->name};
    }
    snprintf(caption, sizeof caption, "pixel %d,%d: %zu strata, samples for %s", strata->x, strata->y,
             strata->spaces[0].n, strata->spaces[0].name);
    panels[0].caption = caption;
    koksma_status status = koksma_plot_format_of(adaptive->strata_path, &format);
    status = status ? status : koksma_plot_strata(panels, strata->n_spaces, 0, format, &bytes, &size);
    status = status ? status : koksma_plot_write(adaptive->strata_path, bytes, size);
    free(bytes);
    koksma_strata_fini(&adaptive->strata);
    return status;
}

/* The option --metric of commands that compare images, and their warning about errors that few pixels carry. */

static bool add(const cli_arguments *arguments, const char *text, bool once, cli_metrics *metrics)
{
    char name[KOKSMA_MAX_SPEC], other[KOKSMA_MAX_SPEC];
    koksma_metric_spec spec;
    if (koksma_metric_parse(text, &spec)) {
        cli_usage_error(arguments, "--metric: %s", koksma_error_text());
        return false;
    }
    koksma_metric_text(&spec, name);
    for (size_t i = 0; i < metrics->n; i++) {
        koksma_metric_text(&metrics->specs[i], other);
        if (!strcmp(name, other)) {
            if (once) {
                cli_usage_error(arguments, "--metric: '%s' is listed twice", name);
            }
            return !once;
        }
    }
    if (metrics->n == CLI_MAX_METRICS) {
        cli_usage_error(arguments, "--metric: more than %d", CLI_MAX_METRICS);
        return false;
    }
    metrics->specs[metrics->n++] = spec;
    return true;
}

bool cli_metrics_parse(const cli_arguments *arguments, bool once, cli_metrics *metrics)
{
    const char *list = cli_text(arguments, "metric", NULL);
    char item[KOKSMA_MAX_SPEC];
    bool good = true;
    if (list && !strcmp(list, "all")) {
        for (size_t i = 0; good && koksma_metric_at(i); i++) {
            good = add(arguments, koksma_metric_at(i)->name, once, metrics);
        }
        return good;
    }
    for (size_t i = 0; list && good && cli_list_item(list, i, item, sizeof item); i++) {
        good = add(arguments, item, once, metrics);
    }
    return good;
}

bool cli_one_metric(const cli_arguments *arguments, cli_metrics *metrics)
{
    const bool good = cli_metrics_parse(arguments, true, metrics);
    if (good && metrics->n > 1) {
        cli_usage_error(arguments, "--metric: it takes one metric; 'koksma compare -m' prints several");
    } else if (good && !metrics->n) {
        metrics->specs[metrics->n++].metric = koksma_metric_find("mae");
    }
    return good && metrics->n == 1;
}

void cli_warn_of_value(const char *command, const char *subject, const char *metric, const koksma_metric_value *value)
{
    if (value->caveat) {
        cli_say(command, "warning: %s: %s", metric, value->caveat);
    }
    cli_warn_of_few_pixels(command, subject, metric, value);
}

void cli_warn_of_few_pixels(const char *command, const char *subject, const char *metric,
                            const koksma_metric_value *value)
{
    if (value->top_share >= KOKSMA_FEW_PIXELS) {
        char robust[CLI_NUMBER];
        cli_say(command, "warning: %s: 0.1 %% of the pixels carry %.0f %% of the error; without them %s is %s",
                subject, 100 * value->top_share, metric, cli_number(value->robust, robust));
    }
}

bool cli_is_image(const char *text)
{
    const char *dot = text ? strrchr(text, '.') : NULL;
    return dot && koksma_image_check_path(text) != KOKSMA_ARGUMENT;
}

bool cli_has_eight_bits(const char *path)
{
    const char *end = strrchr(path, '.');
    return end && (!strcmp(end, ".png") || !strcmp(end, ".jpg") || !strcmp(end, ".jpeg"));
}
