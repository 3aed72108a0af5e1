/* SPDX-License-Identifier: Apache-2.0 */
/*
 * quality: two numbers that describe a blue-noise spectrum (Heck, Schlomer & Deussen 2013). Up to the effective
 * Nyquist frequency the spectrum holds less than a tenth of the energy of random points. The oscillation describes
 * the spectrum beyond that frequency, and needs frequencies up to about 6.5 sqrt(n).
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
        if (isnan(q.oscillation) && !cli_flag(c->arguments, "quiet")) {
            cli_say("curve", "%s: no oscillation: frequencies up to %d end before 5 sqrt(n) beyond the rise%s",
                    source, s.half, s.half < KOKSMA_SPECTRUM_MAX_HALF ? "; try a larger --half" : "");
        }
        sink->points = s.points;
        sink->row(sink, (double[]){q.effective_nyquist, q.relative_nyquist, q.oscillation});
    }
    koksma_spectrum_fini(&s);
    return code;
}

const cli_curve cli_curve_quality = {
    .name = "quality",
    .meaning =
        "the effective Nyquist frequency, also over sqrt(n)/2 in steps of 1/sqrt(n), so that a square lattice of "
        "16 points has 3/4; and oscillation (Heck, Schlomer, Deussen 2013), which takes frequencies up to about "
        "6.5 sqrt(n): from 85,000 points on --half must ask for them, up to 4096. Memory grows as the square of H: 1 "
        "GB at "
        "2047, 4 GB at 4096",
    .cite = "heck2013",
    .compute = compute,
    .columns = {"effective_nyquist", "relative_nyquist", "oscillation"},
    .print = {.options = "half exact trials"},
};
