/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Quantiles by bisection of the distribution functions: the regularised incomplete beta function by its continued
 * fraction, and the incomplete gamma function by its series (Abramowitz & Stegun 1964, 26.5.8, 26.7.1, 6.5.29,
 * 26.4.19).
 *
 * The logarithms of gamma functions in the beta function are large and cancel, so that t with nu degrees of freedom
 * has an error of about 1e-17 nu log nu. With more than MANY degrees of freedom, t is therefore computed from the
 * normal quantile z by the first terms of its expansion in 1/nu (26.7.5):
 *     t = z + (z^3 + z) / (4 nu) + (5 z^5 + 16 z^3 + 3 z) / (96 nu^2) + O(nu^-3)
 */
#define _DEFAULT_SOURCE /* for lgamma_r */
#include "core/elementary.h"
#include "stats/stats.h"

#include <math.h>

enum { TERMS = 100000, HALVINGS = 200 };
#define MANY 1e6

static double away(double x)
{
    return fabs(x) < 1e-300 ? 1e-300 : x;
}

/* Returns I_x(a, b) for x below (a + 1) / (a + b + 2), by Lentz's method. */
static double beta_fraction(double a, double b, double x)
{
    double c = 1, d = 1 / away(1 - (a + b) * x / (a + 1)), f = d;
    for (int m = 1; m < TERMS; m++) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / away(1 + even * d);
        c = away(1 + even / c);
        f *= d * c;
        d = 1 / away(1 + odd * d);
        c = away(1 + odd / c);
        f *= d * c;
        if (fabs(d * c - 1) < 1e-15) {
            break;
        }
    }
    return koksma__exp(koksma__log_gamma(a + b) - koksma__log_gamma(a) - koksma__log_gamma(b) + a * koksma__log(x) +
                       b * koksma__log1p(-x)) *
           f / a;
}

/* With more than MANY degrees of freedom the tail is that of the normal distribution. */
double koksma__student_tail(double t, double degrees)
{
    if (degrees > MANY) {
        return 0.5 * koksma__erfc(t * sqrt(0.5));
    }
    const double a = 0.5 * degrees, x = degrees / (degrees + t * t);
    return 0.5 * (x < (a + 1) / (a + 2.5) ? beta_fraction(a, 0.5, x) : 1 - beta_fraction(0.5, a, 1 - x));
}

double koksma__student_quantile(double p, double degrees)
{
    double lo = 0, hi = 1;
    if (p <= 0.5) {
        return 0;
    }
    while (koksma__student_tail(hi, degrees) > 1 - p && hi < 1e150) {
        hi *= 2;
    }
    for (int i = 0; i < HALVINGS && hi - lo > 1e-12 * hi; i++) {
        const double middle = 0.5 * (lo + hi);
        if (koksma__student_tail(middle, degrees) > 1 - p) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    const double t = 0.5 * (lo + hi), square = t * t;
    return degrees > MANY ? t + t * (1 + square) / (4 * degrees) +
                                t * (3 + square * (16 + 5 * square)) / (96 * degrees * degrees)
                          : t;
}

/* Returns P(X <= x) of the chi-squared distribution. */
static double chi_squared(double x, double degrees)
{
    const double a = 0.5 * degrees, z = 0.5 * x;
    double term = 1 / a, sum = term;
    for (int n = 1; n < TERMS && term > 1e-16 * sum; n++) {
        term *= z / (a + n);
        sum += term;
    }
    return sum * koksma__exp(a * koksma__log(z) - z - koksma__log_gamma(a));
}

double koksma__chi_squared_quantile(double p, double degrees)
{
    double lo = 0, hi = 1;
    while (chi_squared(hi, degrees) < p && hi < 1e15) {
        hi *= 2;
    }
    for (int i = 0; i < HALVINGS && hi - lo > 1e-12 * hi; i++) {
        const double middle = 0.5 * (lo + hi);
        if (chi_squared(middle, degrees) < p) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    return 0.5 * (lo + hi);
}
