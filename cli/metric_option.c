/* SPDX-License-Identifier: Apache-2.0 */
/* The option --metric of commands that compare images, and their warning about errors that few pixels carry. */
#include "metric_option.h"

#include <string.h>

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
