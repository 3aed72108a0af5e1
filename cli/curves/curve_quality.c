/* SPDX-License-Identifier: Apache-2.0 */
/*
 * quality: two numbers that describe a blue-noise spectrum (Heck, Schlomer & Deussen 2013). Up to the effective
 * Nyquist frequency the mean power is less than a tenth of that of random points. The oscillation describes how far
 * the power deviates from 1 beyond that frequency; to compute it, the spectrum must reach about 6.5 sqrt(n).
 */
#include <math.h>
#include <stdio.h>

#include "../curves.h"

static int compute(cli_curves *c, const char *source, cli_sink *sink)
{
    koksma_spectrum s;
    const int code = cli_curves_spectrum(c, source, 7, &s);
    if (s.sets > 0) {
        koksma_spectrum_quality_values q;
        koksma_spectrum_quality(&s, &q);
        const char *larger = s.half < KOKSMA_SPECTRUM_MAX_HALF ? "; try a larger --half" : "";
        const bool quiet = cli_flag(c->arguments, "quiet");
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
    .compute = compute,
    .columns = {"effective_nyquist", "relative_nyquist", "oscillation"},
    .print = {.options = "half exact trials"},
};
