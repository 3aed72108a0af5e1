/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The quality t of nets: n = b^m points are a (t,m,s)-net in base b if every elementary interval, a box with sides
 * [a/b^k, (a+1)/b^k), of volume b^(t-m) holds b^t of them (Niederreiter 1992). Smaller is better; t = m always holds.
 */
#include <stdio.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "patterns/parts/verify.h"

enum { MAX_NET_DIM = 8 };

#define WORK 4e8 /* point visits for one value of t */

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

size_t koksma__wrong_cells(const koksma_points *points, size_t n, const int *use, const size_t *m, int dim,
                           uint32_t each, size_t enough, uint32_t *counts)
{
    const size_t cells = n / each, row = (size_t)points->dim;
    memset(counts, 0, cells * sizeof *counts);
    for (size_t i = 0; i < n; i++) {
        size_t cell = 0;
        for (int k = 0; k < dim; k++) {
            cell = cell * m[k] + koksma__stratum(points->xs[i * row + (size_t)use[k]], m[k]);
        }
        counts[cell]++;
    }
    size_t wrong = 0;
    for (size_t c = 0; c < cells && wrong < enough; c++) {
        wrong += counts[c] != each;
    }
    return wrong;
}

typedef struct search {
    const koksma_points *points;
    size_t n, base;
    const int *use;
    int dim;
    uint32_t each, *counts;
} search;

/* Whether all elementary intervals hold, over the ways to give `left` cells to the coordinates from k on. */
static bool holds(const search *s, size_t *m, int k, size_t left)
{
    if (k == s->dim - 1) {
        m[k] = left;
        return koksma__wrong_cells(s->points, s->n, s->use, m, s->dim, s->each, 1, s->counts) == 0;
    }
    for (size_t a = 1;; a *= s->base) {
        m[k] = a;
        if (!holds(s, m, k + 1, left / a)) {
            return false;
        }
        if (a == left) {
            return true;
        }
    }
}

/* C(m + dim - 1, dim - 1): the shapes of elementary intervals. */
static double shapes(int m, int dim)
{
    double count = 1;
    for (int k = 1; k < dim; k++) {
        count *= (double)(m + k) / k;
    }
    return count;
}

static int quality(search *s, int m)
{
    size_t sides[MAX_NET_DIM], each = 1;
    for (int t = 0; t < m; t++, each *= s->base) {
        s->each = (uint32_t)each;
        if (holds(s, sides, 0, s->n / each)) {
            return t;
        }
    }
    return m;
}

static koksma_status verify_net(search *s, koksma__property property, const char *subject, koksma_findings *findings)
{
    koksma_finding *f = NULL;
    s->n = s->base;
    for (int m = 1; s->n <= s->points->n; m++, s->n *= s->base) {
        if (shapes(m, s->dim) * (double)s->n * (1 + m / 4.0) > WORK) {
            break;
        }
        if (!f) {
            f = koksma__finding(findings, property);
            if (!f) {
                return KOKSMA_MEMORY;
            }
            snprintf(f->subject, sizeof f->subject, "%s", subject);
            snprintf(f->detail, sizeof f->detail, "t for m = 1, 2, ...:");
            f->holds = true;
        }
        const int t = quality(s, m);
        const size_t used = strlen(f->detail);
        snprintf(f->detail + used, sizeof f->detail - used, " %d", t);
        f->value = t > f->value ? t : f->value;
        f->holds = f->holds && t == 0;
    }
    return KOKSMA_OK;
}

static koksma_status verify_base(const koksma_points *points, const koksma_run *run, size_t base,
                                 koksma__property property, uint32_t *counts, koksma_findings *findings)
{
    const int dim = points->dim < KOKSMA_VERIFY_NET_DIM ? points->dim : KOKSMA_VERIFY_NET_DIM;
    int use[MAX_NET_DIM];
    search s = {.points = points, .base = base, .use = use, .dim = 2, .counts = counts};
    koksma_status status = KOKSMA_OK;
    for (use[0] = 0; use[0] < dim && !status; use[0]++) {
        for (use[1] = use[0] + 1; use[1] < dim && !status; use[1]++) {
            char subject[48];
            snprintf(subject, sizeof subject, "%d,%d", use[0], use[1]);
            status = verify_net(&s, property, subject, findings);
            if (!status && !koksma__keep_going(run, 0.5)) {
                status = koksma__fail_interrupted();
            }
        }
    }
    if (!status && points->dim != 2 && points->dim <= MAX_NET_DIM) {
        for (s.dim = 0; s.dim < points->dim; s.dim++) {
            use[s.dim] = s.dim;
        }
        status = verify_net(&s, property, "all", findings);
    }
    return status;
}

koksma_status koksma__verify_nets(const koksma_points *points, const koksma_run *run, uint32_t *counts,
                                  koksma_findings *findings)
{
    static const struct {
        size_t base;
        koksma__property property;
    } bases[] = {
        {2, KOKSMA__PROPERTY_NET_BASE_2}, {3, KOKSMA__PROPERTY_NET_BASE_3}, {5, KOKSMA__PROPERTY_NET_BASE_5}};
    koksma_status status = KOKSMA_OK;
    for (size_t b = 0; b < sizeof bases / sizeof *bases && !status; b++) {
        status = verify_base(points, run, bases[b].base, bases[b].property, counts, findings);
    }
    return status;
}
