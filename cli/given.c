/* SPDX-License-Identifier: Apache-2.0 */
/* What the command line gives: the values of options, by their names in the command's table. */
#include <stdlib.h>
#include <string.h>

#include "cli.h"

const cli_option *cli_option_of(const cli_option *options, const char *name)
{
    while (options->name && strcmp(options->name, name) != 0) {
        options++;
    }
    return options->name ? options : NULL;
}

const char *cli_text(const cli_args *args, const char *name, const char *fallback)
{
    const cli_option *option = cli_option_of(args->command->options, name);
    if (!option) {
        abort(); /* a bug: the option table lacks this name */
    }
    const char *value = args->values[option - args->command->options];
    return value ? value : fallback;
}

const char *cli_given(const cli_args *args, const char *name)
{
    return cli_option_of(args->command->options, name) ? cli_text(args, name, NULL) : NULL;
}

bool cli_flag(const cli_args *args, const char *name)
{
    return cli_text(args, name, NULL) != NULL;
}
