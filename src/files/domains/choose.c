/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes points on a domain (domain.h) with the method of a pattern; the table at the end lists the patterns that have
 * such a method. These methods choose among candidates, which are independent and have the wanted density:
 *
 *   random                 the first n candidates
 *   elimination            n of factor * n candidates, chosen by patterns/spacing/elimination.c, which also makes the
 *                          progressive order; its radius d_max is that for n points in the unit square, times the square
 *                          root of the domain's area
 *   poisson-disk           the candidates in turn, except those that are too near to one already chosen (dart_grid.c);
 *                          it fails after 20,000 rejections in a row
 *   best-candidate         point k is, of k * candidates + 1 candidates, the one that is furthest from points 0 to k - 1. A
 *                          query of dart_grid.c rejects most candidates that are nearer than the best one so far; the
 *                          few others are compared with all points. With c candidates for each point this takes
 *                          O(n (c + n log c)) in the plane
 *
 * poisson-disk-maximal and dart-throwing (maximal.c), and gaussian-blue-noise (gaussian.c; not on models), work
 * differently. With order=progressive, patterns/spacing/elimination.c orders the points that they have made. Each part
 * of a domain has a unit of distance; the distance of two points is measured in the smaller of their two units. Where
 * the pattern's d decides how many points there are, the method counts them.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "core/parallel.h"
#include "core/status.h"
#include "core/vector.h"
#include "domains/dart_grid.h"
#include "domains/domain.h"
#include "patterns/spacing/spacing.h"

enum { REJECTIONS = 20000 };

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

/* ---- Darts ----------------------------------------------------------------------------------------------- */

static koksma_status throw_darts(const choice *c, koksma__dart_grid *grid)
{
    const koksma__point_domain *domain = c->domain;
    size_t rejections = 0;
    for (uint64_t dart = 0; grid->n < c->n; dart++) {
        double x[3];
        koksma__domain_point *point = &c->points[grid->n];
        domain->draw(domain->data, c->seed, dart, point);
        domain->place(domain->data, point, x);
        const koksma__dart_query q = {.x = x, .unit = domain->unit_of(domain->data, point->part)};
        if (koksma__dart_grid_meets(grid, &q)) {
            KOKSMA__FAIL_IF(++rejections == REJECTIONS, KOKSMA_IMPOSSIBLE,
                            "%s: dart throwing placed %zu of %zu points at d=%g %s and jammed; n = %zu or less, or a "
                            "smaller d, would do",
                            c->pattern->name, grid->n, c->n, c->params[0], domain->what, grid->n);
        } else {
            rejections = 0;
            koksma__dart_grid_add(grid, x, q.unit);
        }
        KOKSMA__TRY(koksma__dart_grid_look(grid, c->n, c->run));
    }
    return KOKSMA_OK;
}

static koksma_status choose_darts(const choice *c)
{
    const bool torus = c->domain->torus && c->params[1] > 0;
    KOKSMA__FAIL_IF(c->params[1] > 0 && !c->domain->torus, KOKSMA_ARGUMENT,
                    "%s: torus=1: there is no torus %s; torus=0 would do", c->pattern->name, c->domain->what);
    koksma__dart_grid grid;
    koksma_status status = koksma__dart_grid_init(&grid, c->domain, torus, c->n, c->params[0] * c->domain->unit);
    status = status ? status : throw_darts(c, &grid);
    koksma__dart_grid_fini(&grid);
    return status;
}

/* ---- Best candidates ------------------------------------------------------------------------------------- */

/* Returns the square of the smallest distance from a candidate to a point of the grid; each distance is divided by
   the smaller of the units of distance of the two. */
static double squared_room(koksma__dart_grid *grid, const koksma__dart_query *q)
{
    const size_t dim = (size_t)grid->dim;
    grid->work += grid->n;
    double least = INFINITY;
    for (size_t i = 0; i < grid->n; i++) {
        const double unit = fmin(q->unit, grid->units[i]);
        double square = 0;
        for (size_t k = 0; k < dim; k++) {
            const double y = grid->xs[i * dim + k];
            const double along = grid->torus ? koksma__torus_difference(y, q->x[k]) : q->x[k] - y;
            square += grid->lengths[k] * along * (grid->lengths[k] * along);
        }
        least = fmin(least, square / (unit * unit));
    }
    return least;
}

