/* SPDX-License-Identifier: Apache-2.0 */
/*
 * rings: statistics of the power over rings of equal |k|, and two charts of them against |k|: rings draws the mean
 * power, anisotropy the variance of the power along a ring divided by the square of its mean, in dB (Ulichney 1987).
 * For random points the mean power of T sets has relative variance 1/T, so that the anisotropy is -10 log10 T.
 *
 * quality: two numbers that describe a blue-noise spectrum (Heck, Schlomer & Deussen 2013). Up to the effective Nyquist
 * frequency the mean power is less than a tenth of that of random points. The oscillation describes how far the power
 * deviates from 1 beyond that frequency; to compute it, the spectrum must reach about 6.5 sqrt(n).
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
        code = code ? code : status ? cli_fail(c->args, status) : CLI_YES;
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
             .level = 1},
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
             .level = (double)NAN},
};

static int compute_quality(cli_curves *c, const char *source, cli_sink *sink)
{
    koksma_spectrum s;
    const int code = cli_curves_spectrum(c, source, 7, &s);
    if (s.sets > 0) {
        koksma_spectrum_quality_values q;
        koksma_spectrum_quality(&s, &q);
        const char *larger = s.half < KOKSMA_SPECTRUM_MAX_HALF ? "; try a larger --half" : "";
        const bool quiet = cli_flag(c->args, "quiet");
        if (isnan(q.effective_nyquist) && !quiet) {
            cli_say("curve",
                    "%s: the effective Nyquist frequency is not computed, because up to the largest frequency, %d, "
                    "the mean power does not reach half of that of random points%s",
                    source, s.half, larger);
        } else if (isnan(q.oscillation) && !quiet) {
            cli_say("curve",
                    "%s: the oscillation is not computed, because the largest frequency, %d, is less than 5 sqrt(n) "
                    "above the frequency where the power first reaches about 1%s",
                    source, s.half, larger);
        }
        sink->points = s.points;
        sink->row(sink, (double[]){q.effective_nyquist, q.relative_nyquist, q.oscillation});
    }
    koksma_spectrum_fini(&s);
    return code;
}

const cli_curve cli_curve_quality = {
    .name = "quality",
    .meaning = "the effective Nyquist frequency, also divided by sqrt(n)/2 (a whole multiple of 1/sqrt(n)), and "
               "the oscillation (Heck, Schlomer, Deussen 2013). The oscillation needs frequencies up to about 6.5 "
               "sqrt(n); above 85,000 points set --half for this, up to 4096. Memory grows as the square of H: 1 "
               "GB at 2047, 4 GB at 4096",
    .cite = "heck2013",
    .compute = compute_quality,
    .columns = {"effective_nyquist", "relative_nyquist", "oscillation"},
    .print = {.options = "half exact trials"},
};
