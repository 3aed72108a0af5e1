/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_OPTIONS_H
#define KOKSMA_CLI_OPTIONS_H

#include "cli.h"

/* Parses argv (argv[0] is the command's name) by the command's table and runs it; --help prints the table. */
int cli_run(const cli_command *command, int argc, char **argv);

/* The exit code in the end: 4, after a line on stderr, instead of 0 or 1 when stdout could not be written. */
int cli_end_output(int code);

#endif