/* Adds as next point the best of `count` candidates. */
static koksma_status add_best(const choice *c, size_t count, koksma__dart_grid *grid)
{
    const koksma__point_domain *domain = c->domain;
    double best = -1, position[3] = {0}, unit = 0;
    grid->d = 0;
    for (size_t i = 0; i < count; i++) {
        double x[3];
        koksma__domain_point point;
        domain->draw(domain->data, c->seed, (uint64_t)grid->n << 24 | i, &point);
        domain->place(domain->data, &point, x);
        const koksma__dart_query q = {.x = x, .unit = domain->unit_of(domain->data, point.part)};
        const double room = koksma__dart_grid_meets(grid, &q) ? -1 : squared_room(grid, &q);
        if (room > best) {
            best = room;
            grid->d = sqrt(best);
            unit = q.unit;
            memcpy(position, x, (size_t)grid->dim * sizeof *x);
            c->points[grid->n] = point;
        }
        KOKSMA__TRY(koksma__dart_grid_look(grid, c->n, c->run));
    }
    koksma__dart_grid_add(grid, position, unit);
    return KOKSMA_OK;
}

static koksma_status choose_best(const choice *c)
{
    koksma__dart_grid grid;
    koksma_status status = koksma__dart_grid_init(&grid, c->domain, c->domain->torus, c->n,
                                                  sqrt(c->domain->area / (double)c->n)); /* the cells' width */
    for (size_t i = 0; i < c->n && !status; i++) {
        status = add_best(c, (size_t)fmin(c->params[0] * (double)i + 1, c->params[1]), &grid);
    }
    koksma__dart_grid_fini(&grid);
    return status;
}

/* ---- The table ------------------------------------------------------------------------------------------- */

static koksma_status order_finished(const choice *c)
{
    return order_progressively(c->domain, c->n, radius_of(c->domain, c->n), 0, c->run, c->points);
}

/* The patterns that can place points on a domain. A method reads the parameters by their order in the pattern's table
   of parameters. */
static const struct {
    const char *pattern;
    koksma_status (*choose)(const choice *c);
    size_t order; /* index of the parameter that asks for progressive order; 0: there is none */
} methods[] = {
    {"random", choose_first, 0},
    {"sample-elimination", choose_eliminated, 0},
    {"progressive-elimination", choose_progressive, 0},
    {"poisson-disk", choose_darts, 0},
    {"poisson-disk-maximal", koksma__choose_maximal, 1},
    {"dart-throwing", koksma__choose_fraction, 0},
    {"best-candidate", choose_best, 0},
    {"gaussian-blue-noise", koksma__choose_gaussian, 3},
};

/* Makes the points of the task by method number i. If c->n is 0, the method finds their number. Allocates c->points. */
static koksma_status choose_by(size_t i, koksma__choice *c)
{
    if (!c->n) {
        KOKSMA__FAIL_IF(
            strcmp(c->pattern->name, "poisson-disk-maximal") != 0 || !(c->params[0] > 0), KOKSMA_N,
            "%s: the number of points is missing; only poisson-disk-maximal:d=D makes points %s without it",
            c->pattern->name, c->domain->what);
        KOKSMA__TRY(koksma__choose_by_distance(c));
    } else {
        c->points = malloc(c->n * sizeof *c->points);
        KOKSMA__REQUIRE_MEMORY(c->points, c->n * sizeof *c->points);
        KOKSMA__TRY(methods[i].choose(c));
    }
    return methods[i].order && c->params[methods[i].order] > 0 ? order_finished(c) : KOKSMA_OK;
}

koksma_status koksma__domain_choose(const koksma__point_domain *domain, const koksma_spec *spec, uint64_t seed,
                                    const koksma_run *run, size_t *n, koksma__domain_point **points)
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
        const bool possible = methods[i].choose != koksma__choose_gaussian || domain->open_field;
        if (!strcmp(methods[i].pattern, p->name) && possible) {
            choice c = {domain, p, spec->params, seed, *n, run, NULL};
            const koksma_status status = choose_by(i, &c);
            *n = c.n;
            *points = c.points;
            return status;
        }
    }
    return koksma__fail(KOKSMA_UNSUPPORTED,
                        "%s: it can't make points %s; random, best-candidate, dart-throwing, sample-elimination, "
                        "progressive-elimination, poisson-disk%s can",
                        p->name, domain->what,
                        domain->open_field ? ", poisson-disk-maximal and gaussian-blue-noise"
                                           : " and poisson-disk-maximal");
}
