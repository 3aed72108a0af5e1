/* SPDX-License-Identifier: Apache-2.0 */
/* Pixel filters and their frequency responses, in one chart. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/render.h>

#include "plots.h"

enum { PLACES = 401, MOST = 16, LABEL = 96 };

/* Decibels below this are drawn here. */
static const double floor_db = -80;

/* The integral of f, by midpoints. */
static double mass(const koksma_filter *filter)
{
    const int n = 4096;
    double sum = 0;
    for (int i = 0; i < n; i++) {
        sum += filter->value(filter->radius * (2 * i + 1 - n) / n);
    }
    return sum * 2 * filter->radius / n;
}

/* Up to 4 cycles a pixel, or 2 pixels from the middle. */
static void fill(const koksma_filter *filter, bool response, double *xs, double *ys)
{
    const double scale = 1 / mass(filter);
    for (int i = 0; i < PLACES; i++) {
        xs[i] = (response ? 4.0 : 4.4) * i / (PLACES - 1) - (response ? 0 : 2.2);
        if (response) {
            ys[i] = fmax(20 * log10(fabs(koksma_filter_response(filter, xs[i]))), floor_db);
        } else {
            ys[i] = fabs(xs[i]) < filter->radius ? scale * filter->value(xs[i]) : 0;
        }
    }
}

int plot_filters(plot_job *j)
{
    const cli_arguments *arguments = j->curves.arguments;
    const bool response = !strcmp(j->curve, "filter-response");
    const int n = arguments->n_operands;
    const koksma_filter *filters[MOST];
    koksma_curve curves[MOST] = {{0}};
    char labels[MOST][LABEL];
    for (int i = 0; i < n; i++) {
        filters[i] = koksma_filter_find(arguments->operands[i]);
        if (!filters[i]) {
            return cli_usage_error(arguments, "no filter '%s'; 'koksma list filters' names them",
                                   arguments->operands[i]);
        }
    }
    double *numbers = malloc(2 * PLACES * (size_t)n * sizeof *numbers);
    if (!numbers) {
        return cli_no_memory();
    }
    for (int i = 0; i < n; i++) {
        double *xs = numbers + (size_t)i * 2 * PLACES, *ys = xs + PLACES;
        fill(filters[i], response, xs, ys);
        snprintf(labels[i], LABEL, "%s", filters[i]->name);
        if (response) {
            snprintf(labels[i], LABEL, "%s: %.3f at 1/2, leakage %.1f %%", filters[i]->name,
                     koksma_filter_response(filters[i], 0.5), 100 * koksma_filter_leakage(filters[i]));
        }
        curves[i] = (koksma_curve){.label = labels[i], .n = PLACES, .xs = xs, .ys = ys, .colour = (size_t)i};
    }
    koksma_chart chart = {.x_label = response ? "cycles a pixel" : "pixels from the middle",
                          .y_label = response ? "response [dB], -80 at least" : "filter, of integral 1",
                          .curves = curves,
                          .n_curves = (size_t)n};
    const int code = plot_chart(j, &chart);
    free(numbers);
    return code;
}
