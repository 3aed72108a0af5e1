/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma measure --at`: the local discrepancy of points at a corner of a box. */
#ifndef KOKSMA_CLI_LOCAL_H
#define KOKSMA_CLI_LOCAL_H

#include "cli.h"

/* Prints a row for each source. Returns the exit code. */
int measure_local(const cli_arguments *arguments);

#endif
