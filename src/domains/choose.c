/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The patterns that can place points on a domain, listed in the table at the end of this file. Each chooses its
 * points among independent candidates that have the wanted density:
 *
 *   random                 the first n candidates
 *   elimination            n of factor * n candidates by patterns/shared/elimination.c, with d_max of n points in the
 *                          plane times the root of the area; progressive order as there
 *   poisson-disk           candidates in turn, those too near to a kept one are rejected. A grid of cells, about one a
 *                          point, finds the kept ones near a candidate. After 20,000 rejections in a row it fails
 *
 * The unit of distance varies with the density. The distance of two candidates is measured in the smaller one of
 * their two units, so that each candidate needs to search only as far as its own unit reaches.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/generate.h"
#include "core/parallel.h"
#include "core/status.h"
#include "core/torus.h"
#include "domains/choose.h"
#include "patterns/shared/elimination.h"

enum { REJECTIONS = 20000, LOOK_EVERY = 1 << 14 };

#define NONE UINT32_MAX

/* The arguments of a method's choice. */
typedef struct choice {
    const koksma__point_domain *domain;
    const koksma_pattern *pattern;
    const double *params;
    uint64_t seed;
    size_t n;
    const koksma_run *run;
    uint64_t *chosen;
} choice;

size_t koksma__domain_find(const double *sums, size_t count, double at)
{
    size_t low = 0, high = count - 1;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (sums[middle] > at) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    /* if rounding has made `at` equal to the total, return the last entry whose share is above 0 */
    while (low > 0 && sums[low] <= sums[low - 1]) {
        low--;
    }
    return low;
}

static koksma_status choose_first(const choice *c)
{
    for (size_t i = 0; i < c->n; i++) {
        c->chosen[i] = i;
    }
    return KOKSMA_OK;
}

/* ---- Elimination ----------------------------------------------------------------------------------------- */

/* The candidates not eliminated yet, and a copy of them that elimination reads. */
typedef struct candidates {
    double *xs, *units, *old_xs, *old_units;
    uint64_t *who, *old_who;
    uint32_t *order;
} candidates;

/* Keeps `keep` of `count` candidates and moves them to the front. */
static koksma_status eliminate(const choice *c, candidates *a, size_t count, size_t keep, double d_max, double d_min)
{
    const size_t dim = (size_t)c->domain->dim;
    memcpy(a->old_xs, a->xs, count * dim * sizeof *a->xs);
    memcpy(a->old_units, a->units, count * sizeof *a->units);
    memcpy(a->old_who, a->who, count * sizeof *a->who);
    KOKSMA__TRY(koksma__eliminate_scaled(count, c->domain->dim, a->old_xs, c->domain->varies ? a->old_units : NULL,
                                         c->domain->torus, keep, d_max, d_min, c->run, a->order));
    for (size_t i = 0; i < count; i++) {
        memcpy(a->xs + i * dim, a->old_xs + a->order[i] * dim, dim * sizeof *a->xs);
        a->units[i] = a->old_units[a->order[i]];
        a->who[i] = a->old_who[a->order[i]];
    }
    return KOKSMA_OK;
}

/* Chooses `length` of factor * length candidates; c->chosen receives the first n of them. */
static koksma_status choose_from(const choice *c, size_t length, size_t factor, bool progressive)
{
    const size_t dim = (size_t)c->domain->dim, most = KOKSMA_MAX_COORDINATES / dim / factor, all = factor * length;
    KOKSMA__FAIL_IF(length > most, KOKSMA_N, "%s: n = %zu is too large; n = %zu or less would do", c->pattern->name,
                    length, most);
    const size_t bytes = all * (2 * (dim + 2) * sizeof(double) + sizeof(uint32_t));
    candidates a = {.xs = malloc(bytes)};
    KOKSMA__REQUIRE_MEMORY(a.xs, bytes);
    a.old_xs = a.xs + all * dim;
    a.units = a.old_xs + all * dim;
    a.old_units = a.units + all;
    a.who = (uint64_t *)(a.old_units + all);
    a.old_who = a.who + all;
    a.order = (uint32_t *)(a.old_who + all);
    for (size_t i = 0; i < all; i++) {
        a.units[i] = 1;
        a.who[i] = i;
        c->domain->draw(c->domain->data, c->seed, i, a.xs + i * dim, &a.units[i]);
    }
    double d_max = koksma__elimination_radius(length, 2) * sqrt(c->domain->area);
    const double d_min = d_max * koksma__elimination_limit(length, all);
    koksma_status status = eliminate(c, &a, all, length, d_max, d_min);
    for (size_t left = length; progressive && left >= 3 && !status; left /= 2) {
        d_max *= sqrt(2);
        status = eliminate(c, &a, left, left / 2, d_max, d_min);
    }
    memcpy(c->chosen, a.who, c->n * sizeof *c->chosen);
    free(a.xs);
    return status;
}

static koksma_status choose_eliminated(const choice *c)
{
    return choose_from(c, c->n, (size_t)c->params[0], false);
}

static koksma_status choose_progressive(const choice *c)
{
    const size_t length = (size_t)c->params[0];
    KOKSMA__FAIL_IF(c->n > length, KOKSMA_N,
                    "%s: length=%zu has %zu points, not %zu; n = %zu or less, or length=%zu, would do",
                    c->pattern->name, length, length, c->n, length, c->n);
    return choose_from(c, length, (size_t)c->params[1], true);
}

/* ---- Darts ----------------------------------------------------------------------------------------------- */

typedef struct darts {
    const koksma__point_domain *domain;
    bool torus;
    double d;
    double *xs, *units;
    uint32_t *next, *head;
    uint32_t side;
} darts;

