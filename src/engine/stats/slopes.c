/* SPDX-License-Identifier: Apache-2.0 */
/* Describes how errors decrease with n. A slope is the slope of the least-squares line through (log n, log mean). Its
   interval comes from the standard errors of the means, to first order in the logarithms, or from the residuals if
   the errors are unknown. The lack of fit of a weighted line shows whether the means lie on a line at all. The number
   of samples that reaches a given error is interpolated between the two nearest sizes, as if the error followed c
   n^slope between them. */
#include "core/elementary.h"
#include "stats/stats.h"

#include <math.h>

#define NORMAL_99 2.3263478740408408 /* the 99 % quantile of the normal distribution */

/* Returns the standard error of the logarithm of a mean, to first order. It is NaN for one trial of a random value,
   and 0 for a deterministic value. */
static double log_error(const koksma__summary *s)
{
    return s->sd / sqrt((double)s->n) / s->mean;
}

/* Whether the results of log_error for the means are all known, whether some are above 0, and whether all are above
   0. */
typedef struct errors {
    bool known, some, all;
} errors;

static errors errors_of(const koksma__summary *y, size_t count)
{
    errors e = {true, false, true};
    for (size_t i = 0; i < count; i++) {
        const double error = log_error(&y[i]);
        e.known &= !isnan(error);
        e.some |= error > 0;
        e.all &= error > 0;
    }
    return e;
}

/* Returns the weight 1 / sigma^2 of a mean, or 1 without weights. */
static double weight(const koksma__summary *y, bool weighted)
{
    return weighted ? 1 / (log_error(y) * log_error(y)) : 1;
}

static koksma__fit fit_of(const double *n, const koksma__summary *y, size_t count, bool weighted)
{
    koksma__fit f = {0};
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < count; i++) {
            (pass ? koksma__fit_add : koksma__fit_mean)(&f, koksma__log(n[i]), koksma__log(y[i].mean),
                                                        weight(&y[i], weighted));
        }
    }
    return f;
}

static double squared_residuals(const koksma__fit *f, const double *n, const koksma__summary *y, size_t count,
                                bool weighted)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double r = koksma__log(y[i].mean) - f->y - koksma__fit_slope(f) * (koksma__log(n[i]) - f->x);
        sum += weight(&y[i], weighted) * r * r;
    }
    return sum;
}

/* Returns half the width of the interval of the slope. With x_i = log n_i, their mean x', y_i = log mean_i and the
   standard error sigma_i of y_i, the slope is sum c_i y_i with c_i = (x_i - x') / sum (x_i - x')^2. Its variance is
   V = sum c_i^2 sigma_i^2, with V^2 / (sum (c_i^2 sigma_i^2)^2 / (trials_i - 1)) degrees of freedom (Satterthwaite
   1946; Welch 1947). */
static double half_of_trials(const koksma__fit *f, const double *n, const koksma__summary *y, size_t count)
{
    double variance = 0, fourth = 0;
    for (size_t i = 0; i < count; i++) {
        const double error = log_error(&y[i]), c = (koksma__log(n[i]) - f->x) / f->xx;
        if (error > 0) {
            const double v = c * c * error * error;
            variance += v;
            fourth += v * v / (double)(y[i].n - 1);
        }
    }
    return fourth > 0 ? koksma__student_quantile(0.975, variance * variance / fourth) * sqrt(variance) : 0;
}

/* Returns half the width of the interval of the slope, computed only from the residuals. */
static double half_of_residuals(const koksma__fit *f, const double *n, const koksma__summary *y, size_t count)
{
    if (count < 3) {
        return NAN;
    }
    const double scatter = squared_residuals(f, n, y, count, false) / (double)(count - 2);
    return koksma_student_975(count - 2) * sqrt(scatter / f->xx);
}

/* Tests the lack of fit of the weighted line at 1 %: Q = sum w_i r_i^2 with the residuals r_i and w_i = 1 / sigma_i^2,
   where the standard errors sigma_i are estimates. With p = count - 2, the leverages h_i and
   A = sum (1 - h_i)^2 / (trials_i - 1), Q / (p + 2 A - 6 A / (p + 2)) approximately follows F with p and
   p (p + 2) / (3 A) degrees of freedom (Johansen 1980; for means, Welch 1951). The tail of F is computed by the cube
   root approximation (Paulson 1942). */
static bool lies_off_line(const double *n, const koksma__summary *y, size_t count)
{
    const koksma__fit f = fit_of(n, y, count, true);
    const double p = (double)count - 2, q = squared_residuals(&f, n, y, count, true);
    double a = 0;
    for (size_t i = 0; i < count; i++) {
        const double w = weight(&y[i], true), t = koksma__log(n[i]) - f.x, h = w / f.weight + w * t * t / f.xx;
        a += (1 - h) * (1 - h) / (double)(y[i].n - 1);
    }
    const double u = 2 / (9 * p), v = 2 * a / (3 * p * (p + 2)),
                 root = koksma__cbrt(q / (p + 2 * a - 6 * a / (p + 2)));
    return (1 - v) * root - (1 - u) > NORMAL_99 * sqrt(v * root * root + u);
}

koksma__trend koksma__trend_of(const double *n, const koksma__summary *mean, size_t count)
{
    koksma__trend trend = {.slope = {NAN, NAN, NAN}};
    const koksma__fit f = count ? fit_of(n, mean, count, false) : (koksma__fit){0};
    if (!(f.xx > 0)) {
        return trend;
    }
    const errors e = errors_of(mean, count);
    const double slope = koksma__fit_slope(&f);
    const bool trials = e.known && e.some;
    const double half = trials ? half_of_trials(&f, n, mean, count) : half_of_residuals(&f, n, mean, count);
    trend.slope = (koksma__estimate){slope, slope - half, slope + half};
    trend.off_line = count > 2 && e.all && lies_off_line(n, mean, count);
    return trend;
}

/* Between two measured sizes the error is interpolated as c n^slope. The interval comes from the standard errors of
   the mean errors at these sizes and of the target, by first-order propagation in the logarithms. */
koksma__estimate koksma__samples_for(const koksma__convergence *p, double target, double target_error, bool *outside)
{
    koksma__estimate none = {NAN, NAN, NAN};
    *outside = true;
    if (p->count < 2 || !(target > 0)) {
        return none;
    }
    size_t a = 0;
    while (a + 2 < p->count && p->mean[a + 1] > target) {
        a++;
    }
    const size_t b = a + 1;
    const double x0 = koksma__log(p->n[a]), x1 = koksma__log(p->n[b]), y0 = koksma__log(p->mean[a]),
                 y1 = koksma__log(p->mean[b]);
    const double slope = (y1 - y0) / (x1 - x0), y = koksma__log(target), share = (y - y0) / (y1 - y0);
    if (!(slope < 0)) {
        return none;
    }
    *outside = share < 0 || share > 1;
    const double e = target_error / target, e0 = p->error[a] / p->mean[a], e1 = p->error[b] / p->mean[b];
    const double dx = sqrt(e * e + (1 - share) * (1 - share) * e0 * e0 + share * share * e1 * e1) / -slope;
    const double x = x0 + share * (x1 - x0);
    return (koksma__estimate){koksma__exp(x), koksma__exp(x - 1.959963984540054 * dx),
                              koksma__exp(x + 1.959963984540054 * dx)};
}
