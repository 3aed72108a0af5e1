/* SPDX-License-Identifier: Apache-2.0 */
/* The statistics of koksma/series.h. Running means and sums of squared deviations are updated one value at a time
   (Welford 1962), so that values need not be stored and no digits are lost; a line is fitted through points on
   logarithmic axes. */
#include <math.h>

#include <koksma/series.h>

#include "core/status.h"
#include "stats/least_squares.h"
#include "stats/quantiles.h"

void koksma_tally_add(koksma_tally *tally, double value)
{
    KOKSMA__REQUIRE_OR(, tally);
    tally->count++;
    const double off = value - tally->mean;
    tally->mean += off / tally->count;
    tally->spread += off * (value - tally->mean);
    tally->min = tally->count == 1 ? value : fmin(tally->min, value);
    tally->max = tally->count == 1 ? value : fmax(tally->max, value);
}

double koksma_tally_sd(const koksma_tally *tally)
{
    KOKSMA__REQUIRE_OR(NAN, tally);
    return tally->count > 1 ? sqrt(tally->spread / (tally->count - 1)) : (double)NAN;
}

double koksma_tally_error(const koksma_tally *tally)
{
    KOKSMA__REQUIRE_OR(NAN, tally);
    return koksma_tally_sd(tally) / sqrt(tally->count);
}

double koksma_tally_interval(const koksma_tally *tally)
{
    KOKSMA__REQUIRE_OR(NAN, tally);
    return tally->count > 1 ? koksma_student_975((size_t)tally->count - 1) * koksma_tally_error(tally) : (double)NAN;
}

double koksma_student_975(size_t degrees)
{
    return degrees ? koksma__student_quantile(0.975, (double)degrees) : (double)NAN;
}

bool koksma_log_line(size_t n, const double *xs, const double *ys, koksma_line *line)
{
    KOKSMA__REQUIRE_OR(false, xs, ys, line);
    if (koksma__array_check("xs", xs, n, sizeof *xs)) {
        return false;
    }
    koksma__fit fit = {0};
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < n; i++) {
            if (xs[i] > 0 && ys[i] > 0 && isfinite(xs[i]) && isfinite(ys[i])) {
                (pass ? koksma__fit_add : koksma__fit_mean)(&fit, log(xs[i]), log(ys[i]), 1);
            }
        }
    }
    *line = (koksma_line){(size_t)fit.weight, NAN, NAN, NAN};
    if (fit.weight < 3 || !(fit.xx > 0)) {
        return false;
    }
    line->slope = koksma__fit_slope(&fit);
    line->intercept = fit.y - line->slope * fit.x;
    line->slope_error = sqrt(fmax(fit.yy - line->slope * fit.xy, 0) / (fit.weight - 2) / fit.xx);
    return true;
}
