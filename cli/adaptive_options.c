/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads the options of adaptive sampling for `koksma render` (adaptive_options.h) and refuses options that have no
 * effect with the chosen method. Adds the statistics of the adaptive method to the row of results. Writes --counts,
 * an image of the number of samples of each pixel (in a PNG file divided by the largest number, so that 1 is white),
 * and --strata, a drawing of one pixel's strata.
 */
#include "adaptive_options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "id_colours.h"

/* Returns false, after a usage error, if an option is given that has no effect with a method that places its own
   samples. */
static bool check_idle(const cli_arguments *arguments, const koksma_adaptive *method)
{
    static const char *const idle[] = {"pattern", "pairing"};
    for (size_t i = 0; i < sizeof idle / sizeof *idle; i++) {
        if (method->own_samples && cli_flag(arguments, idle[i])) {
            cli_usage_error(arguments, "--%s has no effect: the adaptive method %s places its own samples", idle[i],
                            method->name);
            return false;
        }
    }
    return true;
}

/* Reads --strata X,Y:FILE. Returns false after a usage error. */
static bool parse_strata(const cli_arguments *arguments, cli_adaptive *adaptive)
{
    const char *text = cli_text(arguments, "strata", NULL);
    int used = 0;
    if (!text) {
        return true;
    }
    if (sscanf(text, "%6d,%6d:%n", &adaptive->strata.x, &adaptive->strata.y, &used) != 2 || !used || !text[used]) {
        cli_usage_error(arguments, "--strata %s: it takes X,Y:FILE, such as 41,60:strata.svg", text);
        return false;
    }
    adaptive->strata_path = text + used;
    adaptive->options.strata = &adaptive->strata;
    return true;
}

bool cli_adaptive_options(const cli_arguments *arguments, cli_adaptive *adaptive, int *code)
{
    static const char *const needy[] = {"budget", "probe", "strata"};
    const char *text = cli_text(arguments, "adaptive", NULL), *counts = cli_text(arguments, "counts", NULL);
    double budget = 0;
    uint64_t probes = 0;
    *adaptive = (cli_adaptive){.options = {.method = NULL}};
    koksma_status status = counts ? koksma_image_check_path(counts) : KOKSMA_OK;
    status = status || !text ? status : koksma_adaptive_parse(text, &adaptive->options);
    if (!status && cli_flag(arguments, "strata")) {
        koksma_plot_format format;
        status = koksma_plot_format_of(cli_text(arguments, "strata", ""), &format);
    }
    if (status) {
        *code = cli_fail(arguments, status);
        return false;
    }
    *code = CLI_USAGE;
    for (size_t i = 0; i < sizeof needy / sizeof *needy; i++) {
        if (!text && cli_flag(arguments, needy[i])) {
            cli_usage_error(arguments, "--%s needs --adaptive METHOD", needy[i]);
            return false;
        }
    }
    if ((text && !check_idle(arguments, adaptive->options.method)) || !parse_strata(arguments, adaptive) ||
        !cli_real(arguments, "budget", 0, 1, KOKSMA_MAX_SPP, &budget) ||
        !cli_whole(arguments, "probe", 0, 0, KOKSMA_MAX_PROBES, &probes)) {
        return false;
    }
    adaptive->options.budget = budget;
    adaptive->options.probes = (int)probes;
    return true;
}

void cli_adaptive_put(cli_rows *rows, const cli_adaptive *adaptive, double pixels)
{
    char method[KOKSMA_MAX_SPEC];
    const koksma_adaptive_report *report = &adaptive->report;
    if (!adaptive->options.method) {
        return;
    }
    koksma_adaptive_text(&adaptive->options, method);
    cli_row_text(rows, "adaptive", method);
    cli_row_number(rows, "mean_spp", (double)report->samples / pixels);
    cli_row_number(rows, "extra", (double)(report->samples - report->first) / pixels);
    if (report->splits) {
        cli_row_whole(rows, "splits", report->splits);
    }
    if (report->splits && adaptive->options.probes) {
        cli_row_number(rows, "needless", (double)report->needless / (double)report->splits);
    }
}

koksma_status cli_adaptive_counts(const cli_arguments *arguments, koksma_image *samples)
{
    const char *path = cli_text(arguments, "counts", NULL);
    const size_t pixels = (size_t)samples->width * (size_t)samples->height;
    float most = 0;
    if (!path) {
        return KOKSMA_OK;
    }
    for (size_t i = 0; i < pixels; i++) {
        most = samples->pixels[i] > most ? samples->pixels[i] : most;
    }
    for (size_t i = 0; cli_has_eight_bits(path) && most > 0 && i < pixels; i++) {
        samples->pixels[i] /= most;
    }
    return koksma_image_write(path, samples, "samples of each pixel");
}

koksma_status cli_adaptive_strata(cli_adaptive *adaptive)
{
    koksma_plot_format format;
    unsigned char *bytes = NULL;
    size_t size;
    char caption[96];
    const koksma_strata *strata = &adaptive->strata;
    if (!adaptive->strata_path) {
        return KOKSMA_OK;
    }
    koksma_strata_panel panels[KOKSMA_MAX_SPACES];
    for (size_t i = 0; i < strata->n_spaces; i++) {
        const koksma_space *space = &strata->spaces[i];
        panels[i] = (koksma_strata_panel){.strata = space->strata,
                                          .n = space->n,
                                          .splits = space->splits,
                                          .n_splits = space->n_splits,
                                          .caption = space->name};
    }
    snprintf(caption, sizeof caption, "pixel %d,%d: %zu strata, samples for %s", strata->x, strata->y,
             strata->spaces[0].n, strata->spaces[0].name);
    panels[0].caption = caption;
    koksma_status status = koksma_plot_format_of(adaptive->strata_path, &format);
    status = status ? status : koksma_plot_strata(panels, strata->n_spaces, 0, format, &bytes, &size);
    status = status ? status : koksma_plot_write(adaptive->strata_path, bytes, size);
    free(bytes);
    koksma_strata_fini(&adaptive->strata);
    return status;
}
