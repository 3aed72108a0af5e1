/* SPDX-License-Identifier: Apache-2.0 */
/* The option --metric, and a warning about errors that few pixels carry. */
#ifndef CLI_METRIC_OPTION_H
#define CLI_METRIC_OPTION_H

#include <koksma/image.h>

#include "cli.h"

enum { CLI_MAX_METRICS = 16 };

typedef struct cli_metrics {
    size_t n;
    koksma_metric_spec specs[CLI_MAX_METRICS];
} cli_metrics;

/* Adds each metric of --metric, which is a list or `all`; without this option it adds none. A metric that is listed twice
   is an error if `once`, else it is added once. Returns false after an error. */
bool cli_metrics_parse(const cli_arguments *arguments, bool once, cli_metrics *metrics);

/* Reads --metric as one metric, by default mae. Returns false after an error. */
bool cli_one_metric(const cli_arguments *arguments, cli_metrics *metrics);

/* Warns of a value's caveat, and as below. */
void cli_warn_of_value(const char *command, const char *subject, const char *metric,
                       const koksma_metric_value *value);

/* Warns when few pixels carry most of the error. subject: the beginning of the message, such as a pattern's name. */
void cli_warn_of_few_pixels(const char *command, const char *subject, const char *metric,
                            const koksma_metric_value *value);

#endif
