/* SPDX-License-Identifier: Apache-2.0 */
/* Convergence: slopes in log-log, and how many samples reach an error. */
#include <math.h>

#include <koksma/series.h>

#include "study/statistics.h"

/* What a chi-square over its degrees of freedom exceeds by chance in 5 % of cases (Wilson and Hilferty 1931). */
static double largest_by_chance(size_t degrees)
{
    const double a = 2 / (9 * (double)degrees), root = 1 - a + 1.644853626951473 * sqrt(a);
    return root * root * root;
}

/* Weighted least squares: with w = 1/sigma^2, S = sum w, x' = sum w x / S, slope = sum w (x - x') y / sum w (x -
   x')^2, whose variance is 1 / sum w (x - x')^2 when the sigmas are right. When the points scatter more than their
   sigmas say (the line is not the whole truth), the variance grows by the reduced chi-square. */
koksma__line koksma__fit_line(const double *x, const double *y, const double *sigma, size_t n)
{
    koksma__line line = {NAN, NAN, NAN, 0, {NAN, NAN, NAN}};
    double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, chi = 0;
    bool weighted = true;
    for (size_t i = 0; i < n; i++) {
        weighted &= sigma[i] > 0;
    }
    for (size_t i = 0; i < n; i++) {
        const double w = weighted ? 1 / (sigma[i] * sigma[i]) : 1;
        s += w;
        sx += w * x[i];
        sy += w * y[i];
    }
    for (size_t i = 0; i < n; i++) {
        const double w = weighted ? 1 / (sigma[i] * sigma[i]) : 1, t = x[i] - sx / s;
        sxx += w * t * t;
        sxy += w * t * (y[i] - sy / s);
    }
    if (n < 2 || !(sxx > 0)) {
        return line;
    }
    line.slope = sxy / sxx;
    line.intercept = sy / s - line.slope * sx / s;
    for (size_t i = 0; i < n; i++) {
        const double w = weighted ? 1 / (sigma[i] * sigma[i]) : 1;
        const double r = y[i] - line.intercept - line.slope * x[i];
        chi += w * r * r;
    }
    const double reduced = n > 2 ? chi / (double)(n - 2) : 1;
    const double scale = weighted ? fmax(reduced, 1) : n > 2 ? reduced : 0;
    line.degrees = n > 2 && (!weighted || reduced > largest_by_chance(n - 2)) ? n - 2 : 0;
    line.slope_error = n > 2 || weighted ? sqrt(scale / sxx) : (double)NAN;
    line.covariance[0] = scale * (1 / s + sx / s * sx / s / sxx);
    line.covariance[1] = scale / sxx;
    line.covariance[2] = -scale * sx / s / sxx;
    return line;
}

koksma__estimate koksma__slope(const koksma__line *line, size_t least)
{
    const size_t degrees = line->degrees ? line->degrees : least > 1 ? least - 1 : 0;
    const double half = degrees ? koksma_student_975(degrees) * line->slope_error : (double)NAN;
    return (koksma__estimate){line->slope, line->slope - half, line->slope + half};
}

/* Between sizes a and b the error is taken for c n^slope. The interval comes from the standard errors of the three
   means by first-order propagation in the logs. */
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
    const double x0 = log(p->n[a]), x1 = log(p->n[b]), y0 = log(p->mean[a]), y1 = log(p->mean[b]);
    const double slope = (y1 - y0) / (x1 - x0), y = log(target), share = (y - y0) / (y1 - y0);
    if (!(slope < 0)) {
        return none;
    }
    *outside = share < 0 || share > 1;
    const double e = target_error / target, e0 = p->error[a] / p->mean[a], e1 = p->error[b] / p->mean[b];
    const double dx = sqrt(e * e + (1 - share) * (1 - share) * e0 * e0 + share * share * e1 * e1) / -slope;
    const double x = x0 + share * (x1 - x0);
    return (koksma__estimate){exp(x), exp(x - 1.959963984540054 * dx), exp(x + 1.959963984540054 * dx)};
}
