/* SPDX-License-Identifier: Apache-2.0 */
/* Percentile bootstrap intervals (Efron 1979). A resample draws n of the n pairs with replacement and replaces
   each mean by a random number from the normal distribution with that mean and its standard error. The interval lies
   between the 2.5 % and 97.5 % quantiles of the statistic over all resamples. Random numbers are hashes of (seed,
   resample, index), so that different statistics of the same pairs use the same resamples, which also give an
   interval for their difference. */
#include "stats/stats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"

enum { BETWEEN_CALLS = 64 }; /* resamples between two calls of run->keep_going */

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Returns the q-quantile of sorted values, by linear interpolation. */
static double quantile(const double *sorted, size_t n, double q)
{
    const double at = q * (double)(n - 1);
    const size_t i = (size_t)at;
    return i + 1 < n ? sorted[i] + (at - (double)i) * (sorted[i + 1] - sorted[i]) : sorted[n - 1];
}

/* Sorts the values that are not NaN to the front and returns their number. */
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

/* Sets the interval from the quantiles of the values that are not NaN, if there are any; reorders the values. */
static void set_interval(double *values, size_t n, koksma__estimate *out)
{
    const size_t kept = sort(values, n);
    if (kept) {
        out->low = quantile(values, kept, 0.025);
        out->high = quantile(values, kept, 0.975);
    }
}

/* Returns the index of the i-th pair that resample s draws. */
static size_t drawn(uint64_t seed, size_t s, size_t i, size_t n)
{
    return koksma__below(koksma__random(seed, KOKSMA__PURPOSE_SEARCH, s, (uint32_t)i).w[0], (uint32_t)n);
}

/* Returns the i-th mean in resample s, drawn from the normal distribution about the measured mean (Box and Muller
   1958). */
static double redrawn(const koksma__means *m, size_t s, size_t i)
{
    double u[2];
    if (!(m->error && m->error[i] > 0)) {
        return m->mean[i];
    }
    koksma__random_pair(m->seed, KOKSMA__PURPOSE_SEARCH, s, (uint32_t)i, u);
    return m->mean[i] + m->error[i] * sqrt(-2 * koksma__log1p(-u[0])) * koksma__cos(2 * M_PI * u[1]);
}

/* Writes resample s to a and b. A pattern that is drawn twice has the same means both times; this tie does not count
   as an ordered pair. */
static void resample(const koksma__means *x, const koksma__means *y, size_t n, uint64_t seed, size_t s, double *a,
                     double *b)
{
    for (size_t i = 0; i < n; i++) {
        const size_t j = drawn(seed, s, i, n);
        a[i] = redrawn(x, s, j);
        b[i] = redrawn(y, s, j);
    }
}

koksma_status koksma__bootstrap_pairs(const koksma__means *x, const koksma__means *y, size_t n, size_t samples,
                                      uint64_t seed, const koksma_run *run, double *values, koksma__estimate *out)
{
    *out = (koksma__estimate){n ? koksma__spearman(x->mean, y->mean, n) : (double)NAN, -1, 1};
    if (n < KOKSMA__LEAST_PAIRS) {
        return KOKSMA_OK;
    }
    double *room = malloc((samples + 2 * n) * sizeof *room);
    KOKSMA__REQUIRE_MEMORY(room, (samples + 2 * n) * sizeof *room);
    for (size_t s = 0; s < samples; s++) {
        double *a = room + samples, *b = a + n;
        if (s % BETWEEN_CALLS == 0 && !koksma__keep_going(run, 0)) {
            free(room);
            return koksma__fail_interrupted();
        }
        resample(x, y, n, seed, s, a, b);
        room[s] = koksma__spearman(a, b, n);
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
    KOKSMA__REQUIRE_MEMORY(room, samples * sizeof *room);
    for (size_t s = 0; s < samples; s++) {
        room[s] = a->values[s] * a->factor - b->values[s] * b->factor;
    }
    set_interval(room, samples, out);
    free(room);
    return KOKSMA_OK;
}

/*
 * Several tests at once: p-values from resamples, and Holm's step-down correction ("A simple sequentially rejective
 * multiple test procedure", Scandinavian Journal of Statistics 6, 1979). The smallest of n p-values is multiplied by
 * n, the next by n - 1 and so on; a product smaller than the previous result is replaced by that result. This is
 * Bonferroni's test with the closed testing principle. */
double koksma__resampled_p(const double *values, double a, const double *b, double c, size_t samples)
{
    size_t up = 0, down = 0, n = 0;
    for (size_t i = 0; i < samples; i++) {
        const double x = values[i] * a, y = b ? b[i] * c : 0;
        if (!isnan(x - y)) {
            const int sign = koksma__compare(x, y);
            up += sign >= 0;
            down += sign <= 0;
            n++;
        }
    }
    return fmin(1, 2 * (1 + (double)(up < down ? up : down)) / (double)(n + 1));
}

typedef struct test {
    double p;
    size_t index;
} test;

static int compare_tests(const void *a, const void *b)
{
    const test *x = a, *y = b;
    return x->p != y->p ? (x->p > y->p) - (x->p < y->p) : (x->index > y->index) - (x->index < y->index);
}

koksma_status koksma__holm(double *p, size_t n)
{
    test *tests = malloc((n + 1) * sizeof *tests);
    KOKSMA__REQUIRE_MEMORY(tests, (n + 1) * sizeof *tests);
    for (size_t i = 0; i < n; i++) {
        tests[i] = (test){p[i], i};
    }
    qsort(tests, n, sizeof *tests, compare_tests);
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        most = fmax(most, fmin(1, (double)(n - i) * tests[i].p));
        p[tests[i].index] = most;
    }
    free(tests);
    return KOKSMA_OK;
}
