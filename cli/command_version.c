/* SPDX-License-Identifier: Apache-2.0 */
#include <stdio.h>

#include <koksma/render.h>

#include "cli.h"

static int run(const cli_arguments *arguments)
{
    if (arguments->n_operands) {
        return cli_usage_error(arguments, "it takes no operands");
    }
    const char *tracer = koksma_mesh_tracer(), *reader = koksma_mesh_reader();
    printf("koksma %s\n", koksma_version());
    printf("meshes: %s\n", tracer ? tracer : "left out (Embree)");
    printf("mesh files: %s\n", reader ? reader : "left out (assimp)");
    return CLI_YES;
}

static const cli_option options[] = {{0}};

const cli_command cli_command_version = {
    .name = "version",
    .summary = "print the version, and what traces and reads meshes",
    .synopsis = "",
    .options = options,
    .run = run,
};
