/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The distribution of the peak of the spectrum of white noise: how large a peak arises by chance.
 *
 * One image: the spectrum of white noise of n pixels has n - 1 degrees of freedom: 2 at each frequency with a mirror
 * image ("wave"), and 1 at each of up to three frequencies that are their own mirror images (alternating columns,
 * rows or both). The power of a wave, divided by the mean power of all frequencies, exceeds x with probability
 * (Fisher 1929)
 *
 *     (1 - 2 x / (n - 1))^((n - 3) / 2),   nearly exp(-x).
 *
 * T images: the power is the mean of T powers. A share r of the squared error may be the same in all images, for
 * example where all use the same pattern; then the amplitudes of the T images have the covariance matrix (1 - r) I +
 * r 1 1', which has one eigenvalue 1 + (T - 1) r and T - 1 eigenvalues 1 - r; the mean power is
 *
 *     a X + b G,   a = (1 + (T - 1) r) / T,  b = (1 - r) / T,  X exponential, G gamma distributed with shape T - 1,
 *
 *     P(a X + b G > x) = Q(T - 1, x / b) + exp(-x / a) (1 - b / a)^(1 - T) P(T - 1, (x / b) (1 - b / a))
 *
 * with the regularised incomplete gamma functions P and Q = 1 - P. For r = 0 this is a gamma distribution of shape T;
 * for r = 1 it is the distribution of one image. The power of the few frequencies without a mirror image is
 * approximated by a gamma distribution of mean 1 and twice the variance of a wave's power, so of shape 1 / (2 a^2 + 2
 * (T - 1) b^2).
 *
 * The distribution of the largest power assumes that powers at different frequencies are independent, which holds for
 * Gaussian noise. If errors are independent but not Gaussian, or larger in some pixels than in others, the power has
 * the same distribution at each frequency (for large n), but powers at neighbouring frequencies are dependent. The
 * probability that the largest power exceeds x is then at most the sum over all frequencies of the probability that
 * the power there exceeds x. If the probability computed here is 0.05, the sum is larger by a factor of 1.026; for
 * smaller probabilities the factor is smaller.
 */
#include "image/coherence_law.h"

#include <math.h>

#include "stats/log_gamma.h"

enum { TERMS = 1000000, HALVINGS = 200 };

/* The logarithm of P(k, x) for x up to about k + 1, by the series 6.5.29 of Abramowitz & Stegun 1964. */
static double log_series(double k, double x)
{
    double term = 1, sum = 1;
    for (int j = 1; j < TERMS && term > 1e-17 * sum; j++) {
        term *= x / (k + j);
        sum += term;
    }
    return k * log(x) - x - koksma__log_gamma(k + 1) + log(sum);
}

/* Q(k, x) for x above k + 1, by Lentz's method on the continued fraction 6.5.31 of Abramowitz & Stegun. */
static double upper_fraction(double k, double x)
{
    double b = x + 1 - k, c = 1e300, d = 1 / b, f = d;
    for (int j = 1; j < TERMS; j++) {
        const double a = -j * (j - k);
        b += 2;
        d = a * d + b;
        d = 1 / (fabs(d) < 1e-300 ? 1e-300 : d);
        c = b + a / c;
        c = fabs(c) < 1e-300 ? 1e-300 : c;
        f *= d * c;
        if (fabs(d * c - 1) < 1e-15) {
            break;
        }
    }
    return exp(k * log(x) - x - koksma__log_gamma(k)) * f;
}

static double upper_gamma(double k, double x)
{
    return x <= 0 ? 1 : x < k + 1 ? 0 - expm1(log_series(k, x)) : upper_fraction(k, x);
}

/* Returns the probability that the power at one frequency with a mirror image exceeds x. */
static double wave_tail(const koksma__coherence_law *law, double x)
{
    const double images = (double)law->images, free = 2 * (double)law->waves + (double)law->real;
    if (x <= 0) {
        return 1;
    }
    if (law->images == 1) {
        return 2 * x >= free ? 0 : exp((free / 2 - 1) * log1p(-2 * x / free));
    }
    const double a = (1 + (images - 1) * law->common) / images, b = (1 - law->common) / images;
    if (b < 1e-9 * a) {
        return exp(-x / a);
    }
    const double k = images - 1, z = x / b, rest = 1 - b / a, y = z * rest;
    if (y < k + 1) { /* (1 - b/a)^-k and y^k are multiplied as logarithms, as each may overflow alone */
        double term = 1, sum = 1;
        for (int j = 1; j < TERMS && term > 1e-17 * sum; j++) {
            term *= y / (k + j);
            sum += term;
        }
        return upper_gamma(k, z) + sum * exp(k * log(z) - z - koksma__log_gamma(k + 1));
    }
    return upper_gamma(k, z) + exp(-x / a - k * log(rest)) * (1 - upper_fraction(k, y));
}

/* Returns the probability that the power at one frequency without a mirror image exceeds x. */
static double real_tail(const koksma__coherence_law *law, double x)
{
    const double images = (double)law->images;
    const double a = (1 + (images - 1) * law->common) / images, b = (1 - law->common) / images;
    const double shape = 0.5 / (a * a + (images - 1) * b * b);
    return upper_gamma(shape, shape * x);
}

double koksma__coherence_tail(const koksma__coherence_law *law, double x)
{
    double log_below = 0;
    if (law->waves) {
        log_below += (double)law->waves * log1p(-fmin(wave_tail(law, x), 1));
    }
    if (law->real) {
        log_below += (double)law->real * log1p(-fmin(real_tail(law, x), 1));
    }
    return 0 - expm1(log_below); /* not -0 */
}

double koksma__coherence_quantile(const koksma__coherence_law *law, double tail)
{
    double lo = 0, hi = 1;
    while (koksma__coherence_tail(law, hi) > tail && hi < 1e15) {
        lo = hi;
        hi *= 2;
    }
    for (int i = 0; i < HALVINGS && hi - lo > 1e-12 * hi; i++) {
        const double middle = 0.5 * (lo + hi);
        if (koksma__coherence_tail(law, middle) > tail) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    return 0.5 * (lo + hi);
}
