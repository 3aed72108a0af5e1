/* SPDX-License-Identifier: Apache-2.0 */
/*
 * prefixes and prefix-ratios: the price of being progressive. The first n points of a sequence cannot be as even for
 * every n as a set that is made for this n. The ratio compares the two:
 *
 *     ratio(n) = D*(first n points) / D*(best known set of n points),   n = 8, 9, .., N
 *
 * D* is the star discrepancy, and the sets are those of the pattern `record`: in 2 dimensions there is one for every n up
 * to 128 and for some beyond, in 3 dimensions for few n; other n are left out. With several trials D* is the mean over
 * the sets. `prefix-ratios` has a row for each n, `prefixes` the mean and the largest ratio.
 */
#include <koksma/optimise.h>

#include <stdlib.h>
#include <string.h>

#include "../curves.h"
#include "../source.h"

enum { FIRST = 8 };

/* The mean star discrepancy of the prefixes of each size that has a record. */
typedef struct prefixes {
    size_t count, sets;
    struct prefix {
        size_t n;
        double record, sum;
    } * sizes;
} prefixes;

/* Lists the sizes of at least FIRST and at most `n` points that have a record. */
static koksma_status list_sizes(prefixes *p, const koksma_points *points)
{
    const koksma_record *r;
    size_t records = 0;
    while (koksma_record_at(records)) {
        records++;
    }
    p->sizes = malloc(records * sizeof *p->sizes);
    if (!p->sizes) {
        return KOKSMA_MEMORY;
    }
    for (size_t i = 0; (r = koksma_record_at(i)); i++) {
        if (!strcmp(r->measure, "star") && r->dim == points->dim && r->n >= FIRST && r->n <= points->n) {
            p->sizes[p->count++] = (struct prefix){.n = r->n, .record = r->value};
        }
    }
    return KOKSMA_OK;
}

static koksma_status add_set(cli_curves *c, const koksma_points *points, void *context)
{
    prefixes *p = context;
    koksma_spec star;
    koksma_status status = koksma_measure_spec("star", &star);
    status = status || p->sizes ? status : list_sizes(p, points);
    for (size_t i = 0; i < p->count && !status; i++) {
        const koksma_points prefix = {.n = p->sizes[i].n, .dim = points->dim, .xs = points->xs};
        koksma_value value = {0};
        status = koksma_evaluate(&star, &prefix, &c->work.run, &value);
        p->sizes[i].sum += value.value;
    }
    p->sets += status == KOKSMA_OK;
    return status;
}

/* Computes the ratios of a source, and passes to the sink one row for each size, or their mean and maximum. */
static int compute(cli_curves *c, const char *source, cli_sink *sink)
{
    const bool each = c->curve == &cli_curve_prefix_ratios;
    prefixes p = {0};
    int code = cli_curves_each_set(c, source, add_set, &p);
    double mean = 0, worst = 0, at = 0;
    if (!code && p.count == 0) {
        code = cli_error(c->args,
                         "%s: no prefix has a size whose smallest star discrepancy is stored; 8 or more points "
                         "in 2 or 3 dimensions would do ('koksma list records')",
                         source);
    }
    for (size_t i = 0; i < p.count && !code; i++) {
        const double n = (double)p.sizes[i].n, star = p.sizes[i].sum / (double)p.sets,
                     ratio = star / p.sizes[i].record;
        mean += ratio / (double)p.count;
        at = ratio > worst ? n : at;
        worst = ratio > worst ? ratio : worst;
        sink->points = (double)p.sizes[p.count - 1].n;
        if (each) {
            sink->row(sink, (double[]){n, star, p.sizes[i].record, ratio});
        }
    }
    if (!code && !each) {
        sink->row(sink, (double[]){mean, worst, at});
    }
    free(p.sizes);
    return code;
}

const cli_curve cli_curve_prefixes = {
    .name = "prefixes",
    .meaning =
        "the price of being progressive: the mean and the largest ratio of the star discrepancy of the first n "
        "points to that of the best known set of n points, for n = 8, 9, .. up to the number of points, as "
        "far as 'koksma list records' has a set; with --trials ratios of the mean discrepancy",
    .cite = "clement2023",
    .compute = compute,
    .columns = {"mean", "worst", "worst_n"},
    .print = {.options = "trials"},
};

const cli_curve cli_curve_prefix_ratios = {
    .name = "prefix-ratios",
    .meaning = "these ratios for each n",
    .cite = "clement2023",
    .compute = compute,
    .columns = {"n", "star", "record", "ratio"},
    .print = {.options = "trials"},
    .plot = {.options = "trials",
             .draw = cli_draw_chart,
             .title = "Star discrepancy of the first n points",
             .x_label = "n",
             .y_label = "ratio to the best known set",
             .y = 3,
             .level = 1,
             .mixes_files = true},
};
