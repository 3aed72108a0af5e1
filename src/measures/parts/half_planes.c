/* SPDX-License-Identifier: Apache-2.0 */
#include "measures/parts/half_planes.h"

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"

static const double on_line = 4e-15;

/* At this angle of the line a point comes to its left (delta 1) or leaves it (-1). */
typedef struct event {
    double angle, share; /* the area's share on the left */
    double u[2];
    int delta;
} event;

typedef struct best {
    double value;
    koksma_witness witness;
} best;

typedef struct search {
    const koksma__warped *points;
    const koksma__convex *domain;
    best *blocks;
} search;

typedef struct pivot {
    const search *s;
    double p[2];
    bool closed;
    long count; /* on the left at angle -pi */
    event *events;
    size_t n_events;
    best *best;
} pivot;

static void keep(const pivot *v, const event *e, long count)
{
    const double n = (double)v->s->points->n, share = (double)count / n;
    const double value = v->closed ? share - e->share : e->share - share;
    if (value <= v->best->value) {
        return;
    }
    v->best->value = value;
    v->best->witness = (koksma_witness){.kind = KOKSMA_WITNESS_HALF_PLANE,
                                        .dim = 2,
                                        .closed = v->closed,
                                        .count = (size_t)count,
                                        .volume = e->share,
                                        .lo = {e->u[1], -e->u[0]},
                                        .hi = {e->u[1] * v->p[0] - e->u[0] * v->p[1]}};
}

static double wrapped(double angle)
{
    return angle < -M_PI ? angle + 2 * M_PI : angle >= M_PI ? angle - 2 * M_PI : angle;
}

/* A point at distance from the pivot in direction d is on the left while the line's angle is in (its own - pi, its
   own); a closed half-plane holds it a little longer, an open one not so long. */
static void add_point(pivot *v, const double *d, double distance)
{
    const double angle = atan2(d[1], d[0]), margin = v->closed ? on_line / distance : -on_line / distance;
    const double share = v->s->domain->share(v->p, d), enter = wrapped(angle - M_PI - margin),
                 leave = wrapped(angle + margin);
    v->events[v->n_events++] = (event){enter, 1 - share, {-d[0], -d[1]}, 1};
    v->events[v->n_events++] = (event){leave, share, {d[0], d[1]}, -1};
    v->count += leave < enter;
}

static void add_chords(pivot *v)
{
    double directions[KOKSMA__MAX_CHORDS][2];
    const int count = v->s->domain->chords(v->p, directions);
    for (int c = 0; c < count; c++) {
        const double *u = directions[c], other[2] = {-u[0], -u[1]};
        v->events[v->n_events++] = (event){atan2(u[1], u[0]), v->s->domain->share(v->p, u), {u[0], u[1]}, 0};
        v->events[v->n_events++] =
            (event){atan2(other[1], other[0]), v->s->domain->share(v->p, other), {other[0], other[1]}, 0};
    }
}

/* By angle; at one angle those that make the deviation larger first. */
static int compare_closed(const void *a, const void *b)
{
    const event *p = a, *q = b;
    return p->angle != q->angle ? (p->angle > q->angle) - (p->angle < q->angle) : q->delta - p->delta;
}

static int compare_open(const void *a, const void *b)
{
    const event *p = a, *q = b;
    return p->angle != q->angle ? (p->angle > q->angle) - (p->angle < q->angle) : p->delta - q->delta;
}

static void turn(pivot *v)
{
    const koksma__warped *w = v->s->points;
    v->count = 0;
    v->n_events = 0;
    for (size_t i = 0; i < w->n; i++) {
        const double dx = w->xs[i] - v->p[0], dy = w->xs[w->n + i] - v->p[1], distance = hypot(dx, dy);
        if (distance <= on_line) {
            v->count += v->closed;
        } else {
            add_point(v, (double[]){dx / distance, dy / distance}, distance);
        }
    }
    add_chords(v);
    qsort(v->events, v->n_events, sizeof *v->events, v->closed ? compare_closed : compare_open);
    long count = v->count;
    for (size_t e = 0; e < v->n_events; e++) {
        const int delta = v->events[e].delta;
        const bool better = v->closed ? delta > 0 : delta < 0;
        count += better ? delta : 0;
        keep(v, &v->events[e], count);
        count += better ? 0 : delta;
    }
}

static koksma_status block(void *context, size_t i)
{
    search *s = context;
    const koksma__warped *w = s->points;
    const size_t bytes = (2 * w->n + 2 * KOKSMA__MAX_CHORDS) * sizeof(event);
    s->blocks[i].value = -1;
    pivot v = {.s = s, .p = {w->xs[i], w->xs[w->n + i]}, .events = malloc(bytes), .best = &s->blocks[i]};
    if (!v.events) {
        return koksma__fail_memory(bytes);
    }
    for (int closed = 0; closed < 2; closed++) {
        v.closed = closed;
        turn(&v);
    }
    free(v.events);
    return KOKSMA_OK;
}

koksma_status koksma__half_planes(const koksma__warped *points, const koksma__convex *domain, const koksma_run *run,
                                  koksma_value *out)
{
    search s = {.points = points, .domain = domain, .blocks = malloc(points->n * sizeof *s.blocks)};
    if (!s.blocks) {
        return koksma__fail_memory(points->n * sizeof *s.blocks);
    }
    const koksma_status status = koksma__parallel(run, points->n, block, &s);
    size_t top = 0;
    for (size_t i = 1; !status && i < points->n; i++) {
        top = s.blocks[i].value > s.blocks[top].value ? i : top;
    }
    if (!status) {
        out->value = s.blocks[top].value;
        out->witness = s.blocks[top].witness;
    }
    free(s.blocks);
    return status;
}
