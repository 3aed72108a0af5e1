/* SPDX-License-Identifier: Apache-2.0 */
#include <math.h>

#include <koksma/image.h>

#include "cli.h"

static int put_row(const cli_arguments *arguments, const koksma_image_error *error)
{
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    cli_row_number(rows, "mean", error->mean);
    cli_row_number(rows, "sd", error->sd);
    cli_row_number(rows, "max", error->max);
    cli_row_number(rows, "rmse", error->rmse);
    cli_row_end(rows);
    return cli_rows_close(rows);
}

static koksma_status read_numbers(const char *path, koksma_image *image)
{
    const koksma_status status = koksma_image_read(path, image);
    return status ? status : koksma_image_check_finite(image, path);
}

static koksma_status write_difference(const char *path, const koksma_image *image, const koksma_image *reference)
{
    koksma_image difference;
    koksma_status status = koksma_image_difference(image, reference, &difference);
    if (!status) {
        status = koksma_image_write(path, &difference, "absolute error in luminance");
        koksma_image_fini(&difference);
    }
    return status;
}

static int run(const cli_arguments *arguments)
{
    koksma_image image = {0}, reference = {0};
    koksma_image_error error;
    double most;
    if (arguments->n_operands != 2) {
        return cli_usage_error(arguments, "it takes two images, the second of them the reference");
    }
    if (!cli_real(arguments, "max-mean", INFINITY, 0, 1e300, &most)) {
        return CLI_USAGE;
    }
    const char *output = cli_text(arguments, "output", NULL);
    koksma_status status = read_numbers(arguments->operands[0], &image);
    status = status ? status : read_numbers(arguments->operands[1], &reference);
    status = status ? status : koksma_image_compare(&image, &reference, &error);
    if (!status && output) {
        status = write_difference(output, &image, &reference);
    }
    koksma_image_fini(&image);
    koksma_image_fini(&reference);
    if (status) {
        return cli_fail(arguments, status);
    }
    const int code = put_row(arguments, &error);
    return code ? code : error.mean <= most ? CLI_YES : CLI_NO;
}

static const cli_option options[] = {
    {'o', "output", "FILE", "the picture of the absolute errors"},
    {0, "max-mean", "E", "exit code 1 when the mean absolute error is above E"},
    CLI_ROW_OPTIONS,
    {0},
};

const cli_command cli_command_compare = {
    .name = "compare",
    .summary = "the error of an image against a reference",
    .synopsis = "IMAGE REFERENCE [-o DIFFERENCE] [--max-mean E]",
    .details =
        "Mean, standard deviation and maximum of the absolute error in luminance, and the root mean square error.\n"
        "An image with a pixel that is no finite number is malformed.",
    .options = options,
    .run = run,
};
