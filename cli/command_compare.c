/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma compare`: compares images with a reference. Prints how large the errors are, as means over the images, and
   the coherence of the errors of all images. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <koksma/image.h>

#include "cli.h"
#include "rendering.h"

/* Sums over the images that have been compared so far. */
typedef struct comparison {
    koksma_image reference;
    koksma_coherence coherence;
    size_t images;
    koksma_image_error error;                    /* sums over the images */
    cli_metrics metrics;                         /* rmse, and the metrics of --metric */
    koksma_metric_value values[CLI_MAX_METRICS]; /* sums over the images, except `top`, which is that of the last
                                                    image */
    /* the path of the image that is being compared, or NULL */
    const char *compared;
} comparison;

/* Adds the columns of the metrics. The first metric is rmse, which put_row prints already. JSON rows also have the
   value without the 0.1 % of the pixels that have the largest error, and the fraction of the error in these pixels.
   */
static void put_metrics(cli_rows *rows, const comparison *c, bool json)
{
    for (size_t i = 0; i < c->metrics.n; i++) {
        char name[KOKSMA_MAX_SPEC], text[KOKSMA_MAX_SPEC + 16];
        koksma_metric_text(&c->metrics.specs[i], name);
        const koksma_metric_value *sum = &c->values[i];
        const double images = (double)c->images;
        const koksma_metric_value mean = {sum->value / images, sum->robust / images, sum->top_share / images,
                                          sum->top, sum->caveat};
        if (i) {
            cli_row_number(rows, name, mean.value);
        }
        if (json) {
            snprintf(text, sizeof text, "%s_robust", name);
            cli_row_number(rows, text, mean.robust);
            snprintf(text, sizeof text, "%s_top_share", name);
            cli_row_number(rows, text, mean.top_share);
        }
        cli_warn_of_value("compare", c->images > 1 ? "mean of the images" : "image", name, &mean);
    }
}

static int put_row(const cli_arguments *arguments, const comparison *c)
{
    const bool json = cli_flag(arguments, "json");
    const double images = (double)c->images;
    koksma_coherence_values values;
    koksma_coherence_find(&c->coherence, &values);
    cli_rows *rows = cli_rows_open(json);
    cli_row_number(rows, "mean", c->error.mean / images);
    cli_row_number(rows, "sd", c->error.sd / images);
    cli_row_number(rows, "max", c->error.max / images);
    cli_row_number(rows, "rmse", c->error.rmse / images);
    put_metrics(rows, c, json);
    cli_row_number(rows, "coherence", values.coherence);
    if (json) {
        cli_row_number(rows, "coherence_low", values.low);
        cli_row_number(rows, "coherence_high", values.high);
        cli_row_number(rows, "noise_low", values.noise_low);
    }
    cli_row_number(rows, "noise_high", values.noise_high);
    if (json) {
        cli_row_number(rows, "p", values.p);
        cli_row_number(rows, "frequency_x", values.frequency_x);
        cli_row_number(rows, "frequency_y", values.frequency_y);
        cli_row_number(rows, "common", values.common);
    }
    cli_row_flag(rows, "coherent", values.coherent);
    if (json || c->images > 1) {
        cli_row_whole(rows, "images", c->images);
    }
    cli_row_end(rows);
    return cli_rows_close(rows);
}

static koksma_status read_numbers(const char *path, koksma_image *image)
{
    const koksma_status status = koksma_image_read(path, image);
    if (!status && *koksma_image_remark()) {
        cli_say("compare", "%s: warning: %s", path, koksma_image_remark());
    }
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

/* Prints an error. If two images could not be compared, the message names both, because either may be the wrong
   one. */
static int fail(const cli_arguments *arguments, const comparison *c, const char *reference, koksma_status status)
{
    if (!c->compared) {
        return cli_fail(arguments, status);
    }
    cli_say("compare", "%s and %s: %s", c->compared, reference, koksma_error_text());
    return koksma_status_exit_code(status);
}

static koksma_status add_metrics(comparison *c, const koksma_image *image)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < c->metrics.n; i++) {
        koksma_metric_value value;
        status = koksma_metric_evaluate(&c->metrics.specs[i], image, &c->reference, &value);
        if (!status) {
            c->values[i].value += value.value;
            c->values[i].robust += value.robust;
            c->values[i].top_share += value.top_share;
            c->values[i].top = value.top;
            c->values[i].caveat = value.caveat; /* of the reference: the same for all images */
        }
    }
    return status;
}

/* Adds the errors of the image in the file `path`. difference: the file for an image of the errors, or NULL. */
static koksma_status add_image(comparison *c, const char *path, const char *difference)
{
    koksma_image image = {0};
    koksma_image_error error;
    koksma_status status = read_numbers(path, &image);
    c->compared = status ? NULL : path;
    status = status ? status : koksma_image_compare(&image, &c->reference, &error);
    status = status ? status : koksma_coherence_add(&c->coherence, &image, &c->reference);
    status = status ? status : add_metrics(c, &image);
    if (!status) {
        c->compared = NULL;
        c->images++;
        c->error.mean += error.mean;
        c->error.sd += error.sd;
        c->error.max += error.max;
        c->error.rmse += error.rmse;
        status = difference ? write_difference(difference, &image, &c->reference) : KOKSMA_OK;
    }
    koksma_image_fini(&image);
    return status;
}

static int run(const cli_arguments *arguments)
{
    comparison c = {.metrics = {.n = 1, .specs = {{.metric = koksma_metric_find("rmse")}}}};
    double most;
    const char *output = cli_text(arguments, "output", NULL);
    const int last = (int)arguments->n_operands - 1;
    if (last < 1) {
        return cli_usage_error(arguments, "it takes one image or more, and then the reference");
    }
    int n_stdin = 0;
    for (int i = 0; i <= last; i++) {
        n_stdin += !strcmp(arguments->operands[i], "-");
    }
    if (n_stdin > 1) {
        return cli_usage_error(arguments, "-: stdin can be read only once");
    }
    if (output && last > 1) {
        return cli_usage_error(
            arguments, "--output: it draws the errors of one image, but the command line has %d images", last);
    }
    if (!cli_real(arguments, "max-mean", INFINITY, 0, 1e300, &most) ||
        !cli_metrics_parse(arguments, false, &c.metrics)) {
        return CLI_USAGE;
    }
    koksma_status status = read_numbers(arguments->operands[last], &c.reference);
    status = status ? status : koksma_coherence_init(&c.coherence, c.reference.width, c.reference.height);
    for (int i = 0; !status && i < last; i++) {
        status = add_image(&c, arguments->operands[i], output);
    }
    const int code = status ? fail(arguments, &c, arguments->operands[last], status) : put_row(arguments, &c);
    koksma_coherence_fini(&c.coherence);
    koksma_image_fini(&c.reference);
    return code ? code : c.error.mean <= most * (double)c.images ? CLI_YES : CLI_NO;
}

static const cli_option options[] = {
    {'o', "output", "FILE{images}", "write an image of the absolute error (only for a single image)"},
    {'m', "metric", "METRIC,..|all",
     "print further metrics, such as relmse, smape or hdr-flip ('koksma list metrics')"},
    {0, "max-mean", "E", "exit with code 1 if the mean absolute error is above E"},
    CLI_ROW_OPTIONS,
    {0},
};

const cli_command cli_command_compare = {
    .name = "compare",
    .summary = "compare images with a reference: size and kind of the error",
    .synopsis = "IMAGE... REFERENCE [-m METRIC,..] [-o DIFFERENCE] [--max-mean E]",
    .details =
        "Prints mean, standard deviation and maximum of the absolute error in luminance, and the root mean square\n"
        "error. With several images (one pattern with several seeds) it prints their means.\n"
        "--metric adds a column for each metric: its mean over the pixels, for rmse the root of the mean square. A "
        "warning appears if the 0.1 % of the pixels with the largest error (fireflies) have at least half of the "
        "total error; --json has this fraction, and the value without these pixels (..._robust). 0.1 % is rounded "
        "down: images of fewer than 1000 pixels have no such pixels, and no warning. FLIP estimates the error that a "
        "viewer sees at ppd pixels per degree of visual angle (67 for 3840 pixels on 0.7 m, seen from 0.7 m). "
        "grain is the part of the root mean square error at frequencies below 0.05 cycles a pixel, without the "
        "mean.\n"
        "coherence: the peak of the error's power spectrum divided by its mean (by the mean of frequencies as high "
        "if\n"
        "that is larger, so that blue noise counts as noise), averaged over the images. For white\n"
        "noise 95 % of the values lie from noise_low to noise_high. 'coherent' means that white noise has a "
        "coherence this large with a probability below 0.5 %: the error has bands or another pattern, at frequency_x "
        "and frequency_y cycles a pixel (--json). Every pixel must be a finite number.\n",
    .examples = "koksma compare ball.exr reference.exr\n"
                "koksma compare ball.exr reference.exr -o difference.png\n"
                "koksma compare ball.exr reference.exr -m grain,relmse:epsilon=0.001,hdr-flip\n",
    .options = options,
    .run = run,
};
