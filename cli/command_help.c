/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma help`, and the overview of all commands that `koksma --help` prints. */
#include <stdio.h>
#include <string.h>

#include "cli.h"

const char cli_overview_examples[] = "koksma rank ball --spp 16 -p random,n-rooks,sobol:scramble=owen\n"
                                     "koksma measure points.txt -m star,l2-star,extreme\n"
                                     "koksma optimise star -n 64 --time-limit 60 -o o.txt\n"
                                     "koksma datasheet points.txt --quick -o sheet.html\n"
                                     "koksma study new plan.json\n";

void cli_print_overview(FILE *stream)
{
    const cli_command *command;
    fputs("koksma: sampling patterns for ray tracing, and the error that they leave\n\n"
          "usage: koksma COMMAND [OPTION]... [OPERAND]...\n\n",
          stream);
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        fprintf(stream, "  %-11s %s\n", command->name, command->summary);
    }
    fputs("\n'koksma COMMAND --help' prints options and examples. Exit codes: 0 done; 1 it\n"
          "ran and the answer is no; 2 the command line is wrong; 3 a named file is\n"
          "missing, malformed or of a kind that is not read; 4 the system failed; 130\n"
          "interrupted, finished results are kept.\n\nexamples:\n",
          stream);
    for (const char *at = cli_overview_examples; *at; at += strcspn(at, "\n") + 1) {
        fprintf(stream, "  %.*s\n", (int)strcspn(at, "\n"), at);
    }
}

static int run(const cli_args *args)
{
    if (args->n_operands > 1) {
        return cli_error(args, "it takes the name of one command, or nothing for an overview of all commands");
    }
    if (args->n_operands == 0) {
        cli_print_overview(stdout);
        return CLI_YES;
    }
    const cli_command *command = cli_command_find(args->operands[0]);
    if (!command) {
        cli_no_command(args->command->name, args->operands[0]);
        return CLI_USAGE;
    }
    cli_print_help(command);
    return CLI_YES;
}

static const cli_option options[] = {{0}};

const cli_command cli_command_help = {
    .name = "help",
    .summary = "describe all commands in one line each, or one command in full",
    .synopsis = "[COMMAND]",
    .details = "Prints the same text as koksma --help, or as koksma COMMAND --help.",
    .examples = "koksma help rank\n",
    .options = options,
    .run = run,
};
