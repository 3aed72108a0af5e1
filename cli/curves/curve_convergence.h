/* SPDX-License-Identifier: Apache-2.0 */
/* The chart of a measure against n, which the curves convergence and compare draw. */
#ifndef KOKSMA_CLI_CURVE_CONVERGENCE_H
#define KOKSMA_CLI_CURVE_CONVERGENCE_H

#include "../charts.h"

typedef struct cli_convergence {
    cli_chart_store store; /* the caller closes it, also after a failure */
    char title[160], y_label[160];
    koksma_chart chart;
} cli_convergence;

/* Evaluates --measure for all operands at --sizes and makes the chart. Returns the exit code. */
int cli_convergence_open(cli_curves *c, cli_convergence *v);

#endif
