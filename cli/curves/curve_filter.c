/* SPDX-License-Identifier: Apache-2.0 */
/*
 * filter and filter-response: pixel filters, scaled to integral 1, and the absolute values of their frequency
 * responses in decibels, all filters in one chart. Leakage is the fraction of the squared response above half a cycle
 * per pixel.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <koksma/render.h>

#include "../curves.h"

enum { POSITIONS = 401, LABEL = 96 };

/* Responses below this level, in decibels, are drawn at this level. */
static const double floor_db = -80;

/* Returns the integral of a filter, by the midpoint rule. */
static double mass(const koksma_filter *filter)
{
    const int n = 4096;
    double sum = 0;
    for (int i = 0; i < n; i++) {
        sum += filter->value(filter->radius * (2 * i + 1 - n) / n);
    }
    return sum * 2 * filter->radius / n;
}

/* Computes a filter at positions up to 2.2 pixels from its middle, or its response at frequencies up to 4 cycles a
   pixel. */
static void fill(const koksma_filter *filter, bool response, double *xs, double *ys)
{
    const double scale = 1 / mass(filter);
    for (int i = 0; i < POSITIONS; i++) {
        xs[i] = (response ? 4.0 : 4.4) * i / (POSITIONS - 1) - (response ? 0 : 2.2);
        if (response) {
            ys[i] = fmax(20 * log10(fabs(koksma_filter_response(filter, xs[i]))), floor_db);
        } else {
            ys[i] = fabs(xs[i]) < filter->radius ? scale * filter->value(xs[i]) : 0;
        }
    }
}

static int draw(cli_curves *c)
{
    const cli_args *args = c->args;
    const bool response = c->curve == &cli_curve_filter_response;
    const int n = args->n_operands;
    const koksma_filter *filters[CLI_MAX_PANELS];
    koksma_curve curves[CLI_MAX_PANELS] = {{0}};
    char labels[CLI_MAX_PANELS][LABEL];
    for (int i = 0; i < n; i++) {
        filters[i] = koksma_filter_find(args->operands[i]);
        if (!filters[i]) {
            return cli_no_member(args, "filter", args->operands[i]);
        }
    }
    double *numbers = malloc(2 * POSITIONS * (size_t)n * sizeof *numbers);
    if (!numbers) {
        return cli_no_memory();
    }
    for (int i = 0; i < n; i++) {
        double *xs = numbers + (size_t)i * 2 * POSITIONS, *ys = xs + POSITIONS;
        fill(filters[i], response, xs, ys);
        snprintf(labels[i], LABEL, "%s", filters[i]->name);
        if (response) {
            snprintf(labels[i], LABEL, "%s: %.3f at 1/2, leakage %.1f %%", filters[i]->name,
                     koksma_filter_response(filters[i], 0.5), 100 * koksma_filter_leakage(filters[i]));
        }
        curves[i] = (koksma_curve){.label = labels[i], .n = POSITIONS, .xs = xs, .ys = ys, .colour = (size_t)i};
    }
    koksma_chart chart = {.x_label = response ? "cycles a pixel" : "pixels from the middle",
                          .y_label = response ? "response [dB], cut off at -80" : "filter, of integral 1",
                          .curves = curves,
                          .n_curves = (size_t)n};
    const int code = cli_write_chart(c, response ? "Frequency responses of pixel filters" : "Pixel filters", &chart);
    free(numbers);
    return code;
}

const cli_curve cli_curve_filter = {
    .name = "filter",
    .meaning = "pixel filters; the operands are names of filters",
    .cite = "-",
    .plot = {.options = "", .draw = draw, .of_filters = true},
};

const cli_curve cli_curve_filter_response = {
    .name = "filter-response",
    .meaning = "frequency responses of pixel filters; leakage is the fraction of the squared response above half a "
               "cycle per pixel",
    .cite = "-",
    .plot = {.options = "", .draw = draw, .of_filters = true},
};
