/* SPDX-License-Identifier: Apache-2.0 */
/* The options of commands that render or compare images: how samples are drawn, and metrics. */
#include "rendering.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "source.h"

int cli_one_scene(const cli_args *args)
{
    char known[CLI_KNOWN];
    return args->n_operands > 1
               ? cli_error(args,
                           "it takes one scene, and '%s' is one operand more%s; lists have commas, as in "
                           "--spp 4,16 or -p random,n-rooks",
                           args->operands[1], cli_operand_hint(args, args->operands[1], known))
               : cli_error(args, "it takes one scene, such as ball or ./scene.json");
}

bool cli_integrator_and_filter(const cli_args *args, const koksma_integrator **integrator,
                               const koksma_filter **filter)
{
    const char *integrator_name = cli_text(args, "integrator", (*integrator)->name);
    const char *filter_name = cli_text(args, "filter", (*filter)->name);
    *integrator = koksma_integrator_find(integrator_name);
    *filter = koksma_filter_find(filter_name);
    if (!*integrator || !*filter) {
        cli_no_member(args, *integrator ? "filter" : "integrator", *integrator ? filter_name : integrator_name);
    }
    return *integrator && *filter;
}

size_t cli_scene_warnings(const cli_args *args, const char *name, const koksma_scene *scene,
                          const koksma_render_options *options, size_t most)
{
    char text[512];
    size_t n = 0;
    for (; options ? koksma_render_warning(scene, options, n, text, sizeof text)
                   : koksma_scene_warning(scene, n, text, sizeof text);
         n++) {
        if (n < most) {
            cli_say(args->command->name, "%s: warning: %s", name, text);
        }
    }
    if (n > most) {
        cli_say(args->command->name, "%s: %zu more warnings; 'koksma scene check' prints all", name, n - most);
    }
    return n;
}

enum { SMALL = 32, SAMPLES = 16 }; /* the width of a small picture, and its samples a pixel */

void cli_say_black(const cli_args *args, const char *name, int width, int height)
{
    cli_say(args->command->name, "%s: warning: all pixels of %d x %d are black; is the scene in view, and lit?", name,
            width, height);
}

koksma_status cli_look(const cli_args *args, const char *name, const koksma_scene *scene,
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
        cli_say_black(args, name, picture.width, picture.height);
    }
    koksma_image_fini(&picture);
    return status;
}

/* The option --metric of commands that compare images, and their warning about errors that few pixels carry. */

static bool add(const cli_args *args, const char *text, bool once, cli_metrics *metrics)
{
    char name[KOKSMA_MAX_SPEC], other[KOKSMA_MAX_SPEC];
    koksma_metric_spec spec;
    if (koksma_metric_parse(text, &spec)) {
        return !cli_error(args, "--metric: %s", koksma_error_text());
    }
    koksma_metric_text(&spec, name);
    for (size_t i = 0; i < metrics->n; i++) {
        koksma_metric_text(&metrics->specs[i], other);
        if (!strcmp(name, other)) {
            return !once || !cli_error(args, "--metric: '%s' is listed twice", name);
        }
    }
    if (metrics->n == CLI_MAX_METRICS) {
        return !cli_error(args, "--metric: more than %d", CLI_MAX_METRICS);
    }
    metrics->specs[metrics->n++] = spec;
    return true;
}

bool cli_metrics_parse(const cli_args *args, bool once, cli_metrics *metrics)
{
    const char *list = cli_text(args, "metric", "");
    const bool all = !strcmp(list, "all");
    char item[KOKSMA_MAX_SPEC];
    bool good = true;
    for (size_t i = 0; good && all && koksma_metric_at(i); i++) {
        good = add(args, koksma_metric_at(i)->name, once, metrics);
    }
    for (size_t i = 0; good && *list && !all && cli_list_item(list, i, item, sizeof item); i++) {
        good = add(args, item, once, metrics);
    }
    return good;
}

bool cli_one_metric(const cli_args *args, cli_metrics *metrics)
{
    if (!cli_metrics_parse(args, true, metrics)) {
        return false;
    }
    if (!metrics->n) {
        metrics->specs[metrics->n++].metric = koksma_metric_find("mae");
    }
    return metrics->n == 1 || !cli_error(args, "--metric: it takes one metric; 'koksma compare -m' prints several");
}

void cli_warn_of_value(const char *command, const char *subject, const char *metric, const koksma_metric_value *value)
{
    char robust[CLI_NUMBER];
    if (value->caveat) {
        cli_say(command, "warning: %s: %s", metric, value->caveat);
    }
    if (value->top_share >= KOKSMA_FEW_PIXELS) {
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
