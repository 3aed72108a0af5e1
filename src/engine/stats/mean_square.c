/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The interval of a mean square M of T errors e: M nu / chi2, where chi2 are the 2.5 % and 97.5 % quantiles of
 * chi-squared with nu degrees of freedom. For normal errors nu = T (or T - 1 about their own mean) is exact. For others
 * (Box 1953; Satterthwaite 1946)
 *
 *     nu = 2 T / v,   v = variance of e^2 / M^2 = kurtosis - 1,
 *
 * and few errors rarely contain the large ones that v consists of. So v is the largest of three estimates:
 *
 *     v1 = (1 + 4 / T) sample variance of e^2 / M^2
 *     v2 = 2 + 1.2 (1 + 1.5 / sqrt T) (g^2 - 6 / T), but only where g^2 > 6 / T, with the skewness g of e and its variance
 *          6 / T for normal errors: gamma distributions have v = 2 + 1.5 g^2, and a sample shows its skewness earlier than
 *          its kurtosis
 *     v3 = min(2, v0 + sqrt(24 / T)), with v0 as v1 without its factor: v is below 2 only if it is so significantly
 *
 * What a sample lacks are large errors. So with z = (v - 2) / sqrt T, v - 2 between 0 and 8, the lower bound uses
 * v (1 + z / 2), and the upper one v (1 + 2 z + max(1 - 8 / T, 0) / sqrt T). The factors were chosen by simulation, such
 * that intervals hold in 93 to 97 % for many laws; docs/findings/integration.md has what was measured
 * (tests/stats/test_coverage.c).
 */
#include "stats/stats.h"

#include <math.h>

/* With fewer errors nobody can tell how skewed or heavy-tailed they are. */
enum { TOO_FEW = 16 };

/* The fewest degrees of freedom of a bound: with fewer, it would exceed the mean square by more than a factor of
   a million. */
#define LEAST_DEGREES 0.5

/* Moments of errors: of their squares, and about their own mean. */
typedef struct moments {
    double mean, square, square_spread, second, third;
} moments;

static moments moments_of(const double *values, size_t count, size_t stride, double centre)
{
    moments m = {0};
    for (size_t i = 0; i < count; i++) {
        m.mean += (values[i * stride] - m.mean) / (double)(i + 1);
    }
    for (size_t i = 0; i < count; i++) {
        const double d = values[i * stride] - m.mean, e = isnan(centre) ? d : values[i * stride] - centre;
        const double off = e * e - m.square; /* Welford 1962 */
        m.square += off / (double)(i + 1);
        m.square_spread += off * (e * e - m.square);
        m.second += d * d;
        m.third += d * d * d;
    }
    return m;
}

/* The skewness of the errors, with the factor that makes it unbiased for normal errors; 0 for two, NaN if three or more
   are all equal. */
static double skewness(const moments *m, double n)
{
    return n > 2 ? sqrt(n * (n - 1)) / (n - 2) * sqrt(n) * m->third / (m->second * sqrt(m->second)) : 0;
}

/* v of the file's head; NaN if the skewness is. */
static double relative_variance(const moments *m, double n)
{
    const double v = m->square_spread / (n - 1) / (m->square * m->square), g = skewness(m, n);
    const double by_skewness = g * g > 6 / n ? 2 + 1.2 * (1 + 1.5 / sqrt(n)) * (g * g - 6 / n) : 0;
    return isnan(g) ? g : fmax(fmax(v * (1 + 4 / n), by_skewness), fmin(2, v + sqrt(24 / n)));
}

/* Returns the second derivative of log gamma: the recurrence trigamma(x) = trigamma(x + 1) + 1 / x^2, then the
   asymptotic series (Abramowitz & Stegun 1964, 6.4.6 and 6.4.12). */
static double trigamma(double x)
{
    double sum = 0;
    for (; x < 8; x++) {
        sum += 1 / (x * x);
    }
    const double y = 1 / (x * x);
    return sum + 1 / x + y / 2 + y / x * (1.0 / 6 - y * (1.0 / 30 - y * (1.0 / 42 - y / 30)));
}

koksma__mean_square koksma__mean_square_of(const double *values, size_t count, size_t stride, double centre)
{
    const moments m = moments_of(values, count, stride, centre);
    const double n = (double)count, nu = isnan(centre) ? n - 1 : n;
    koksma__mean_square s = {m.square * n / nu, NAN, NAN, NAN, NAN, false};
    if (count < 2 || !(m.square > 0) || !isfinite(m.square)) {
        s.low = s.high = count < 2 ? (double)NAN : s.value;
        return s;
    }
    const double v = relative_variance(&m, n), used = isnan(v) ? 2 : v, z = fmin(fmax(used - 2, 0), 8) / sqrt(n);
    const double below = fmax(2 * nu / (used * (1 + 0.5 * z)), LEAST_DEGREES),
                 above = fmax(2 * nu / (used * (1 + 2 * z + fmax(1 - 8 / n, 0) / sqrt(n))), LEAST_DEGREES);
    s.low = s.value * below / koksma__chi_squared_quantile(0.975, below);
    s.high = s.value * above / koksma__chi_squared_quantile(0.025, above);
    s.relative_variance = used;
    s.log_error = sqrt(trigamma(fmax(nu / used, LEAST_DEGREES / 2))); /* log of chi-squared: trigamma(degrees / 2) */
    s.approximate = count < TOO_FEW || !(v <= KOKSMA__TOO_SPREAD);
    return s;
}
