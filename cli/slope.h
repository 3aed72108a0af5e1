/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_SLOPE_H
#define KOKSMA_CLI_SLOPE_H

#include <koksma/series.h>

enum { CLI_MAX_SIZES = 64 };

/* A measure at several sizes over trials, and how the values of a trial vary together: all zero is none. */
typedef struct cli_joint {
    double count, means[CLI_MAX_SIZES];
    double spread[CLI_MAX_SIZES][CLI_MAX_SIZES]; /* sums of products of the deviations from the means */
} cli_joint;

void cli_joint_add(cli_joint *joint, size_t n, const double *values);

/* The line through the means on logarithmic axes. After two trials or more its error is that of the trials' spread;
   after one, which has none, that of the residuals, as koksma_log_line says it. */
bool cli_slope(size_t n, const double *sizes, const double *means, const cli_joint *joint, koksma_line *line);

#endif
