/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_OPTIONS_H
#define KOKSMA_CLI_OPTIONS_H

#include "cli.h"

/* Parses argv (argv[0] is the command's name) by the command's table and runs it; --help prints the table. */
int cli_run(const cli_command *command, int argc, char **argv);

#endif
