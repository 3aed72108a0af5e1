/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes points on a domain (domain.h) with the method of a pattern; the table at the end lists the patterns that have
 * such a method. These methods choose among candidates, which are independent and have the wanted density:
 *
 *   random                 the first n candidates
 *   elimination            n of factor * n candidates, chosen by patterns/spacing/elimination.c, which also makes the
 *                          progressive order; its radius d_max is that for n points in the unit square, times the square
 *                          root of the domain's area
 *
 * Each part of a domain has a unit of distance; the distance of two points is measured in the smaller of their two units.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "core/parallel.h"
#include "core/status.h"
#include "domains/domain.h"
#include "patterns/spacing/spacing.h"

typedef koksma__choice choice;

static koksma_status choose_first(const choice *c)
{
    for (size_t i = 0; i < c->n; i++) {
        KOKSMA__TRY(koksma__look(c->run, i, (double)i / (double)c->n));
        c->domain->draw(c->domain->data, c->seed, i, &c->points[i]);
    }
    return KOKSMA_OK;
}

/* ---- Elimination ----------------------------------------------------------------------------------------- */

/* Returns d_max, the largest distance at which elimination counts two of n points as near. */
static double radius_of(const koksma__point_domain *domain, size_t n)
{
    return koksma__elimination_radius(n, 2) * sqrt(domain->area);
}

/* Positions and units of distance of points, and an order of them. */
typedef struct layout {
    double *xs, *units; /* units: NULL if all units of distance are 1 */
    uint32_t *order;
    koksma__metric metric;
} layout;

static koksma_status layout_init(layout *l, const koksma__point_domain *domain, size_t n)
{
    const size_t dim = (size_t)domain->dim, bytes = n * ((dim + 1) * sizeof *l->xs + sizeof *l->order);
    l->xs = calloc(1, bytes); /* calloc, because gcc does not see that place() fills the memory */
    KOKSMA__REQUIRE_MEMORY(l->xs, bytes);
    l->units = domain->varies ? l->xs + n * dim : NULL;
    l->order = (uint32_t *)(l->xs + n * (dim + 1));
    l->metric = (koksma__metric){l->units, domain->lengths, domain->torus};
    return KOKSMA_OK;
}

static void lay_out(layout *l, const koksma__point_domain *domain, size_t i, const koksma__domain_point *point)
{
    domain->place(domain->data, point, l->xs + i * (size_t)domain->dim);
    if (l->units) {
        l->units[i] = domain->unit_of(domain->data, point->part);
    }
}

/* Puts n points into progressive order; d_max and d_min are the parameters of the elimination for all n points. */
static koksma_status order_progressively(const koksma__point_domain *domain, size_t n, double d_max, double d_min,
                                         const koksma_run *run, koksma__domain_point *points)
{
    layout l = {0};
    koksma__domain_point *before = malloc(n * sizeof *before);
    KOKSMA__REQUIRE_MEMORY(before, n * sizeof *before);
    memcpy(before, points, n * sizeof *before);
    koksma_status status = layout_init(&l, domain, n);
    for (size_t i = 0; i < n && !status; i++) {
        lay_out(&l, domain, i, &before[i]);
        status = koksma__look(run, i, 0);
    }
    status =
        status ? status : koksma__progressive_order(n, domain->dim, l.xs, &l.metric, 2, d_max, d_min, run, l.order);
    for (size_t i = 0; i < n && !status; i++) {
        points[i] = before[l.order[i]];
    }
    free(l.xs);
    free(before);
    return status;
}

