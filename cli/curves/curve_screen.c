/* SPDX-License-Identifier: Apache-2.0 */
/*
 * screen: how much of the error over the pixels of a screen a filter leaves, beside white noise
 * (koksma_screen_errors). N is the number of samples of a pixel.
 */
#include <koksma/integrate.h>
#include <koksma/maskfile.h>

#include "../curves.h"
#include "../source.h"

enum { SIDE = 64 };

static int compute(cli_curves *c, const char *source, cli_sink *sink)
{
    cli_source opened;
    koksma_screen_row rows[KOKSMA_SCREEN_MAX_DIM];
    koksma_screen_options options = {.side = SIDE, .seed = c->seed, .trials = c->trials};
    const int code = cli_source_open(c->args, source, &opened);
    if (code) {
        return code;
    }
    if (!opened.is_pattern) {
        return cli_error(c->args, "%s: screen takes patterns, SPEC@N with N samples a pixel", source);
    }
    options.dim = opened.dim;
    options.spp = opened.n;
    koksma_status status =
        koksma_mask_filter_parse(cli_text(c->args, "filter", "gaussian:sigma=1.5"), &options.filter);
    if (!status) {
        const size_t all = (size_t)c->args->n_operands - 1;
        cli_work_part(&c->work, c->n_sets++ % all, all);
        status = koksma_screen_errors(&opened.spec, &options, &c->work.run, rows);
        cli_work_end();
    }
    if (status) {
        return cli_fail(c->args, status);
    }
    sink->points = (double)opened.n;
    for (int k = 0; k < options.dim; k++) {
        sink->row(sink, (double[]){rows[k].coordinates, rows[k].plain, rows[k].plain_error, rows[k].blurred,
                                   rows[k].blurred_error});
    }
    return CLI_YES;
}

const cli_curve cli_curve_screen = {
    .name = "screen",
    .meaning =
        "errors of N samples a pixel over images of 64 x 64 pixels, for 100 integrands of 1, 2 .. DIM (at most 4) "
        "coordinates each (steps, ramps, boxes, products, Genz): plain, in units of random points, and after the "
        "filter, in units of white noise with the same plain error",
    .cite = "georgiev2016 heitz2019keys genz1984",
    .compute = compute,
    .columns = {"coordinates", "plain", "plain_standard_error", "blurred", "blurred_standard_error"},
    .print = {.options = "trials filter"},
};
