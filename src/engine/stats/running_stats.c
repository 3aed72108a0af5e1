/* SPDX-License-Identifier: Apache-2.0 */
/* The statistics of koksma/series.h. Running means and sums of squared deviations are updated one value at a time
   (Welford 1962), so that values need not be stored and no digits are lost; a line is fitted through points on
   logarithmic axes. */
#include "stats/stats.h"

#include <math.h>

#include "core/elementary.h"
#include "core/status.h"

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
                (pass ? koksma__fit_add : koksma__fit_mean)(&fit, koksma__log(xs[i]), koksma__log(ys[i]), 1);
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

koksma__estimate koksma__reach(const koksma_line *line, double x, double y, double target)
{
    if (!(y > 0 && target > 0 && line->slope < 0)) {
        return (koksma__estimate){NAN, NAN, NAN};
    }
    const double half = koksma_student_975(line->count - 2) * line->slope_error, way = koksma__log(target / y);
    const double fast = x * koksma__exp(way / (line->slope - half)),
                 slow = line->slope + half < 0 ? x * koksma__exp(way / (line->slope + half))
                        : way < 0              ? (double)INFINITY
                                               : 0;
    return (koksma__estimate){x * koksma__exp(way / line->slope), fmin(fast, slow), fmax(fast, slow)};
}

/* Fits a line by least squares in two passes: first the means by updates (Welford 1962), then sums of squares and
   products about the means. Unlike sums of raw squares, these lose no digits if the means are large. The caller
   stores the pairs and omits those with NaN. */
void koksma__fit_mean(koksma__fit *fit, double x, double y, double weight)
{
    fit->weight += weight;
    fit->x += weight * (x - fit->x) / fit->weight;
    fit->y += weight * (y - fit->y) / fit->weight;
}

void koksma__fit_add(koksma__fit *fit, double x, double y, double weight)
{
    const double dx = x - fit->x, dy = y - fit->y;
    fit->xx += weight * dx * dx;
    fit->xy += weight * dx * dy;
    fit->yy += weight * dy * dy;
}

double koksma__fit_slope(const koksma__fit *fit)
{
    return fit->xy / fit->xx;
}

/*
 * Least-squares slopes of means against n on logarithmic axes. With several trials the standard error of a slope
 * comes from the covariance of a trial's values at different n (delta method); with one trial it comes from the
 * residuals. */
/* Updates means and sums of products of deviations (Welford 1962). */
void koksma_joint_add(koksma_joint *joint, size_t n, const double *values)
{
    double off[KOKSMA_MAX_SIZES];
    KOKSMA__REQUIRE_OR(, joint, values);
    if (n > KOKSMA_MAX_SIZES) {
        koksma__fail(KOKSMA_ARGUMENT, "koksma_joint_add: n: %zu sizes; at most %d", n, KOKSMA_MAX_SIZES);
        return;
    }
    joint->count++;
    for (size_t i = 0; i < n; i++) {
        off[i] = values[i] - joint->means[i];
        joint->means[i] += off[i] / joint->count;
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < n; k++) {
            joint->spread[i][k] += off[i] * (values[k] - joint->means[k]);
        }
    }
}

/*
 * Prefixes of one set are nested, so the means at several sizes are correlated. Their residuals are too small to show
 * how far the line would move with other sets. With x_i the logarithm of size i, x' the mean of all x_i, and m_i the
 * mean over the T trials at size i, the slope is sum_i w_i log m_i with w_i = (x_i - x') / sum (x_i - x')^2, so that
 * to first order its variance over trials is
 *
 *     sum_ik w_i w_k C_ik,   C_ik = S_ik/(m_i m_k) / (T (T - 1)),
 *
 * where S_ik is the sum over the trials of the products of the deviations from m_i and m_k: the infinitesimal jackknife
 * (Efron 1982, chapter 6). Where a caller knows the standard errors of the log m_i better, only the correlations of C
 * are used.
 */
static double covariance(const koksma_joint *joint, const double *means, const double *log_errors, size_t i, size_t k)
{
    const double s = joint->spread[i][k];
    if (!log_errors) {
        return s / (means[i] * means[k]) / (joint->count * (joint->count - 1));
    }
    const double scale = sqrt(joint->spread[i][i]) * sqrt(joint->spread[k][k]);
    return log_errors[i] * log_errors[k] * (i == k ? 1 : scale > 0 ? s / scale : 0);
}

double koksma__joint_error(const koksma_joint *joint, size_t n, const double *sizes, const double *means,
                           const double *log_errors)
{
    double weights[KOKSMA_MAX_SIZES], middle = 0, square = 0, count = 0, variance = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < n; i++) {
            weights[i] = 0;
            if (!(means[i] > 0 && isfinite(means[i]))) {
                continue; /* the fit of the line skips this mean, too */
            }
            if (pass == 0) {
                middle += (koksma__log(sizes[i]) - middle) / ++count;
            } else {
                weights[i] = koksma__log(sizes[i]) - middle;
                square += weights[i] * weights[i];
            }
        }
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < n; k++) {
            if (weights[i] != 0 && weights[k] != 0) {
                variance += weights[i] * weights[k] * covariance(joint, means, log_errors, i, k);
            }
        }
    }
    return sqrt(variance < 0 ? 0 : variance) / square;
}

bool koksma_joint_line(const koksma_joint *joint, size_t n, const double *sizes, const double *means,
                       koksma_line *line)
{
    KOKSMA__REQUIRE_OR(false, joint, sizes, means, line);
    if (n > KOKSMA_MAX_SIZES || !koksma_log_line(n, sizes, means, line)) {
        return false;
    }
    if (joint->count > 1) {
        line->slope_error = koksma__joint_error(joint, n, sizes, means, NULL);
    }
    return true;
}
