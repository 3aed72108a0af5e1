/* SPDX-License-Identifier: Apache-2.0 */
/* Means, standard deviations and intervals of values, and relative changes over pairs. Sums are compensated
   (core/sum.h) and in order of the index, so that equal values give equal bits. If all differences are 0 in exact
   arithmetic, rounding leaves about 1e-16 of the values, and an interval of width 0 would make this difference
   significant. Therefore differences up to 1e-12 of the values count as 0. */
#include "stats/stats.h"

#include <math.h>

#include "core/sum.h"

/* Values that are equal in exact arithmetic and are computed accurately differ by less than this, relative to their
   size. */
#define ROUNDING 1e-12

int koksma__compare(double a, double b)
{
    return fabs(a - b) <= ROUNDING * fmax(fabs(a), fabs(b)) ? 0 : (a > b) - (a < b);
}

koksma__summary koksma__summarize(const double *values, size_t n, size_t stride)
{
    koksma__summary s = {n, NAN, NAN, NAN, NAN, NAN};
    if (n == 0) {
        return s;
    }
    koksma__sum sum = {0}, squares = {0};
    double size = 0;
    s.max = values[0];
    for (size_t i = 0; i < n; i++) {
        koksma__sum_add(&sum, values[i * stride]);
        s.max = fmax(s.max, values[i * stride]);
        size = fmax(size, fabs(values[i * stride]));
    }
    s.mean = koksma__sum_value(&sum) / (double)n;
    for (size_t i = 0; i < n; i++) {
        const double t = values[i * stride] - s.mean;
        koksma__sum_add(&squares, t * t);
    }
    if (n < 2) {
        return s;
    }
    s.sd = sqrt(koksma__sum_value(&squares) / (double)(n - 1));
    if (s.sd <= ROUNDING * size) {
        s.sd = 0;
    }
    const double half = koksma_student_975(n - 1) * s.sd / sqrt((double)n);
    s.low = s.mean - half;
    s.high = s.mean + half;
    return s;
}

/* The standard error of the quotient q = mean a / mean base is about the standard error of the mean of a - q base,
   divided by the mean of base (Cochran 1977, section 6.3). It accounts for the variation of base as well as that of
   a. */
koksma__estimate koksma__relative_change(const double *a, const double *base, size_t n)
{
    const double mean_a = koksma__summarize(a, n, 1).mean, mean = koksma__summarize(base, n, 1).mean;
    const double quotient = koksma__compare(mean_a, mean) ? mean_a / mean : 1;
    koksma__sum squares = {0};
    for (size_t i = 0; i < n; i++) {
        const double expected = quotient * base[i], t = koksma__compare(a[i], expected) ? a[i] - expected : 0;
        koksma__sum_add(&squares, t * t);
    }
    if (n < 2) {
        return (koksma__estimate){quotient - 1, NAN, NAN};
    }
    const double error = sqrt(koksma__sum_value(&squares) / ((double)(n - 1) * (double)n));
    const double half = error > 0 ? koksma_student_975(n - 1) * error / fabs(mean) : 0;
    return (koksma__estimate){quotient - 1, quotient - 1 - half, quotient - 1 + half};
}

koksma__summary koksma__exactly(double value)
{
    return (koksma__summary){1, value, 0, value, value, value};
}

koksma__summary koksma__summarize_sizes(const double *values, size_t n, size_t stride)
{
    koksma__summary s = koksma__summarize(values, n, stride);
    s.low = s.low < 0 ? 0 : s.low;
    return s;
}

void koksma__largest_of(const double *values, size_t n, size_t stride, size_t block, double *mean, double *sd)
{
    koksma_tally largest = {0};
    for (size_t b = 0; b < n / block; b++) {
        koksma_tally_add(&largest, koksma__summarize(values + b * block * stride, block, stride).max);
    }
    *mean = largest.count > 0 ? largest.mean : (double)NAN;
    *sd = koksma_tally_sd(&largest);
}
