/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_PLOTS_H
#define KOKSMA_CLI_PLOTS_H

#include <koksma/plot.h>

#include "curves.h"

enum { MAX_CELLS = 4096 };

/* What `plot` is told. */
typedef struct plot_job {
    cli_curves curves;
    const char *output, *witness, *curve;
    const koksma_warp *warp; /* NULL: none */
    uint64_t size;
    koksma_plot_format format;
} plot_job;

/* Each draws the operands in one chart and writes it; returns the exit code. */
int plot_radial(plot_job *j); /* the mean over rings, or the anisotropy */
int plot_pairs(plot_job *j);
int plot_convergence(plot_job *j);
int plot_filters(plot_job *j); /* the operands are filters: their frequency responses, or they themselves */

int plot_chart(const plot_job *j, koksma_chart *chart);

int plot_panels(const plot_job *j, const koksma_panel *panels, size_t n);

/* A source without "pattern:". */
const char *plot_label(const char *source);

#endif
