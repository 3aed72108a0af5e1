/* SPDX-License-Identifier: Apache-2.0 */
/* Rank correlations and bootstrap intervals. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "core/status.h"
#include "stats/statistics.h"

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

void koksma__unit_ranks(const double *values, size_t n, double *out)
{
    double squares = 0;
    for (size_t i = 0; i < n; i++) {
        out[i] = centred_rank(values, n, i);
        squares += out[i] * out[i];
    }
    for (size_t i = 0; i < n && squares > 0; i++) {
        out[i] /= sqrt(squares);
    }
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

/* Values without the NaN, which go last; sorted. How many there are. */
static size_t sort(double *values, size_t n)
{
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) {
        if (!isnan(values[i])) {
            values[kept++] = values[i];
        }
    }
    qsort(values, kept, sizeof *values, compare_doubles);
    return kept;
}

/* Of the values that are numbers, if any; sorts them. */
static void set_interval(double *values, size_t n, koksma__estimate *out)
{
    const size_t kept = sort(values, n);
    if (kept) {
        out->low = quantile(values, kept, 0.025);
        out->high = quantile(values, kept, 0.975);
    }
}

/* Index i of resample s. */
static size_t drawn(uint64_t seed, size_t s, size_t i, size_t n)
{
    return koksma__below(koksma__random(seed, KOKSMA__PURPOSE_SEARCH, s, (uint32_t)i).w[0], (uint32_t)n);
}

/* The mean i of resample s: normal about the measured one (Box and Muller 1958). */
static double redrawn(const koksma__means *m, size_t s, size_t i)
{
    double u[2];
    if (!(m->error && m->error[i] > 0)) {
        return m->mean[i];
    }
    koksma__random_pair(m->seed, KOKSMA__PURPOSE_SEARCH, s, (uint32_t)i, u);
    return m->mean[i] + m->error[i] * sqrt(-2 * log1p(-u[0])) * cos(2 * M_PI * u[1]);
}

/* Resample s into a and b: a pattern that is drawn twice has the same means twice, and so is no pair in an order. */
static void resample(const koksma__means *x, const koksma__means *y, size_t n, uint64_t seed, size_t s, double *a,
                     double *b)
{
    for (size_t i = 0; i < n; i++) {
        const size_t j = drawn(seed, s, i, n);
        a[i] = redrawn(x, s, j);
        b[i] = redrawn(y, s, j);
    }
}

koksma_status koksma__bootstrap_pairs(const koksma__means *x, const koksma__means *y, size_t n,
                                      koksma__pair_statistic statistic, size_t samples, uint64_t seed, double *values,
                                      koksma__estimate *out)
{
    *out = (koksma__estimate){n ? statistic(x->mean, y->mean, n) : (double)NAN, -1, 1};
    if (n < KOKSMA__LEAST_PAIRS) {
        return KOKSMA_OK;
    }
    double *room = malloc((samples + 2 * n) * sizeof *room);
    if (!room) {
        return koksma__fail_memory((samples + 2 * n) * sizeof *room);
    }
    for (size_t s = 0; s < samples; s++) {
        double *a = room + samples, *b = a + n;
        resample(x, y, n, seed, s, a, b);
        room[s] = statistic(a, b, n);
    }
    if (values) {
        memcpy(values, room, samples * sizeof *values);
    }
    set_interval(room, samples, out);
    free(room);
    return KOKSMA_OK;
}

koksma_status koksma__bootstrap_difference(const koksma__draws *a, const koksma__draws *b, size_t samples,
                                           koksma__estimate *out)
{
    double *room = malloc(samples * sizeof *room);
    *out = (koksma__estimate){a->value - b->value, NAN, NAN};
    if (!room) {
        return koksma__fail_memory(samples * sizeof *room);
    }
    for (size_t s = 0; s < samples; s++) {
        room[s] = a->values[s] * a->factor - b->values[s] * b->factor;
    }
    set_interval(room, samples, out);
    free(room);
    return KOKSMA_OK;
}
