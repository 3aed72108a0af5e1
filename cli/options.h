/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_OPTIONS_H
#define KOKSMA_CLI_OPTIONS_H

#include <stdio.h>

#include "cli.h"

/* All commands in a line each, as `koksma --help` prints it; one command's table, as its --help does, on stdout. */
void cli_print_overview(FILE *stream);
void cli_print_help(const cli_command *command);

/* Parses argv (argv[0] is the command's name) by the command's table and runs it; --help or -h prints the table. */
int cli_run(const cli_command *command, int argc, char **argv);

/* The exit code in the end: 4, after a line on stderr, instead of 0 or 1 when stdout could not be written. */
int cli_end_output(int code);

#endif
