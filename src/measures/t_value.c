/* SPDX-License-Identifier: Apache-2.0 */
/*
 * t-value: the quality parameter of the points as a (t,m,s)-net in a base: the least t such that every elementary
 * interval of volume base^(t-m) holds base^t points. 0 is best, m the worst.
 *
 * Formula: n = base^m; elementary intervals are products of [a/base^d, (a+1)/base^d), the d of the coordinates adding
 * up to m - t. Source: Niederreiter 1987. Known exactly: Hammersley's points in base 2: 0; n equal points: m. Limits:
 * n must be a power of the base. Cells are found in doubles: points on a boundary as a/base^d rounds.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/measures.h"

enum { MAX_DIM = 16, MAX_M = 30 };

typedef struct net {
    const koksma_points *points;
    double powers[MAX_M + 1];
    uint32_t *counts;
    const koksma_run *run;
    bool stopped;
} net;

/* Whether all intervals of this shape hold the same number of points; false also when told to stop. */
static bool is_even(net *s, const int *digits, int total)
{
    const size_t n = s->points->n, dim = (size_t)s->points->dim, cells = (size_t)s->powers[total];
    s->stopped = !koksma__keep_going(s->run, 0);
    if (s->stopped) {
        return false;
    }
    memset(s->counts, 0, cells * sizeof *s->counts);
    for (size_t i = 0; i < n; i++) {
        size_t cell = 0;
        for (size_t k = 0; k < dim; k++) {
            const double x = floor(s->points->xs[i * dim + k] * s->powers[digits[k]]);
            if (x >= s->powers[digits[k]]) {
                return false;
            }
            cell = cell * (size_t)s->powers[digits[k]] + (size_t)x;
        }
        if (++s->counts[cell] > n / cells) {
            return false;
        }
    }
    return true;
}

/* All ways to share `left` digits among coordinates k and later. */
static bool all_even(net *s, int *digits, int k, int left, int total)
{
    if (k + 1 == s->points->dim) {
        digits[k] = left;
        return is_even(s, digits, total);
    }
    for (digits[k] = 0; digits[k] <= left; digits[k]++) {
        const int kept = digits[k];
        if (!all_even(s, digits, k + 1, left - kept, total)) {
            return false;
        }
        digits[k] = kept;
    }
    return true;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    net s = {.points = points, .powers = {1}, .run = args->run};
    const double base = args->params[0], n = (double)points->n;
    int m = 0, digits[MAX_DIM] = {0};
    while (m < MAX_M && s.powers[m] < n) {
        s.powers[m + 1] = s.powers[m] * base;
        m++;
    }
    if (s.powers[m] != n) {
        return koksma__fail(KOKSMA_N, "t-value: n = %zu is not a power of base=%g", points->n, base);
    }
    s.counts = malloc(points->n * sizeof *s.counts);
    if (!s.counts) {
        return koksma__fail_memory(points->n * sizeof *s.counts);
    }
    int t = 0;
    while (t < m && !all_even(&s, digits, 0, m - t, m - t) && !s.stopped) {
        t++;
    }
    out->value = t;
    free(s.counts);
    return s.stopped ? koksma__fail_interrupted() : KOKSMA_OK;
}

static const koksma_param params[] = {
    {"base", "the base of the net", 2, 2, 1024, NULL, true},
    {0},
};

const koksma_measure koksma__measure_t_value = {
    .name = "t-value",
    .title = "quality parameter t as a (t,m,s)-net",
    .cite = "niederreiter1987",
    .cost = "n m^d",
    .min_dim = 1,
    .max_dim = MAX_DIM,
    .params = params,
    .eval = eval,
};