/* Chooses `length` points among factor * length candidates by elimination. */
static koksma_status choose_from(const choice *c, size_t length, size_t factor, double d_max, double d_min,
                                 koksma__domain_point *chosen)
{
    const koksma__point_domain *domain = c->domain;
    const size_t all = factor * length;
    layout l = {0};
    KOKSMA__TRY(layout_init(&l, domain, all));
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < all && !status; i++) {
        koksma__domain_point point;
        domain->draw(domain->data, c->seed, i, &point);
        lay_out(&l, domain, i, &point);
        status = koksma__look(c->run, i, 0);
    }
    status = status
                 ? status
                 : koksma__eliminate_scaled(all, domain->dim, l.xs, &l.metric, length, d_max, d_min, c->run, l.order);
    for (size_t i = 0; i < length && !status; i++) {
        domain->draw(domain->data, c->seed, l.order[i], &chosen[i]);
        status = koksma__look(c->run, i, 1);
    }
    free(l.xs);
    return status;
}

/* Eliminates all but `length` candidates; c->points receives the first n of them, in progressive order if desired. */
static koksma_status eliminate(const choice *c, size_t length, size_t factor, bool progressive)
{
    const size_t most = KOKSMA_MAX_COORDINATES / (size_t)c->domain->dim / factor;
    KOKSMA__FAIL_IF(length > most, KOKSMA_N, "%s: n = %zu is too large; n = %zu or less would do", c->pattern->name,
                    length, most);
    const double d_max = radius_of(c->domain, length),
                 d_min = d_max * koksma__elimination_limit(length, factor * length, 2);
    koksma__domain_point *chosen = malloc(length * sizeof *chosen);
    KOKSMA__REQUIRE_MEMORY(chosen, length * sizeof *chosen);
    koksma_status status = choose_from(c, length, factor, d_max, d_min, chosen);
    if (!status && progressive) {
        status = order_progressively(c->domain, length, d_max, d_min, c->run, chosen);
    }
    if (!status) {
        memcpy(c->points, chosen, c->n * sizeof *chosen);
    }
    free(chosen);
    return status;
}

static koksma_status choose_eliminated(const choice *c)
{
    return eliminate(c, c->n, (size_t)c->params[0], false);
}

static koksma_status choose_progressive(const choice *c)
{
    const size_t length = (size_t)c->params[0];
    KOKSMA__FAIL_IF(c->n > length, KOKSMA_N,
                    "%s: length=%zu has %zu points, not %zu; n = %zu or less, or length=%zu, would do",
                    c->pattern->name, length, length, c->n, length, c->n);
    return eliminate(c, length, (size_t)c->params[1], true);
}

/* ---- The table ------------------------------------------------------------------------------------------- */

/* The patterns that can place points on a domain. A method reads the parameters by their order in the pattern's table
   of parameters. */
static const struct {
    const char *pattern;
    koksma_status (*choose)(const choice *c);
} methods[] = {
    {"random", choose_first},
    {"sample-elimination", choose_eliminated},
    {"progressive-elimination", choose_progressive},
};

koksma_status koksma__domain_choose(const koksma__point_domain *domain, const koksma_spec *spec, uint64_t seed,
                                    const koksma_run *run, size_t n, koksma__domain_point **points)
{
    const koksma_pattern *p = spec->pattern;
    p = p && p->alias_of ? koksma_pattern_find(p->alias_of) : p;
    KOKSMA__FAIL_IF(!p || !p->name, KOKSMA_ARGUMENT, "the spec does not name a pattern");
    KOKSMA__TRY(koksma__generate_check(spec, p, 2));
    for (size_t i = 0; i < KOKSMA_MAX_MODIFIERS; i++) {
        const koksma_modifier *modifier = koksma_modifier_at(i);
        KOKSMA__FAIL_IF(modifier && !(spec->modifiers[i] == 0), KOKSMA_ARGUMENT,
                        "%s: the modifier %s can't be used for points %s", p->name, modifier->name, domain->what);
    }
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        if (!strcmp(methods[i].pattern, p->name)) {
            *points = malloc(n * sizeof **points);
            KOKSMA__REQUIRE_MEMORY(*points, n * sizeof **points);
            const choice c = {domain, p, spec->params, seed, n, run, *points};
            return methods[i].choose(&c);
        }
    }
    return koksma__fail(KOKSMA_UNSUPPORTED,
                        "%s: it can't make points %s; random, sample-elimination and progressive-elimination can",
                        p->name, domain->what);
}