/* Whether a kept point is too near to x; recursive: searches the neighbouring cells along the axes k, k + 1, ... */
static bool is_near(const darts *a, int k, size_t row, const double *x, double unit)
{
    const size_t dim = (size_t)a->domain->dim;
    if ((size_t)k == dim) {
        for (uint32_t i = a->head[row]; i != NONE; i = a->next[i]) {
            const double d = a->d * fmin(unit, a->units[i]);
            double square = 0;
            for (size_t j = 0; j < dim; j++) {
                const double y = a->xs[i * dim + j], t = a->torus ? koksma__torus_difference(x[j], y) : y - x[j];
                square += t * t;
            }
            if (square < d * d) {
                return true;
            }
        }
        return false;
    }
    const size_t reach = (size_t)fmin(ceil(a->d * unit * (double)a->side), (double)a->side);
    const size_t own = koksma__cell_along(x[k], a->side);
    size_t first = own > reach ? own - reach : 0, some = (own + reach < a->side ? own + reach + 1 : a->side) - first;
    if (a->torus) {
        some = 2 * reach + 1 < a->side ? 2 * reach + 1 : a->side;
        first = some < a->side ? (own + a->side - reach) % a->side : 0;
    }
    for (size_t i = 0; i < some; i++) {
        if (is_near(a, k + 1, row * a->side + (first + i) % a->side, x, unit)) {
            return true;
        }
    }
    return false;
}

static void keep(darts *a, size_t i)
{
    const size_t cell = koksma__cell_index(a->xs + i * (size_t)a->domain->dim, a->domain->dim, a->side);
    a->next[i] = a->head[cell];
    a->head[cell] = (uint32_t)i;
}

static koksma_status throw_darts(const choice *c, darts *a)
{
    size_t placed = 0, rejections = 0;
    for (uint64_t dart = 0; placed < c->n; dart++) {
        double *x = a->xs + placed * (size_t)c->domain->dim;
        a->units[placed] = 1;
        c->domain->draw(c->domain->data, c->seed, dart, x, &a->units[placed]);
        if (is_near(a, 0, 0, x, a->units[placed])) {
            KOKSMA__FAIL_IF(++rejections == REJECTIONS, KOKSMA_IMPOSSIBLE,
                            "%s: dart throwing placed %zu of %zu points at d=%g %s and jammed; n = %zu or less, or a "
                            "smaller d, would do",
                            c->pattern->name, placed, c->n, c->params[0], c->domain->what, placed);
        } else {
            rejections = 0;
            keep(a, placed);
            c->chosen[placed++] = dart;
        }
        if (dart % LOOK_EVERY == LOOK_EVERY - 1 && !koksma__keep_going(c->run, (double)placed / (double)c->n)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

static koksma_status choose_darts(const choice *c)
{
    const size_t dim = (size_t)c->domain->dim;
    darts a = {.domain = c->domain, .d = c->params[0] * c->domain->unit, .side = 1};
    a.torus = c->domain->torus && c->params[1] > 0;
    KOKSMA__FAIL_IF(c->params[1] > 0 && !c->domain->torus, KOKSMA_ARGUMENT, "%s: torus=1: there is no torus %s",
                    c->pattern->name, c->domain->what);
    const double most = fmin(pow((double)c->n, 1.0 / (double)dim), a.d > 0 ? 1 / a.d : 1);
    a.side = most > 1 ? (uint32_t)most : 1;
    const size_t square = (size_t)a.side * a.side, cells = dim == 2 ? square : square * a.side;
    const size_t bytes = c->n * ((dim + 1) * sizeof(double) + sizeof(uint32_t)) + cells * sizeof(uint32_t);
    a.xs = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(a.xs, bytes);
    a.units = a.xs + c->n * dim;
    a.next = (uint32_t *)(a.units + c->n);
    a.head = a.next + c->n;
    memset(a.head, 0xff, cells * sizeof *a.head);
    const koksma_status status = throw_darts(c, &a);
    free(a.xs);
    return status;
}

/* ---- The table ------------------------------------------------------------------------------------------- */

/* The patterns that can place points on a domain. A method reads the pattern's parameters by their order in its
   table. */
static const struct {
    const char *pattern;
    koksma_status (*choose)(const choice *c);
} methods[] = {
    {"random", choose_first},
    {"sample-elimination", choose_eliminated},
    {"progressive-elimination", choose_progressive},
    {"poisson-disk", choose_darts},
};

koksma_status koksma__domain_choose(const koksma__point_domain *domain, const koksma_spec *spec, uint64_t seed,
                                    size_t n, const koksma_run *run, uint64_t *chosen)
{
    const koksma_pattern *p = spec->pattern;
    p = p && p->alias_of ? koksma_pattern_find(p->alias_of) : p;
    KOKSMA__FAIL_IF(!p, KOKSMA_ARGUMENT, "the spec does not name a pattern");
    KOKSMA__TRY(koksma__generate_check(spec, p, 2));
    for (size_t i = 0; i < KOKSMA_MAX_MODIFIERS; i++) {
        const koksma_modifier *modifier = koksma_modifier_at(i);
        KOKSMA__FAIL_IF(modifier && !(spec->modifiers[i] == 0), KOKSMA_ARGUMENT, "%s: %s has no form %s", p->name,
                        modifier->name, domain->what);
    }
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        if (!strcmp(methods[i].pattern, p->name)) {
            const choice c = {domain, p, spec->params, seed, n, run, chosen};
            return methods[i].choose(&c);
        }
    }
    return koksma__fail(
        KOKSMA_UNSUPPORTED,
        "%s: no form %s; random, sample-elimination, progressive-elimination and poisson-disk have one", p->name,
        domain->what);
}
