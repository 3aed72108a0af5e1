/* SPDX-License-Identifier: Apache-2.0 */
/* The program koksma: finds the command that argv[1] names in the table commands.def, and runs it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

/* Refuses KOKSMA_KERNELS with an instruction set that the machine lacks: the library would silently use another one, and
   users would measure the speed of the wrong code. */
static bool kernels_are_there(void)
{
    const char *wish = getenv("KOKSMA_KERNELS");
    if (!wish || !*wish || !strcmp(wish, koksma_instruction_set())) {
        return true;
    }
    cli_say("", "KOKSMA_KERNELS=%s: it takes ref, baseline, avx2 or avx512, if the machine supports it", wish);
    return false;
}

#ifdef _WIN32
#include <windows.h>

#include <shellapi.h>

/* Replaces the arguments, which are in the ANSI code page, by those that were given, in UTF-8. The parts of paths are
   separated by slashes in all of the program, so that a backslash becomes one. */
static char **given_arguments(int *argc)
{
    wchar_t **wide = CommandLineToArgvW(GetCommandLineW(), argc);
    char **argv = wide ? calloc((size_t)*argc + 1, sizeof *argv) : NULL;
    for (int i = 0; argv && i < *argc; i++) {
        const int size = WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, NULL, 0, NULL, NULL);
        argv[i] = malloc((size_t)size + 1);
        if (!argv[i]) {
            exit(koksma_status_exit_code(KOKSMA_MEMORY));
        }
        WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, argv[i], size, NULL, NULL);
        for (char *s = argv[i]; *s; s++) {
            *s = *s == '\\' ? '/' : *s;
        }
    }
    return argv;
}
#endif

int main(int argc, char **argv)
{
#ifdef _WIN32
    int given = 0;
    char **args = given_arguments(&given);
    argc = args ? given : argc;
    argv = args ? args : argv;
    SetConsoleOutputCP(CP_UTF8);
#endif
    cli_begin_output();
    if (!kernels_are_there()) {
        return CLI_USAGE;
    }
    if (argc < 2) {
        cli_print_overview(stderr);
        return CLI_USAGE;
    }
    const char *first = argv[1];
    const cli_command *command = cli_command_find(!strcmp(first, "--help") || !strcmp(first, "-h")      ? "help"
                                                  : !strcmp(first, "--version") || !strcmp(first, "-V") ? "version"
                                                                                                        : first);
    if (!command) {
        cli_no_command("", first);
        return CLI_USAGE;
    }
    return cli_run(command, argc - 1, argv + 1);
}
