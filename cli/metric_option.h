/* SPDX-License-Identifier: Apache-2.0 */
/* Metrics of images on a command line. */
#ifndef CLI_METRIC_OPTION_H
#define CLI_METRIC_OPTION_H

#include <koksma/image.h>

#include "cli.h"

enum { CLI_MAX_METRICS = 16 };

typedef struct cli_metrics {
    size_t n;
    koksma_metric_spec specs[CLI_MAX_METRICS];
} cli_metrics;

/* Adds the metrics of --metric, each once: METRIC,.. or all; without the option nothing. false after a message. */
bool cli_metrics_parse(const cli_arguments *arguments, cli_metrics *metrics);

/* The one metric of --metric, or mae. false after a message. */
bool cli_one_metric(const cli_arguments *arguments, cli_metrics *metrics);

/* Warns when few pixels carry most of the error; subject: of what, such as the pattern. */
void cli_warn_of_few_pixels(const char *command, const char *subject, const char *metric,
                            const koksma_metric_value *value);

#endif
