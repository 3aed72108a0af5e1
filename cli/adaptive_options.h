/* SPDX-License-Identifier: Apache-2.0 */
/* The options of adaptive sampling for `koksma render`: their values, their columns in the row of results, and the
   files that they write. */
#ifndef KOKSMA_CLI_ADAPTIVE_OPTIONS_H
#define KOKSMA_CLI_ADAPTIVE_OPTIONS_H

#include <koksma/adaptive.h>

#include "cli.h"

#define CLI_ADAPTIVE_OPTIONS                                                                                         \
    {0, "adaptive", "METHOD", "take more samples in pixels that need them; see 'koksma list adaptive'"},             \
        {0, "budget", "SPP", "with --adaptive: largest mean number of samples per pixel (default: no limit)"},       \
        {0, "strata", "X,Y:FILE", "with --adaptive: draw how pixel X,Y was split; .svg, .pdf or .png"},              \
        {0, "probe", "K",                                                                                            \
         "with --adaptive: take K more samples to test whether each split was needed (default: 0)"},                 \
    {                                                                                                                \
        0, "counts", "FILE",                                                                                         \
            "write an image of the number of samples of each pixel; in .png and .jpg white is the largest"           \
    }

/* Options and results of adaptive sampling. Without --adaptive, options.method is NULL and every pixel has the same
   number of samples. */
typedef struct cli_adaptive {
    koksma_adaptive_options options;
    koksma_adaptive_report report;
    koksma_strata strata;
    const char *strata_path; /* NULL without --strata */
} cli_adaptive;

/* Reads CLI_ADAPTIVE_OPTIONS into *adaptive. Returns false after an error and sets *code to the exit code. */
bool cli_adaptive_options(const cli_arguments *arguments, cli_adaptive *adaptive, int *code);

/* Adds the columns of adaptive sampling to the current row; without --adaptive it adds none. pixels: the number of
   pixels of the image. */
void cli_adaptive_put(cli_rows *rows, const cli_adaptive *adaptive, double pixels);

/* Writes the image of --counts if that option is given. For a .png or .jpg file it first divides the numbers in
   `samples` by the largest. */
koksma_status cli_adaptive_counts(const cli_arguments *arguments, koksma_image *samples);

/* Writes the drawing of --strata if that option is given, and then frees the strata. */
koksma_status cli_adaptive_strata(cli_adaptive *adaptive);

#endif
