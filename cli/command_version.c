/* SPDX-License-Identifier: Apache-2.0 */
#include <stdio.h>

#include <koksma/image.h>
#include <koksma/plot.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "cli.h"

static int run(const cli_arguments *arguments)
{
    if (arguments->n_operands) {
        return cli_usage_error(arguments, "it takes no operands");
    }
    const char *tracer = koksma_mesh_tracer(), *reader = koksma_mesh_reader();
    printf("koksma %s\n", koksma_version());
    const char *format, *left_out;
    for (size_t i = 0; (format = koksma_image_format(i, &left_out)); i++) {
        printf("%s images: %s%s%s\n", format, left_out ? "left out (" : "yes", left_out ? left_out : "",
               left_out ? ")" : "");
    }
    const char *plots = koksma_plot_library(), *mpi = koksma_study_mpi();
    printf("plots: %s\n", plots ? plots : "left out (cairo)");
    printf("MPI: %s\n", mpi ? mpi : "left out");
    printf("meshes: %s\n", tracer ? tracer : "left out (Embree)");
    printf("mesh files: %s\n", reader ? reader : "left out (assimp)");
    return CLI_YES;
}

static const cli_option options[] = {{0}};

const cli_command cli_command_version = {
    .name = "version",
    .summary = "print the version, and which optional parts are in",
    .synopsis = "",
    .options = options,
    .run = run,
};
