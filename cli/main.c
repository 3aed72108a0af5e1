/* SPDX-License-Identifier: Apache-2.0 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "options.h"

static const cli_command *const commands[] = {
#define COMMAND(name) &cli_command_##name,
#include "commands.def"
#undef COMMAND
    NULL,
};

const cli_command *cli_command_at(size_t i)
{
    return commands[i];
}

static void print_help(FILE *stream)
{
    fputs("koksma: sampling patterns for ray tracing, how irregular they are, and the error that they leave\n\n"
          "usage: koksma COMMAND [OPTION]... [OPERAND]...\n\n",
          stream);
    for (int i = 0; commands[i]; i++) {
        fprintf(stream, "  %-10s %s\n", commands[i]->name, commands[i]->summary);
    }
    fputs("\n'koksma COMMAND --help' says more. Exit codes: 0 done; 1 it ran and the answer is no; 2 the command "
          "line is\n"
          "wrong; 3 a named file is missing or malformed; 4 the system failed; 130 interrupted, what was done is "
          "kept.\n",
          stream);
}

/* Of the environment: an instruction set that is not there would be answered by another's speed. */
static bool kernels_are_there(void)
{
    const char *wish = getenv("KOKSMA_KERNELS");
    if (!wish || !*wish || !strcmp(wish, koksma_instruction_set())) {
        return true;
    }
    fprintf(stderr, "koksma: KOKSMA_KERNELS=%s: it takes ref, baseline, avx2 or avx512, where the machine has it\n",
            wish);
    return false;
}

int main(int argc, char **argv)
{
    if (!kernels_are_there()) {
        return CLI_USAGE;
    }
    if (argc < 2) {
        print_help(stderr);
        return CLI_USAGE;
    }
    if (!strcmp(argv[1], "--help") || !strcmp(argv[1], "-h") || !strcmp(argv[1], "help")) {
        print_help(stdout);
        return cli_end_output(CLI_YES);
    }
    const char *name = !strcmp(argv[1], "--version") ? "version" : argv[1];
    for (int i = 0; commands[i]; i++) {
        if (!strcmp(commands[i]->name, name)) {
            return cli_run(commands[i], argc - 1, argv + 1);
        }
    }
    fprintf(stderr, "koksma: no command '%s'; 'koksma --help' names them\n", argv[1]);
    return CLI_USAGE;
}
