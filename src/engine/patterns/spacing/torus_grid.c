/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A grid of square cells over the torus, each with a linked list of its points, so that adding a point takes O(1).
 * The search for the nearest point visits rings of cells from the inside outwards until no further ring can contain a
 * nearer point: O(1) if points are evenly distributed. If all points are known in advance,
 * core/torus_rows.c sorts them into cells at once.
 */
#include "patterns/spacing/spacing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "core/vector.h"

koksma_status koksma__torus_grid_init(koksma__torus_grid *g, size_t n, const double *xs)
{
    *g = (koksma__torus_grid){.xs = xs};
    g->cells = (uint32_t)ceil(sqrt((double)n));
    const size_t cells = (size_t)g->cells * g->cells;
    g->head = malloc((cells + n) * sizeof *g->head);
    KOKSMA__REQUIRE_MEMORY(g->head, (cells + n) * sizeof *g->head);
    g->next = g->head + cells;
    koksma__torus_grid_clear(g);
    return KOKSMA_OK;
}

void koksma__torus_grid_fini(koksma__torus_grid *g)
{
    free(g->head);
    g->head = NULL;
}

void koksma__torus_grid_clear(koksma__torus_grid *g)
{
    memset(g->head, 0xff, (size_t)g->cells * g->cells * sizeof *g->head);
}

static uint32_t *list_of(const koksma__torus_grid *g, uint32_t point)
{
    return &g->head[(size_t)koksma__cell_along(g->xs[2 * (size_t)point + 1], g->cells) * g->cells +
                    koksma__cell_along(g->xs[2 * (size_t)point], g->cells)];
}

void koksma__torus_grid_add(koksma__torus_grid *g, uint32_t point)
{
    uint32_t *list = list_of(g, point);
    g->next[point] = *list;
    *list = point;
}

/* Returns the smaller of `best` and the squared distance from (x, y) to the nearest point of a cell. The indices of
   the cell may be outside the grid by up to one period. */
static double nearest_in(const koksma__torus_grid *g, long cell_x, long cell_y, double x, double y, double best)
{
    const long cells = (long)g->cells;
    cell_x -= cell_x >= cells ? cells : cell_x < 0 ? -cells : 0;
    cell_y -= cell_y >= cells ? cells : cell_y < 0 ? -cells : 0;
    for (uint32_t i = g->head[cell_y * cells + cell_x]; i != KOKSMA__NO_POINT; i = g->next[i]) {
        const double a = koksma__torus_difference(x, g->xs[2 * (size_t)i]),
                     b = koksma__torus_difference(y, g->xs[2 * (size_t)i + 1]);
        best = a * a + b * b < best ? a * a + b * b : best;
    }
    return best;
}

double koksma__torus_grid_nearest(const koksma__torus_grid *g, double x, double y, double enough)
{
    const long cx = koksma__cell_along(x, g->cells), cy = koksma__cell_along(y, g->cells), most = (long)g->cells / 2;
    double best = 1;
    for (long ring = 0; ring <= most && best > enough; ring++) {
        const double gap = (double)(ring - 1) / g->cells; /* the points of this ring, and of all rings outside it, are
                                                             at least this far from (x, y) */
        if (ring > 1 && gap * gap >= best) {
            break;
        }
        for (long t = -ring; t <= ring; t++) {
            best = nearest_in(g, cx + t, cy - ring, x, y, best);
            best = nearest_in(g, cx + t, cy + ring, x, y, best);
        }
        for (long t = 1 - ring; t < ring; t++) {
            best = nearest_in(g, cx - ring, cy + t, x, y, best);
            best = nearest_in(g, cx + ring, cy + t, x, y, best);
        }
    }
    return best;
}

/* A span: `count` consecutive cells along one axis, beginning with cell `first` and wrapping around the torus. */
typedef struct span {
    long first, count;
} span;

static span span_about(const koksma__torus_grid *g, double x, long reach)
{
    const long cells = (long)g->cells, first = ((long)koksma__cell_along(x, g->cells) - reach) % cells;
    return (span){first < 0 ? first + cells : first, 2 * reach + 1 < cells ? 2 * reach + 1 : cells};
}

/* Returns the index of cell i of a span. */
static inline long around(const koksma__torus_grid *g, const span *s, long i)
{
    const long cell = s->first + i;
    return cell < (long)g->cells ? cell : cell - (long)g->cells;
}

bool koksma__torus_grid_near(const koksma__torus_grid *g, double x, double y, double d, bool torus)
{
    const long half = (long)g->cells / 2 + 1, wide = (long)(fmin(d, 1) * g->cells * (1 + 1e-9)) + 1;
    const long reach = wide < half ? wide : half;
    const span columns = span_about(g, x, reach), rows = span_about(g, y, reach);
    for (long v = 0; v < rows.count; v++) {
        const uint32_t *row = g->head + around(g, &rows, v) * (long)g->cells;
        for (long u = 0; u < columns.count; u++) {
            for (uint32_t i = row[around(g, &columns, u)]; i != KOKSMA__NO_POINT; i = g->next[i]) {
                const double px = g->xs[2 * (size_t)i], py = g->xs[2 * (size_t)i + 1];
                const double a = torus ? koksma__torus_difference(x, px) : px - x,
                             b = torus ? koksma__torus_difference(y, py) : py - y;
                if (a * a + b * b < d * d) {
                    return true;
                }
            }
        }
    }
    return false;
}
