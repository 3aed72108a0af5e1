/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_CURVES_H
#define KOKSMA_CLI_CURVES_H

#include <koksma/spectrum.h>

#include "cli.h"

/* What `curve` and `plot` have in common: how curves of a source are made. */
typedef struct cli_curves {
    const cli_arguments *arguments;
    uint64_t seed, trials, half, bins;
    double r_max;
    koksma_spectrum_method method;
    cli_work work;
} cli_curves;

/* means, spectra: strings that say in the help which kinds they go with. */
#define CLI_CURVE_OPTIONS(means, spectra, default_half)                                                              \
    {'s', "seed", "S", "seed for pattern: sources (default: 0)"},                                                    \
        {'t', "trials", "T", means "the mean over T sets with seeds S, S+1, .., with standard errors"},              \
        {0, "half", "H",                                                                                             \
         spectra ": frequencies up to H in each coordinate (default: " default_half "; at most 2047)"},              \
        {0, "exact", NULL, spectra ": sum over all points at each frequency instead of the fast transform"},         \
        {0, "r-max", "R", "pairs: distances up to R (default: 4 / sqrt(n), at most 1/2)"},                           \
    {                                                                                                                \
        0, "bins", "B", "pairs: rings of distances (default: 100)"                                                   \
    }

enum { CLI_DEFAULT_HALF = KOKSMA_SPECTRUM_MAX_HALF / 2 - 1 }; /* the most that nobody asked for */

/* An option that only some kinds have a use for: these, with blanks between. A table ends at a NULL option. */
typedef struct cli_kinds {
    const char *option, *kinds;
} cli_kinds;

/* False after an error when an option is given that the kind has no use for. before: what stands before a kind on the
   command line. */
bool cli_options_fit(const cli_arguments *arguments, const cli_kinds *table, const char *kind, const char *before);

/* Reads CLI_CURVE_OPTIONS and CLI_RUN_OPTIONS; false after an error. */
bool cli_curves_begin(const cli_arguments *arguments, cli_curves *curves);

/* The mean spectrum over the trials, of frequencies up to per_root sqrt(n), at most CLI_DEFAULT_HALF, where --half
   doesn't say. Returns the exit code; what was done until then is in out, which the caller ends with
   koksma_spectrum_fini. */
int cli_curves_spectrum(cli_curves *curves, const char *source, double per_root, koksma_spectrum *out);

/* The mean pair correlation: tallies[0 .. bins-1] about distances (b + 1/2) *r_max / bins. */
int cli_curves_pairs(cli_curves *curves, const char *source, koksma_tally *tallies, double *r_max);

#endif
