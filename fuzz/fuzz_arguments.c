/* SPDX-License-Identifier: Apache-2.0 */
/* The command line: lines of the input are the arguments of the command that the first line names. The command itself
   is not run; all its options are read in each way that a command may read them. */
#include <fcntl.h>
#include <unistd.h>

#include "cli.h"
#include "target.h"

enum { MAX_ARGUMENTS = 64 };

static int read_all(const cli_args *args)
{
    char item[KOKSMA_MAX_SPEC];
    for (const cli_option *o = args->command->options; o->name; o++) {
        uint64_t whole;
        double real;
        cli_whole(args, o->name, 0, 1, 100, &whole);
        cli_real(args, o->name, 0, -1, 1, &real);
        const char *text = cli_text(args, o->name, NULL);
        for (size_t i = 0; text && i < 1000 && cli_list_item(text, i, item, sizeof item); i++) {
        }
    }
    return CLI_YES;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static int silent = -1;
    if (silent < 0) { /* the errors are talk on stderr, the help is on stdout */
        silent = open("/dev/null", O_WRONLY);
        dup2(silent, STDOUT_FILENO);
    }
    const int talk = dup(STDERR_FILENO);
    char *text = malloc(size + 1), *argv[MAX_ARGUMENTS + 1], *next = text;
    if (!text) {
        return 0;
    }
    memcpy(text, bytes, size);
    text[size] = '\0';
    int argc = 0;
    while (next && argc < MAX_ARGUMENTS) {
        argv[argc++] = next;
        next = strchr(next, '\n');
        if (next) {
            *next++ = '\0';
        }
    }
    argv[argc] = NULL;
    dup2(silent, STDERR_FILENO);
    const cli_command *command;
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        if (!strcmp(command->name, argv[0])) {
            cli_command copy = *command;
            copy.run = read_all;
            cli_run(&copy, argc, argv);
        }
    }
    dup2(talk, STDERR_FILENO);
    close(talk);
    free(text);
    return 0;
}
