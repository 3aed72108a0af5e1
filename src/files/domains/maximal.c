/* SPDX-License-Identifier: Apache-2.0 */
/*
 * poisson-disk-maximal on a domain: dart throwing until no other point fits. Two points are at least d min(r, r')
 * apart, where r and r' are the units of distance of their parts (domain.h).
 *
 * The free area is a list of pieces: parts (rectangles or triangles) and quarters of them. A piece lies in one part and
 * thus has one unit of distance; it is covered if the ball of one point contains its corners. In each round as many
 * darts are thrown as there are pieces, at random pieces with probabilities proportional to their shares of the points.
 * Then every piece is divided into four, and covered quarters are dropped. The set is maximal when no piece is left;
 * pieces whose side is 2^-30 of that of their part are dropped, too. The points have the distribution of dart
 * throwing on the whole domain, because every dart outside of the pieces would be rejected.
 *
 * dart-throwing throws darts in the same way, but until there are n points. A set that becomes maximal with fewer
 * points is discarded and another one is made, at most 200 in all.
 *
 * d=0 searches for the distance at which a maximal set has exactly n points (patterns/darts/darts.h). The
 * search starts at an estimated distance, which is multiplied by about the square root of (number of points that fit) /
 * n until between 3/4 n and n points fit.
 *
 * Source: Ebeida, Mitchell, Patney, Davidson & Owens 2012 for the flat quadtree; Mitchell, Rand, Ebeida & Bajaj 2012 for
 * radii that vary (their rule "smaller disks"). One set takes O((n + number of parts) log n); the search makes 20 to
 * 40 sets.
 */
#include "domains/domain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "domains/dart_grid.h"
#include "patterns/darts/darts.h"
#include "patterns/spacing/spacing.h"

enum { DEEPEST = 30, ESTIMATES = 30, SEARCHES = 8, RESTARTS = 200 };

#define PER_AREA 0.6965 /* mean of m d^2 for maximal sets of m points on the torus */

/* A piece of a part: the positions at + side * (u, v) with (u, v) in [0,1]^2 and, in a triangle, u + v <= 1. If side is
   negative, the piece is upside down, as the middle quarter of a triangle is. */
typedef struct piece {
    uint32_t part, depth;
    double at[2], side;
} piece;

typedef struct maximal {
    const koksma__choice *c;
    koksma__dart_grid grid;
    koksma__domain_point *points; /* the points in the grid */
    uint64_t seed, darts;
    piece *pieces; /* the free area; sums[i] is the total share of pieces 0 to i */
    double *sums;
    size_t n_pieces, capacity; /* of the pieces */
} maximal;

