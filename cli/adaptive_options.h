/* SPDX-License-Identifier: Apache-2.0 */
/* The options of adaptive sampling, and what they print. */
#ifndef KOKSMA_CLI_ADAPTIVE_OPTIONS_H
#define KOKSMA_CLI_ADAPTIVE_OPTIONS_H

#include <koksma/adaptive.h>

#include "cli.h"

#define CLI_ADAPTIVE_OPTIONS                                                                                         \
    {0, "adaptive", "METHOD", "take more samples where needed; see 'koksma list adaptive'"},                         \
        {0, "budget", "SPP", "with --adaptive: the most samples a pixel, on average (default: no limit)"},           \
        {0, "strata", "X,Y:FILE", "with --adaptive: draw how pixel X,Y was split; .svg, .pdf or .png"},              \
        {0, "probe", "K", "with --adaptive: K extra samples find needless splits (default: 0)"},                     \
    {                                                                                                                \
        0, "counts", "FILE", "image of the number of samples of each pixel; in .png 1 is the largest"                \
    }

/* How the samples are spread; without a method as many in each pixel. */
typedef struct cli_adaptive {
    koksma_adaptive_options options;
    koksma_adaptive_report report;
    koksma_strata strata;
    const char *strata_path; /* NULL: not asked for */
} cli_adaptive;

/* Values of those options; false after an error, whose code is in *code. */
bool cli_adaptive_options(const cli_arguments *arguments, cli_adaptive *adaptive, int *code);

/* Columns of a row. */
void cli_adaptive_put(cli_rows *rows, const cli_adaptive *adaptive, double pixels);

/* Writes --counts, if asked for; scales a .png's numbers in place. */
koksma_status cli_adaptive_counts(const cli_arguments *arguments, koksma_image *samples);

/* Writes --strata, if asked for, and frees them. */
koksma_status cli_adaptive_strata(cli_adaptive *adaptive);

#endif
