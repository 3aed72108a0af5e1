/* SPDX-License-Identifier: Apache-2.0 */
/* Rank correlations and bootstrap intervals. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "core/status.h"
#include "study/statistics.h"

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Mean ranks: (number below) + (number equal + 1) / 2. Here less the middle rank (n + 1) / 2, and rho is Pearson's
   correlation of them (Spearman 1904). n is a number of patterns: n^2 is small. */
static double centred_rank(const double *values, size_t n, size_t i)
{
    double rank = -0.5 * (double)n;
    for (size_t j = 0; j < n; j++) {
        rank += 0.5 * (koksma__compare(values[i], values[j]) + 1);
    }
    return rank;
}

double koksma__spearman(const double *x, const double *y, size_t n)
{
    double xx = 0, yy = 0, xy = 0;
    for (size_t i = 0; i < n; i++) {
        const double a = centred_rank(x, n, i), b = centred_rank(y, n, i);
        xx += a * a;
        yy += b * b;
        xy += a * b;
    }
    return xx > 0 && yy > 0 ? xy / sqrt(xx * yy) : (double)NAN;
}

/* tau-b (Kendall 1945): (concordant - discordant) / sqrt((pairs - ties in x) (pairs - ties in y)). */
double koksma__kendall(const double *x, const double *y, size_t n)
{
    double score = 0, in_x = 0, in_y = 0;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i + 1; j < n; j++) {
            const int a = koksma__compare(x[i], x[j]), b = koksma__compare(y[i], y[j]);
            score += a * b;
            in_x += a != 0;
            in_y += b != 0;
        }
    }
    return in_x > 0 && in_y > 0 ? score / sqrt(in_x * in_y) : (double)NAN;
}

/* The q-th quantile of sorted values, linear between them. */
static double quantile(const double *sorted, size_t n, double q)
{
    const double at = q * (double)(n - 1);
    const size_t i = (size_t)at;
    return i + 1 < n ? sorted[i] + (at - (double)i) * (sorted[i + 1] - sorted[i]) : sorted[n - 1];
}

static void interval(double *values, size_t n, koksma__estimate *out)
{
    qsort(values, n, sizeof *values, compare_doubles);
    out->low = quantile(values, n, 0.025);
    out->high = quantile(values, n, 0.975);
}

/* Index i of resample s. */
static size_t drawn(uint64_t seed, size_t s, size_t i, size_t n)
{
    return koksma__below(koksma__random(seed, KOKSMA__PURPOSE_SEARCH, s, (uint32_t)i).w[0], (uint32_t)n);
}

koksma_status koksma__bootstrap_pairs(const double *x, const double *y, size_t n, koksma__pair_statistic statistic,
                                      size_t samples, uint64_t seed, koksma__estimate *out)
{
    *out = (koksma__estimate){n ? statistic(x, y, n) : (double)NAN, -1, 1};
    if (n < KOKSMA__LEAST_PAIRS) {
        return KOKSMA_OK;
    }
    double *values = malloc((samples + 2 * n) * sizeof *values);
    if (!values) {
        return koksma__fail_memory((samples + 2 * n) * sizeof *values);
    }
    double *a = values + samples, *b = a + n;
    size_t kept = 0;
    for (size_t s = 0; s < samples; s++) {
        for (size_t i = 0; i < n; i++) {
            const size_t j = drawn(seed, s, i, n);
            a[i] = x[j];
            b[i] = y[j];
        }
        const double value = statistic(a, b, n);
        if (!isnan(value)) {
            values[kept++] = value;
        }
    }
    if (kept) {
        interval(values, kept, out);
    }
    free(values);
    return KOKSMA_OK;
}
