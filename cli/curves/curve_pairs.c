/* SPDX-License-Identifier: Apache-2.0 */
/*
 * pairs: the pair correlation on the torus, which is the density of points at a distance from a point divided by the
 * mean density. The correlation is computed in `bins` rings of distances up to r_max. Random points have the value 1.
 */
#include <math.h>
#include <stdlib.h>

#include "../curves.h"

typedef struct pairs_sum {
    koksma_tally *tallies;
    double *values, r_max;
} pairs_sum;

static koksma_status add_pairs(cli_curves *c, const koksma_points *points, void *context)
{
    pairs_sum *s = context;
    if (!(s->r_max > 0)) {
        s->r_max = fmin(4 / sqrt((double)points->n), 0.5);
    }
    const koksma_status status = koksma_pair_correlation(points, s->r_max, c->bins, &c->work.run, s->values);
    for (uint64_t b = 0; b < c->bins && !status; b++) {
        koksma_tally_add(&s->tallies[b], s->values[b]);
    }
    return status;
}

static int compute(cli_curves *c, const char *source, cli_sink *sink)
{
    const size_t bins = c->bins;
    koksma_tally *tallies = calloc(bins, sizeof *tallies);
    pairs_sum s = {tallies, malloc(bins * sizeof(double)), c->r_max};
    const int code = s.values && tallies ? cli_curves_each_set(c, source, add_pairs, &s) : cli_no_memory();
    for (size_t b = 0; tallies && tallies[0].count > 0 && b < bins; b++) {
        sink->row(sink, (double[]){((double)b + 0.5) * s.r_max / (double)bins, tallies[b].mean,
                                   koksma_tally_error(&tallies[b])});
    }
    free(s.values);
    free(tallies);
    return code;
}

const cli_curve cli_curve_pairs = {
    .name = "pairs",
    .meaning = "the pair correlation on the torus; random points have 1",
    .cite = "-",
    .compute = compute,
    .columns = {"distance", "value", "standard_error"},
    .print = {.options = "r-max bins trials"},
    .plot = {.options = "r-max bins trials",
             .draw = cli_draw_chart,
             .title = "Pair correlation",
             .x_label = "distance on the torus",
             .y_label = "relative density; dashed: 1, as for random points",
             .y = 1,
             .error = 2,
             .level = 1},
};
