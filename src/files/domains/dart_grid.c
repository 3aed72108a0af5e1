/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds the points that conflict with a position or a region: each cell of a grid has a list of its points, and a
 * query visits the cells within d times the unit of distance of its position or region. A ball is convex, so it
 * contains a region if it contains the region's corners. On the torus only the image of a point that is nearest to
 * the position is tested, against all corners of the region.
 */
#include "domains/dart_grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "core/vector.h"

#define NONE UINT32_MAX

/* LOOKS: the work between two questions whether to go on; QUERY: the work that a query takes besides its cells. */
enum { LOOKS = 1 << 21, QUERY = 1 << 8 };

static size_t cells_of(const koksma__dart_grid *g)
{
    const size_t square = (size_t)g->side * g->side;
    return g->dim == 2 ? square : square * g->side;
}

koksma_status koksma__dart_grid_init(koksma__dart_grid *g, const koksma__point_domain *domain, bool torus,
                                     size_t capacity, double d)
{
    const size_t dim = (size_t)domain->dim;
    *g = (koksma__dart_grid){.dim = domain->dim, .torus = torus, .capacity = capacity, .side = 1};
    memcpy(g->lengths, domain->lengths, sizeof g->lengths);
    const double length =
        koksma__pow(g->lengths[0] * g->lengths[1] * (dim > 2 ? g->lengths[2] : 1), 1.0 / domain->dim);
    const double most = fmin(koksma__pow((double)capacity, 1.0 / domain->dim), d > 0 ? length / d : 1);
    g->side = most > 1 ? (uint32_t)most : 1;
    const size_t bytes = capacity * ((dim + 1) * sizeof *g->xs + sizeof *g->next) + cells_of(g) * sizeof *g->head;
    g->xs = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(g->xs, bytes);
    g->units = g->xs + capacity * dim;
    g->next = (uint32_t *)(g->units + capacity);
    g->head = g->next + capacity;
    koksma__dart_grid_reset(g, 0, d);
    return KOKSMA_OK;
}

void koksma__dart_grid_fini(koksma__dart_grid *g)
{
    free(g->xs);
    *g = (koksma__dart_grid){0};
}

/* Puts point i, whose position and unit are stored, into its cell. */
static void link_point(koksma__dart_grid *g, size_t i)
{
    const size_t cell = koksma__cell_index(g->xs + i * (size_t)g->dim, g->dim, g->side);
    g->next[i] = g->head[cell];
    g->head[cell] = (uint32_t)i;
}

void koksma__dart_grid_reset(koksma__dart_grid *g, size_t n, double d)
{
    g->d = d;
    g->n = n;
    memset(g->head, 0xff, cells_of(g) * sizeof *g->head);
    for (size_t i = 0; i < n; i++) {
        link_point(g, i);
    }
}

void koksma__dart_grid_add(koksma__dart_grid *g, const double *x, double unit)
{
    memcpy(g->xs + g->n * (size_t)g->dim, x, (size_t)g->dim * sizeof *x);
    g->units[g->n] = unit;
    link_point(g, g->n++);
}

static bool conflicts(const koksma__dart_grid *g, const koksma__dart_query *q, uint32_t i)
{
    const size_t dim = (size_t)g->dim;
    const double d = g->d * fmin(q->unit, g->units[i]);
    double t[3];
    for (size_t k = 0; k < dim; k++) {
        const double y = g->xs[i * dim + k];
        t[k] = g->lengths[k] * (g->torus ? koksma__torus_difference(y, q->x[k]) : q->x[k] - y);
    }
    for (size_t c = 0; c < q->corners || (c == 0 && q->corners == 0); c++) {
        double square = 0;
        for (size_t k = 0; k < dim; k++) {
            const double to = q->corners ? t[k] + g->lengths[k] * q->offsets[c][k] : t[k];
            square += to * to;
        }
        if (!(square < d * d)) {
            return false;
        }
    }
    return true;
}

/* Returns whether a point conflicts with the query, by recursion over the axes k and later: visits the cells within
   reach whose index along the axes before k is `row`. */
static bool meets(koksma__dart_grid *g, int k, size_t row, const koksma__dart_query *q)
{
    if (k == g->dim) {
        g->work++;
        for (uint32_t i = g->head[row]; i != NONE; i = g->next[i]) {
            if (conflicts(g, q, i)) {
                return true;
            }
        }
        return false;
    }
    const size_t reach = (size_t)fmin(ceil(g->d * q->unit / g->lengths[k] * (double)g->side), (double)g->side);
    const size_t own = koksma__cell_along(q->x[k], g->side);
    size_t first = own > reach ? own - reach : 0, some = (own + reach < g->side ? own + reach + 1 : g->side) - first;
    if (g->torus) {
        some = 2 * reach + 1 < g->side ? 2 * reach + 1 : g->side;
        first = some < g->side ? (own + g->side - reach) % g->side : 0;
    }
    for (size_t i = 0; i < some; i++) {
        if (meets(g, k + 1, row * g->side + (first + i) % g->side, q)) {
            return true;
        }
    }
    return false;
}

bool koksma__dart_grid_meets(koksma__dart_grid *g, const koksma__dart_query *q)
{
    g->work += QUERY;
    return meets(g, 0, 0, q);
}

koksma_status koksma__dart_grid_look(koksma__dart_grid *g, size_t n, const koksma_run *run)
{
    if (g->work < LOOKS) {
        return KOKSMA_OK;
    }
    g->work = 0;
    return koksma__keep_going(run, (double)g->n / (double)n) ? KOKSMA_OK : koksma__fail_interrupted();
}
