/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma version`: the version, the instruction set of the inner loops, and which optional libraries this build
 * has, as text or JSON.
 */
#include <stdio.h>

#include <koksma/image.h>
#include <koksma/plot.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "cli.h"

static int put_json(void)
{
    const char *format, *left_out;
    cli_row("version %s kernels %s", koksma_version(), koksma_instruction_set());
    for (size_t i = 0; (format = koksma_image_format(i, &left_out)); i++) {
        cli_row_json(format, left_out ? "false" : "true", "");
    }
    cli_row("plots %s mpi %s meshes %s\n", koksma_plot_library(), koksma_study_mpi(), koksma_mesh_tracer());
    return cli_rows_close(CLI_YES);
}

static int run(const cli_args *args)
{
    if (args->n_operands) {
        return cli_error(args, "it takes no operands");
    }
    const char *tracer = koksma_mesh_tracer();
    if (cli_flag(args, "json")) {
        return put_json();
    }
    printf("koksma %s\n", koksma_version());
    printf("kernels: %s\n", koksma_instruction_set());
    const char *format, *left_out;
    for (size_t i = 0; (format = koksma_image_format(i, &left_out)); i++) {
        printf("%s images: %s%s%s\n", format, left_out ? "left out (" : "yes", left_out ? left_out : "",
               left_out ? ")" : "");
    }
    const char *plots = koksma_plot_library(), *mpi = koksma_study_mpi();
    printf("plots: svg; pdf and png: %s\n", plots ? plots : "left out (cairo)");
    printf("MPI: %s\n", mpi ? mpi : "left out");
    printf("meshes: %s\n", tracer ? tracer : "left out (Embree)");
    return CLI_YES;
}

static const cli_option options[] = {{0, "json", NULL, "one JSON object instead of text"}, {0}};

const cli_command cli_command_version = {
    .name = "version",
    .summary = "print the version, the kernels and the optional parts",
    .synopsis = "[--json]",
    .details =
        "kernels: the instruction set of the inner loops, the first of avx512, avx2 and baseline that the "
        "processor has. The environment variable KOKSMA_KERNELS selects another instruction set, or ref (plain C, "
        "for tests). koksma --version and koksma -V print the same.\n",
    .examples = "koksma version --json\n",
    .options = options,
    .run = run,
};
