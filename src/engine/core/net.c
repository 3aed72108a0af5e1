/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The quality t of nets: n = b^m points are a (t,m,s)-net in base b if every elementary interval, a product of
 * [a/b^k, (a+1)/b^k), of volume b^(t-m) holds b^t of them (Niederreiter 1992). Smaller t is better. All points are an
 * (m,m,s)-net, and a (t,m,s)-net is also a (t+1,m,s)-net, so trying t = 0, 1, 2, ... in turn finds the least t.
 *
 * Unless b is a power of two, most fractions a/b^k are not exact doubles: 1/5 times 5 rounds to 1, but 1/49 times 49
 * to less than 1. Therefore the bounds of a stratum are the doubles nearest to a/b^k (the quotient of two whole
 * numbers is rounded once), and a coordinate that equals the double nearest to a/b^k is treated as this fraction.
 * Equal fractions have the same nearest double. The index of the stratum of x among b^k is therefore its index among
 * b^m, divided by b^(m-k) and rounded down; for each coordinate the index among b^m is computed only once. There are
 * C(m - t + s - 1, s - 1) shapes of intervals with m - t digits, and each shape takes one pass over the points.
 */
#include "core/points.h"

#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"

size_t koksma__stratum(double x, size_t m)
{
    size_t j = (size_t)(x * (double)m);
    j = j < m ? j : m - 1;
    while (j > 0 && x < (double)j / (double)m) {
        j--;
    }
    while (j + 1 < m && x >= (double)(j + 1) / (double)m) {
        j++;
    }
    return j;
}

koksma_status koksma__net_init(const koksma_points *points, size_t base, koksma__net *net)
{
    const size_t n = points->n, row = (size_t)points->dim;
    *net = (koksma__net){.base = base, .n = n, .row = row, .powers = {1}};
    while (net->powers[net->digits] <= n / base) {
        net->powers[net->digits + 1] = net->powers[net->digits] * (uint32_t)base;
        net->digits++;
    }
    net->strata = malloc(n * (row + 1) * sizeof *net->strata);
    KOKSMA__REQUIRE_MEMORY(net->strata, n * (row + 1) * sizeof *net->strata);
    net->counts = net->strata + n * row;
    for (size_t i = 0; i < n * row; i++) {
        net->strata[i] = (uint32_t)koksma__stratum(points->xs[i], net->powers[net->digits]);
    }
    return KOKSMA_OK;
}

void koksma__net_fini(koksma__net *net)
{
    free(net->strata);
    *net = (koksma__net){0};
}

/* A search for intervals of one volume that do not contain exactly `each` points. */
typedef struct search {
    const koksma__net *net;
    const int *use;
    int dim;
    size_t n, cells;
    uint32_t each;
    uint32_t sides[KOKSMA_MAX_DIM]; /* number of strata along each coordinate */
    const koksma_run *run;
    bool stopped;
} search;

/* Returns whether all intervals of the current shape hold the same number of points; also false when the run was
   cancelled. */
static bool is_even(search *s)
{
    const koksma__net *net = s->net;
    const uint32_t finest = net->powers[net->digits];
    s->stopped = !koksma__keep_going(s->run, 0);
    if (s->stopped) {
        return false;
    }
    memset(net->counts, 0, s->cells * sizeof *net->counts);
    for (size_t i = 0; i < s->n; i++) {
        size_t cell = 0;
        for (int k = 0; k < s->dim; k++) {
            if (s->sides[k] > 1) {
                cell = cell * s->sides[k] + net->strata[i * net->row + (size_t)s->use[k]] / (finest / s->sides[k]);
            }
        }
        if (++net->counts[cell] > s->each) {
            return false;
        }
    }
    return true; /* the total is fixed, so if no interval has more than its share of points, none has less */
}

/* Tries all ways to distribute `left` digits over coordinates k and later. */
static bool all_even(search *s, int k, int left)
{
    if (k + 1 == s->dim) {
        s->sides[k] = s->net->powers[left];
        return is_even(s);
    }
    for (int digits = 0; digits <= left; digits++) {
        s->sides[k] = s->net->powers[digits];
        if (!all_even(s, k + 1, left - digits)) {
            return false;
        }
    }
    return true;
}

koksma_status koksma__net_quality(const koksma__net *net, int m, const int *use, int dim, const koksma_run *run,
                                  int *t)
{
    search s = {.net = net, .use = use, .dim = dim, .n = net->powers[m], .run = run};
    for (*t = 0; *t < m && !s.stopped; ++*t) {
        s.each = net->powers[*t];
        s.cells = net->powers[m - *t];
        if (all_even(&s, 0, m - *t)) {
            break;
        }
    }
    return s.stopped ? koksma__fail_interrupted() : KOKSMA_OK;
}
