/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of `koksma integrate`: integrands, and estimates with intervals or to a tolerance. */
#ifndef KOKSMA_CLI_INTEGRATING_H
#define KOKSMA_CLI_INTEGRATING_H

#include <koksma/estimate.h>
#include <koksma/integrate.h>

#include "source.h"

#define CLI_ESTIMATE_OPTIONS                                                                                         \
    {0, "tolerance", "ERROR",                                                                                        \
     "double the points until the error is at most ERROR; exit code 1 if the limit ends it"},                        \
        {0, "relative", NULL, "with --tolerance: ERROR is relative to the integral"},                                \
        {0, "max-points", "N", "with --tolerance: limit of the points of all sets together (default: 16777216)"},    \
        {0, "resume", "FILE", "with --tolerance: keep the steps in FILE, and continue those that are there"},        \
        {0, "estimator", "ESTIMATOR", "print an estimate; see 'koksma list estimators' (default: the interval's)"},  \
        {0, "interval", "INTERVAL",                                                                                  \
         "of an estimate; see 'koksma list intervals' (default: the estimator's, or auto)"},                         \
        {0, "replicates", "R", "independent sets of an estimate (default: 15, or 8 parts of one set; see below)"},   \
        {0, "confidence", "C", "of the interval, above 0 and below 1 (default: 0.95)"},                              \
        {0, "range", "LOW,HIGH", "bounds of the function's values, for intervals that need them"},                   \
    {                                                                                                                \
        0, "with", "PROGRAM",                                                                                        \
            "estimate the function that the shell command PROGRAM computes: points on its stdin, values on its "     \
            "stdout"                                                                                                 \
    }

/* Calls f for each integrand of the first operand, in dim dimensions; of "all" only those that have this dimension.
   Returns the exit code. */
int cli_integrands_each(const cli_arguments *arguments, int dim,
                        int (*f)(const koksma_integral *integral, void *context), void *context);

/* Whether the command line asks for estimates in place of errors. */
bool cli_estimates(const cli_arguments *arguments);

/* Estimates each integrand, or the function of --with, by each pattern. Returns the exit code. */
int cli_run_estimates(const cli_arguments *arguments);

#endif
