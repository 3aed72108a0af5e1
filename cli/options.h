/* SPDX-License-Identifier: Apache-2.0 */
/* Parses command lines by option tables, and prints the help. */
#ifndef KOKSMA_CLI_OPTIONS_H
#define KOKSMA_CLI_OPTIONS_H

#include <stdio.h>

#include "cli.h"

/* cli_print_overview prints a line for each command, as `koksma --help` does. cli_print_help prints the help of one
   command on stdout. */
void cli_print_overview(FILE *stream);
extern const char cli_overview_examples[]; /* command lines, one per line: the five examples of README.md */
void cli_print_help(const cli_command *command);

/* Parses argv (argv[0] is the command's name) by the command's option table and runs the command. --help and -h print
   its help instead. Returns the exit code. */
int cli_run(const cli_command *command, int argc, char **argv);

#endif
