/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma compare`: compares images with a reference. Prints how large the errors are, as means over the images, and
   the coherence of the errors of all images. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <koksma/image.h>

#include "cli.h"
#include "rendering.h"

/* The errors of one image, or sums over several. */
typedef struct errors {
    size_t images;
    koksma_image_error error;
    koksma_metric_value
        values[CLI_MAX_METRICS]; /* sums, except `top` and `caveat`, which are those of the last image */
    koksma_coherence coherence;
} errors;

typedef struct comparison {
    const char *reference_path;
    koksma_image reference;
    cli_metrics metrics;  /* rmse, and the metrics of --metric */
    errors all;           /* of all images so far */
    const char *compared; /* the path of the image that is being compared, or NULL */
    bool json;
    int n;           /* number of images on the command line */
    float low, high; /* the range of the values of the images and the reference, and 0 */
} comparison;

/* Adds the columns of the metrics. The first metric is rmse, which put_row prints already. JSON rows also have the
   value without the 0.1 % of the pixels that have the largest error, and the fraction of the error in these pixels.
   */
static void put_metrics(const comparison *c, const errors *e, const char *image)
{
    for (size_t i = 0; i < c->metrics.n; i++) {
        char name[KOKSMA_MAX_SPEC], text[KOKSMA_MAX_SPEC + 16];
        koksma_metric_text(&c->metrics.specs[i], name);
        const koksma_metric_value *sum = &e->values[i];
        const double images = (double)e->images;
        const koksma_metric_value mean = {sum->value / images, sum->robust / images, sum->top_share / images,
                                          sum->top, sum->caveat};
        if (i) {
            cli_row_number(name, mean.value);
        }
        if (c->json) {
            snprintf(text, sizeof text, "%s_robust", name);
            cli_row_number(text, mean.robust);
            snprintf(text, sizeof text, "%s_top_share", name);
            cli_row_number(text, mean.top_share);
        }
        if (e == &c->all) { /* once for all images */
            cli_warn_of_value("compare", c->n > 1 ? "mean of the images" : image, name, &mean);
        }
    }
}

/* Prints a row. image: its name; with several images the last row has their mean. */
static void put_row(const comparison *c, const errors *e, const char *image)
{
    const double images = (double)e->images;
    koksma_coherence_values values;
    koksma_coherence_find(&e->coherence, &values);
    cli_row("image %s", image);
    if (c->json) {
        cli_row("reference %s", c->reference_path);
    }
    cli_row("mean %g sd %g max %g rmse %g", e->error.mean / images, e->error.sd / images, e->error.max / images,
            e->error.rmse / images);
    put_metrics(c, e, image);
    cli_row("coherence %g", values.coherence);
    if (c->json) {
        cli_row("coherence_low %g coherence_high %g noise_low %g", values.low, values.high, values.noise_low);
    }
    cli_row("noise_high %g", values.noise_high);
    if (c->json) {
        cli_row("p %g frequency_x %g frequency_y %g common %g", values.p, values.frequency_x, values.frequency_y,
                values.common);
    }
    cli_row("coherent? %d", values.coherent);
    if (c->json || c->n > 1) {
        cli_row("images %zu", e->images);
    }
    cli_row_end();
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
static int fail(const cli_args *args, const comparison *c, koksma_status status)
{
    if (!c->compared) {
        return cli_fail(args, status);
    }
    cli_say("compare", "%s and %s: %s", c->compared, c->reference_path, koksma_error_text());
    return koksma_status_exit_code(status);
}

static koksma_status add_metrics(const comparison *c, const koksma_image *image, errors *e)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < c->metrics.n; i++) {
        koksma_metric_value value;
        status = koksma_metric_evaluate(&c->metrics.specs[i], image, &c->reference, &value);
        if (!status) {
            e->values[i].value += value.value;
            e->values[i].robust += value.robust;
            e->values[i].top_share += value.top_share;
            e->values[i].top = value.top;
            e->values[i].caveat = value.caveat; /* of the reference: the same for all images */
        }
    }
    return status;
}

/* Adds the errors of an image. */
static koksma_status add_errors(const comparison *c, const koksma_image *image, errors *e)
{
    koksma_image_error error;
    koksma_status status = koksma_image_compare(image, &c->reference, &error);
    status = status ? status : koksma_coherence_add(&e->coherence, image, &c->reference);
    status = status ? status : add_metrics(c, image, e);
    if (!status) {
        e->images++;
        e->error.mean += error.mean;
        e->error.sd += error.sd;
        e->error.max += error.max;
        e->error.rmse += error.rmse;
    }
    return status;
}

/* The row of one of several images. */
static koksma_status put_one(const comparison *c, const koksma_image *image, const char *path)
{
    errors one = {.images = 0};
    koksma_status status = koksma_coherence_init(&one.coherence, c->reference.width, c->reference.height);
    status = status ? status : add_errors(c, image, &one);
    if (!status) {
        put_row(c, &one, path);
    }
    koksma_coherence_fini(&one.coherence);
    return status;
}

/* Widens the range of values, from which no error is larger, to that of an image. */
static void widen(comparison *c, const koksma_image *image)
{
    const size_t n = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    for (size_t i = 0; i < n; i++) {
        c->low = fminf(c->low, image->pixels[i]);
        c->high = fmaxf(c->high, image->pixels[i]);
    }
}

/* Adds the errors of the image in the file `path`. difference: the file for an image of the errors, or NULL. */
static koksma_status add_image(comparison *c, const char *path, const char *difference, bool check_order)
{
    koksma_image image = {0};
    koksma_status status = read_numbers(path, &image);
    c->compared = status ? NULL : path;
    status = status ? status : add_errors(c, &image, &c->all);
    status = status || c->n < 2 ? status : put_one(c, &image, path);
    if (!status) {
        c->compared = NULL;
        status = difference ? write_difference(difference, &image, &c->reference) : KOKSMA_OK;
    }
    const bool alike = cli_has_eight_bits(path) == cli_has_eight_bits(c->reference_path);
    const char *doubt = status ? "" : koksma_image_doubt(&image, &c->reference, check_order && alike);
    if (doubt[0]) {
        cli_say("compare", "%s: warning: %s", path, doubt);
    }
    widen(c, &image);
    koksma_image_fini(&image);
    return status;
}

/* Compares the n images of the operands. Returns the exit code. */
static int compare_all(const cli_args *args, comparison *c, const char *output, bool check_order)
{
    koksma_status status = read_numbers(c->reference_path, &c->reference);
    status = status ? status : koksma_coherence_init(&c->all.coherence, c->reference.width, c->reference.height);
    widen(c, &c->reference);
    for (int i = 0; !status && i < c->n; i++) {
        status = add_image(c, args->operands[i], output, check_order && !i);
    }
    if (!status) {
        put_row(c, &c->all, c->n > 1 ? "mean" : args->operands[0]);
    }
    const int code = cli_rows_close(status ? fail(args, c, status) : CLI_YES);
    koksma_coherence_fini(&c->all.coherence);
    koksma_image_fini(&c->reference);
    return code;
}

static int run(const cli_args *args)
{
    const char *output = cli_text(args, "output", NULL), *reference = cli_text(args, "reference", NULL);
    const int operands = (int)args->n_operands;
    comparison c = {.metrics = {.n = 1, .specs = {{.metric = koksma_metric_find("rmse")}}},
                    .json = cli_flag(args, "json"),
                    .n = reference ? operands : operands - 1};
    double most;
    if (c.n < 1) {
        return cli_error(args, reference ? "it takes one image or more beside --reference"
                                         : "it takes one image or more, and then the reference");
    }
    c.reference_path = reference ? reference : args->operands[c.n];
    if (!reference && !output && c.n > 1 && cli_is_image(c.reference_path) && access(c.reference_path, F_OK)) {
        return cli_error(
            args,
            "%s: there is no such image; the last one is the reference, and '-o %s' writes an image of the "
            "errors",
            c.reference_path, c.reference_path);
    }
    int n_stdin = !strcmp(c.reference_path, "-");
    for (int i = 0; i < c.n; i++) {
        n_stdin += !strcmp(args->operands[i], "-");
    }
    if (n_stdin > 1) {
        return cli_error(args, "-: stdin can be read only once");
    }
    if (output && c.n > 1) {
        return cli_error(args, "--output: it draws the errors of one image, but the command line has %d images", c.n);
    }
    if (!cli_real(args, "max-mean", INFINITY, 0, 1e300, &most) || !cli_metrics_parse(args, false, &c.metrics)) {
        return CLI_USAGE;
    }
    const int code = compare_all(args, &c, output, !reference);
    for (int i = 0; i < c.n && !code; i++) {
        const char *image = args->operands[i];
        if (cli_has_eight_bits(c.reference_path) != cli_has_eight_bits(image)) {
            cli_say("compare", "%s: warning: 8 bits are rounded and clipped, and that is counted as error",
                    cli_has_eight_bits(image) ? image : c.reference_path);
        }
    }
    const double largest = (double)c.high - (double)c.low;
    if (!code && isfinite(most) && most > largest) {
        cli_say("compare", "warning: --max-mean %g: no error of these images can be above %.3g", most, largest);
    }
    return code ? code : c.all.error.mean <= most * (double)c.all.images ? CLI_YES : CLI_NO;
}

static const cli_option options[] = {
    {'r', "reference", "FILE{images}", "the reference; all operands are images then"},
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
    .synopsis = "IMAGE... REFERENCE | IMAGE... -r REFERENCE [-m METRIC,..] [-o DIFFERENCE] [--max-mean E]",
    .details =
        "Prints mean, standard deviation and maximum of the absolute error in luminance, and the root mean square "
        "error. Several images, such as those of one pattern with several seeds, have a row each, and a last row "
        "has their means and the coherence of all errors together. A warning appears if the first image has less "
        "noise than the reference: it may be the reference. --metric adds a column for each metric: its mean over "
        "the pixels, for rmse the root of the mean square. A warning appears if the 0.1 % of the pixels with the "
        "largest error (fireflies) have at least half of the total error; --json has this fraction, and the value "
        "without these pixels (..._robust). 0.1 % is rounded down: images of fewer than 1000 pixels have no such "
        "pixels, and no warning. FLIP estimates the error that a viewer sees at ppd pixels per degree of visual "
        "angle (67 for 3840 pixels on 0.7 m, seen from 0.7 m). grain is the part of the root mean square error at "
        "frequencies below 0.05 cycles a pixel, without the mean.\n"
        "coherence: the peak of the error's power spectrum divided by its mean (by the mean of frequencies as high "
        "if that is larger, so that blue noise counts as noise), averaged over the images. For white noise 95 % of "
        "the values lie from noise_low to noise_high. 'coherent' means that white noise has a coherence this large "
        "with a probability below 0.5 %: the error has bands or another pattern, at frequency_x and frequency_y "
        "cycles a pixel (--json). Every pixel must be a finite number.\n",
    .examples = "koksma compare ball.exr reference.exr\n"
                "koksma compare ball.exr reference.exr -o difference.png\n"
                "koksma compare ball.exr reference.exr -m grain,relmse:epsilon=0.001,hdr-flip\n",
    .options = options,
    .run = run,
};
