/* SPDX-License-Identifier: Apache-2.0 */
/* measure --at: the local discrepancy of points at a corner. */
#ifndef KOKSMA_CLI_LOCAL_H
#define KOKSMA_CLI_LOCAL_H

#include "cli.h"

/* A row for each source; returns the exit code. */
int measure_local(const cli_arguments *arguments);

#endif
