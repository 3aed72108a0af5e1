/* SPDX-License-Identifier: Apache-2.0 */
#include <stdio.h>

#include "cli.h"

static int run(const cli_arguments *arguments)
{
    if (arguments->n_operands) {
        return cli_usage_error(arguments, "it takes no operands");
    }
    printf("koksma %s\n", koksma_version());
    return CLI_YES;
}

static const cli_option options[] = {{0}};

const cli_command cli_command_version = {
    .name = "version",
    .summary = "print the version",
    .synopsis = "",
    .options = options,
    .run = run,
};