/* Makes the query that asks whether a point covers a piece. */
static void query_of(const maximal *m, const piece *p, double *centre, koksma__dart_query *q)
{
    static const double units[4][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    const koksma__point_domain *domain = m->c->domain;
    const double middle = domain->corners == 4 ? 0.5 : 1.0 / 3;
    koksma__domain_point at = {p->part, {p->at[0] + middle * p->side, p->at[1] + middle * p->side}};
    domain->place(domain->data, &at, centre);
    *q = (koksma__dart_query){
        .x = centre, .unit = domain->unit_of(domain->data, p->part), .corners = (size_t)domain->corners};
    for (size_t i = 0; i < q->corners; i++) {
        at.at[0] = p->at[0] + units[i][0] * p->side;
        at.at[1] = p->at[1] + units[i][1] * p->side;
        domain->place(domain->data, &at, q->offsets[i]);
        for (int k = 0; k < domain->dim; k++) {
            q->offsets[i][k] -= centre[k];
        }
    }
}

/* Stores a piece if it is not covered. */
static koksma_status store(maximal *m, piece p, piece **pieces, size_t *n)
{
    double centre[3];
    koksma__dart_query q;
    query_of(m, &p, centre, &q);
    if (koksma__dart_grid_meets(&m->grid, &q)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__reserve(pieces, &m->capacity, *n + 1, sizeof **pieces));
    (*pieces)[(*n)++] = p;
    return KOKSMA_OK;
}

/* Makes the first pieces: the parts that have a share of the points and are not covered. n: as for fill(). */
static koksma_status begin(maximal *m, size_t n)
{
    const koksma__point_domain *domain = m->c->domain;
    m->n_pieces = 0;
    for (size_t part = 0; part < domain->n_parts; part++) {
        if (domain->share(domain->data, part) > 0) {
            KOKSMA__TRY(store(m, (piece){.part = (uint32_t)part, .side = 1}, &m->pieces, &m->n_pieces));
            KOKSMA__TRY(koksma__dart_grid_look(&m->grid, n, m->c->run));
        }
    }
    return KOKSMA_OK;
}

/* Divides every piece into four. n: as for fill(). */
static koksma_status divide(maximal *m, size_t n)
{
    piece *old = m->pieces;
    const size_t n_old = m->n_pieces;
    koksma_status status = KOKSMA_OK;
    m->pieces = NULL;
    m->n_pieces = m->capacity = 0;
    for (size_t i = 0; i < n_old && !status; i++) {
        const double half = old[i].side / 2;
        for (int quarter = 0; quarter < 4 && !status && old[i].depth < DEEPEST; quarter++) {
            piece p = {old[i].part, old[i].depth + 1, {old[i].at[0], old[i].at[1]}, half};
            p.at[0] += quarter & 1 ? half : 0;
            p.at[1] += quarter & 2 ? half : 0;
            if (quarter == 3 && m->c->domain->corners == 3) { /* the middle one, upside down */
                p.side = -half;
            }
            status = store(m, p, &m->pieces, &m->n_pieces);
        }
        status = status ? status : koksma__dart_grid_look(&m->grid, n, m->c->run);
    }
    free(old);
    return status;
}

/* Throws as many darts as there are pieces; stops early when there are n points. */
static koksma_status throw_darts(maximal *m, size_t n)
{
    const koksma__point_domain *domain = m->c->domain;
    double *sums = realloc(m->sums, m->n_pieces * sizeof *sums), sum = 0;
    KOKSMA__REQUIRE_MEMORY(sums, m->n_pieces * sizeof *sums);
    m->sums = sums;
    for (size_t i = 0; i < m->n_pieces; i++) {
        const piece *p = &m->pieces[i];
        sums[i] = sum += domain->share(domain->data, p->part) * p->side * p->side;
    }
    for (size_t dart = 0; dart < m->n_pieces && m->grid.n < n; dart++, m->darts++) {
        double which[2], u[2], x[3];
        koksma__random_pair(m->seed, KOKSMA__PURPOSE_DART, m->darts, 0, which);
        koksma__random_pair(m->seed, KOKSMA__PURPOSE_DART, m->darts, 1, u);
        const piece *p = &m->pieces[koksma__domain_find(sums, m->n_pieces, which[0] * sum)];
        if (domain->corners == 3 && u[0] + u[1] > 1) { /* reflects the square's upper half into the triangle */
            u[0] = 1 - u[0];
            u[1] = 1 - u[1];
        }
        const koksma__domain_point point = {p->part, {p->at[0] + u[0] * p->side, p->at[1] + u[1] * p->side}};
        const koksma__dart_query q = {.x = x, .unit = domain->unit_of(domain->data, p->part)};
        domain->place(domain->data, &point, x);
        if (!koksma__dart_grid_meets(&m->grid, &q)) {
            m->points[m->grid.n] = point;
            koksma__dart_grid_add(&m->grid, x, q.unit);
        }
        KOKSMA__TRY(koksma__dart_grid_look(&m->grid, n, m->c->run));
    }
    return KOKSMA_OK;
}

/* Adds points until the set is maximal or has n points. */
static koksma_status fill(maximal *m, size_t n)
{
    KOKSMA__TRY(begin(m, n));
    while (m->n_pieces && m->grid.n < n) {
        KOKSMA__TRY(throw_darts(m, n));
        KOKSMA__TRY(divide(m, n));
        if (!koksma__keep_going(m->c->run, (double)m->grid.n / (double)n)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

static koksma_status shrink(void *set, size_t kept, double d, size_t n, const koksma_run *run, size_t *found)
{
    maximal *m = set;
    (void)run;
    koksma__dart_grid_reset(&m->grid, kept, d);
    const koksma_status status = fill(m, n);
    *found = m->grid.n;
    return status;
}

/* Makes sets of at most 2 n points until one has between 3/4 n and n points, each at a distance estimated from the
   number of points in the previous set; then reduces the distance until n points fit. */
static koksma_status search(maximal *m, uint32_t first)
{
    const size_t n = m->c->n;
    const double step = 1 + 0.3 / sqrt((double)n);
    double d = sqrt(PER_AREA * m->c->domain->area / (double)n) * step;
    for (uint32_t try = 0; try < ESTIMATES; try++) {
        m->seed = koksma__random_seed(m->c->seed, first + try, KOKSMA__PURPOSE_DART);
        m->darts = 0;
        koksma__dart_grid_reset(&m->grid, 0, d);
        KOKSMA__TRY(fill(m, 2 * n));
        if (m->grid.n == n) {
            return KOKSMA_OK;
        }
        if (m->grid.n < n && m->grid.n >= n - n / 4) {
            return koksma__maximal_shrink(2, d, m->grid.n, n, m->c->run, shrink, m);
        }
        d *= sqrt((double)m->grid.n / (double)n) * step;
    }
    const size_t found = m->grid.n;
    return found > n ? koksma__fail(KOKSMA_IMPOSSIBLE,
                                    "poisson-disk-maximal: no distance gives %zu points %s; n = %zu would do", n,
                                    m->c->domain->what, found)
                     : koksma__maximal_shrink(2, d, found, n, m->c->run, shrink, m);
}

static koksma_status by_number(maximal *m)
{
    koksma_status status = search(m, 0);
    for (uint32_t again = 1; status == KOKSMA_IMPOSSIBLE && again < SEARCHES; again++) {
        status = search(m, again * ESTIMATES);
    }
    return status;
}

static koksma_status by_distance(maximal *m)
{
    const size_t n = m->c->n;
    m->seed = m->c->seed;
    KOKSMA__TRY(fill(m, m->grid.capacity));
    KOKSMA__FAIL_IF(m->grid.n == m->grid.capacity, KOKSMA_N,
                    "poisson-disk-maximal: d=%g has more than %zu points %s, not %zu; a larger d, or no d, would do",
                    m->c->params[0], m->grid.n - 1, m->c->domain->what, n);
    KOKSMA__FAIL_IF(
        m->grid.n != n, KOKSMA_N,
        "poisson-disk-maximal: d=%g with this seed has %zu points %s, not %zu; n = %zu, or no n, or no d, would do",
        m->c->params[0], m->grid.n, m->c->domain->what, n, m->grid.n);
    return KOKSMA_OK;
}

/* Throws n points that are at least the distance of the grid apart; starts again with another seed if fewer fit. */
static koksma_status by_fraction(maximal *m)
{
    const size_t n = m->c->n;
    const double d = m->grid.d;
    size_t most = 0;
    for (uint32_t restart = 0; restart < RESTARTS; restart++) {
        m->seed = restart ? koksma__random_seed(m->c->seed, restart, KOKSMA__PURPOSE_DART) : m->c->seed;
        m->darts = 0;
        koksma__dart_grid_reset(&m->grid, 0, d);
        KOKSMA__TRY(fill(m, n));
        if (m->grid.n == n) {
            return KOKSMA_OK;
        }
        most = m->grid.n > most ? m->grid.n : most;
        if (restart >= 5 && (double)most < 0.97 * (double)n - 1) {
            break; /* even the best of six tries is far from n points */
        }
    }
    return koksma__fail(KOKSMA_IMPOSSIBLE, "dart-throwing: f=%g jams at %zu of %zu points %s; a smaller f would do",
                        m->c->params[0], most, n, m->c->domain->what);
}

/* Makes at most `capacity` points of the task c by a method, and stores their number; d is the initial distance, for which
   the grid's cells are sized. */
static koksma_status choose(const koksma__choice *c, size_t capacity, double d, koksma_status (*method)(maximal *m),
                            size_t *n)
{
    maximal m = {.c = c};
    koksma_status status = koksma__dart_grid_init(&m.grid, c->domain, c->domain->torus, capacity, d);
    if (!status) {
        m.points = malloc(capacity * sizeof *m.points);
        status = m.points ? KOKSMA_OK : koksma__fail_memory(capacity * sizeof *m.points);
    }
    status = status ? status : method(&m);
    if (!status) {
        *n = m.grid.n;
        memcpy(c->points, m.points, *n * sizeof *c->points);
    }
    koksma__dart_grid_fini(&m.grid);
    KOKSMA__FREE(m.points, m.pieces, m.sums);
    return status;
}

static koksma_status by_distance_alone(maximal *m)
{
    m->seed = m->c->seed;
    return fill(m, m->grid.capacity);
}

/* How many points a distance gives is known after the darts: a set that has filled its capacity, twice the expected
   number, is made again with more, by the same darts. */
koksma_status koksma__choose_by_distance(koksma__choice *c)
{
    const double d = c->params[0] * c->domain->unit, most = KOKSMA_MAX_COORDINATES / 3;
    for (double capacity = 2 * PER_AREA * c->domain->area / d / d + 64; capacity <= 2 * most; capacity *= 2) {
        c->n = (size_t)fmin(capacity, most);
        c->points = malloc(c->n * sizeof *c->points);
        KOKSMA__REQUIRE_MEMORY(c->points, c->n * sizeof *c->points);
        const size_t room = c->n;
        KOKSMA__TRY(choose(c, room, d, by_distance_alone, &c->n));
        if (c->n < room) {
            return KOKSMA_OK;
        }
        KOKSMA__FREE(c->points);
        c->points = NULL;
    }
    return koksma__fail(KOKSMA_N, "poisson-disk-maximal: d=%g gives more than %.2g points %s; a larger d would do",
                        c->params[0], most, c->domain->what);
}

koksma_status koksma__choose_maximal(const koksma__choice *c)
{
    const double d = c->params[0] * c->domain->unit;
    size_t n; /* c->n, or the method has failed */
    return choose(c, 4 * c->n + 1024, d > 0 ? d : sqrt(PER_AREA * c->domain->area / (double)c->n),
                  d > 0 ? by_distance : by_number, &n);
}

koksma_status koksma__choose_fraction(const koksma__choice *c)
{
    const double densest = koksma__packing_distance(c->n, 2, true) * sqrt(c->domain->area);
    size_t n; /* c->n, or the method has failed */
    return choose(c, c->n, c->params[0] * densest, by_fraction, &n);
}
