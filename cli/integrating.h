/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of `koksma integrate`: integrands, and estimates with intervals or to a tolerance. */
#ifndef KOKSMA_CLI_INTEGRATING_H
#define KOKSMA_CLI_INTEGRATING_H

#include <koksma/estimate.h>
#include <koksma/integrate.h>

#include "source.h"

/* Calls f for each integrand of the first operand, in dim dimensions; of "all" only those that have this dimension.
   Returns the exit code. */
int cli_integrands_each(const cli_args *args, int dim, int (*f)(const koksma_integral *integral, void *context),
                        void *context);

/* Whether the command line asks for estimates in place of errors. */
bool cli_estimates(const cli_args *args);

/* Estimates each integrand, or the function of --with, by each pattern. Returns the exit code. */
int cli_run_estimates(const cli_args *args);

#endif
