/* SPDX-License-Identifier: Apache-2.0 */
#include <math.h>

#include <koksma/series.h>

#include "stats/quantiles.h"

void koksma_tally_add(koksma_tally *t, double value)
{
    t->count++;
    const double off = value - t->mean;
    t->mean += off / t->count;
    t->spread += off * (value - t->mean);
    t->min = t->count == 1 ? value : fmin(t->min, value);
    t->max = t->count == 1 ? value : fmax(t->max, value);
}

double koksma_tally_sd(const koksma_tally *t)
{
    return t->count > 1 ? sqrt(t->spread / (t->count - 1)) : (double)NAN;
}

double koksma_tally_error(const koksma_tally *t)
{
    return koksma_tally_sd(t) / sqrt(t->count);
}

double koksma_tally_interval(const koksma_tally *t)
{
    return t->count > 1 ? koksma_student_975((size_t)t->count - 1) * koksma_tally_error(t) : (double)NAN;
}

double koksma_student_975(size_t degrees)
{
    return degrees ? koksma__student_quantile(0.975, (double)degrees) : (double)NAN;
}

/* Two passes: sums of squares of what is left when the means are taken off lose no digits. */
bool koksma_log_line(size_t n, const double *xs, const double *ys, koksma_line *line)
{
    double count = 0, x_mean = 0, y_mean = 0, xx = 0, xy = 0, yy = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < n; i++) {
            if (!(xs[i] > 0 && ys[i] > 0 && isfinite(xs[i]) && isfinite(ys[i]))) {
                continue;
            }
            const double x = log(xs[i]) - (pass ? x_mean : 0), y = log(ys[i]) - (pass ? y_mean : 0);
            if (pass == 0) {
                count++;
                x_mean += (x - x_mean) / count;
                y_mean += (y - y_mean) / count;
            } else {
                xx += x * x;
                xy += x * y;
                yy += y * y;
            }
        }
    }
    *line = (koksma_line){(size_t)count, NAN, NAN, NAN};
    if (count < 3 || !(xx > 0)) {
        return false;
    }
    line->slope = xy / xx;
    line->intercept = y_mean - line->slope * x_mean;
    line->slope_error = sqrt(fmax(yy - line->slope * xy, 0) / (count - 2) / xx);
    return true;
}
