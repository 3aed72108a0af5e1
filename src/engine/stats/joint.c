/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Least-squares slopes of means against n on logarithmic axes. With several trials the standard error of a slope
 * comes from the covariance of a trial's values at different n (delta method); with one trial it comes from the
 * residuals.
 */
#include "stats/joint.h"

#include <math.h>

#include "core/status.h"

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
                middle += (log(sizes[i]) - middle) / ++count;
            } else {
                weights[i] = log(sizes[i]) - middle;
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
