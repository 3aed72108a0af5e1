/* SPDX-License-Identifier: Apache-2.0 */
/*
 * rings: statistics of the power over rings of equal |k|, and two charts of them against |k|: rings draws the mean
 * power, anisotropy the variance of the power along a ring divided by the square of its mean, in dB (Ulichney 1987).
 * For random points the mean power of T sets has relative variance 1/T, so that the anisotropy is -10 log10 T.
 */
#include <math.h>
#include <stdlib.h>

#include "../curves.h"

static int compute(cli_curves *c, const char *source, cli_sink *sink)
{
    koksma_spectrum s;
    int code = cli_curves_spectrum(c, source, 2, &s);
    koksma_ring *rings = malloc((size_t)(s.half ? s.half : 1) * sizeof *rings);
    if (s.sets > 0 && !rings) {
        code = cli_no_memory();
    } else if (s.sets > 0) {
        const koksma_status status = koksma_spectrum_rings(&s, rings);
        code = code ? code : status ? cli_fail(c->arguments, status) : CLI_YES;
        sink->points = s.points;
        for (int r = 0; r < s.half && !status; r++) {
            sink->row(sink, (double[]){rings[r].frequency, rings[r].power, rings[r].standard_error,
                                       rings[r].anisotropy_db});
        }
    }
    free(rings);
    koksma_spectrum_fini(&s);
    return code;
}

static double power_of_random(const cli_curves *c)
{
    (void)c;
    return 1;
}

static double anisotropy_of_random(const cli_curves *c)
{
    return -10 * log10((double)c->trials);
}

#define COLUMNS                                                                                                      \
    {                                                                                                                \
        "frequency", "value", "standard_error", "anisotropy_db"                                                      \
    }

const cli_curve cli_curve_rings = {
    .name = "rings",
    .meaning = "the mean of the power over rings of equal |k|, and the anisotropy: the variance of the power along "
               "the ring divided by the square of its mean, in dB (Ulichney 1987). Random points have an anisotropy "
               "of -10 log10 T with T trials; the picture has the mean, and dashed 1, as for random points",
    .cite = "ulichney1987",
    .compute = compute,
    .columns = COLUMNS,
    .print = {.options = "half exact trials"},
    .plot = {.options = "half exact trials",
             .draw = cli_draw_chart,
             .title = "Radial mean of the power spectrum",
             .x_label = "frequency / √n",
             .y_label = "power; dashed: 1, as for random points",
             .y = 1,
             .error = 2,
             .x_per_root = true,
             .level = power_of_random},
};

const cli_curve cli_curve_anisotropy = {
    .name = "anisotropy",
    .meaning = "the variance of the power along a ring divided by the square of its mean; dashed: the value for "
               "random points",
    .cite = "ulichney1987",
    .compute = compute,
    .columns = COLUMNS,
    .plot = {.options = "half exact trials",
             .draw = cli_draw_chart,
             .title = "Anisotropy of the power spectrum",
             .x_label = "frequency / √n",
             .y_label = "anisotropy [dB]; dashed: random points",
             .y = 3,
             .x_per_root = true,
             .level = anisotropy_of_random},
};
