/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Searches all disks with two given points on their rim, whose circles form a pencil. With 2h the distance of the two
 * points, `middle` their midpoint and n the unit normal of the line through them, the centres are middle + t n, |t|
 * <= top, and the squared radius is h^2 + t^2 <= r^2.
 *
 * A third point at the vector q from the midpoint is inside if |q|^2 - h^2 - 2 t q.n <= 0, which holds on a half-line
 * of t. So each point enters or leaves the disk at one value of t, an event. The events are sorted by t and visited
 * with a running count. Between events the count is constant and the area is monotonic on either side of t = 0, so
 * that the supremum is at an event, at t = 0 (for the excess of closed disks, which is largest for the least area) or
 * at |t| = top (for the deficit of open disks, which is largest for the largest area).
 *
 * Before sorting, the events are counted in BINS equal intervals of t, and each bin is bounded by its most favourable
 * count and its most favourable area. If no bin can exceed the best disk so far, the pencil is skipped. Skipping a
 * pencil takes O(n), searching it O(n log n). On the torus several periodic images of a point may be near enough to
 * matter. Points whose squared distance is within KOKSMA__DISK_RIM of the squared radius count as on the rim; this is
 * more than the rounding errors of squared distances.
 */
#include "measures/disk/disk.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"

enum { BINS = 32 };

/* An event: a point enters (delta > 0) or leaves the disk when the centre of the disk passes position t. */
typedef struct event {
    double t;
    long delta;
} event;

/* The disks through two points 2h apart, with centre middle + t normal, |t| <= top. */
typedef struct pencil {
    const koksma__disk_set *set;
    koksma__disk_best *best;
    double middle[2], normal[2];
    double h2, top;
    bool closed;
    long count; /* number of points inside at t = -top */
    event *events;
    size_t n_events;
} pencil;

void koksma__disk_try(const koksma__disk_set *set, koksma__disk_best *best, bool closed, size_t count,
                      const double *centre, double square_radius)
{
    const double volume = M_PI * square_radius, share = (double)count / (double)set->n;
    const double value = closed ? share - volume : volume - share;
    if (value <= best->value) {
        return;
    }
    best->value = value;
    best->witness =
        (koksma_witness){.kind = KOKSMA_WITNESS_DISK, .dim = 2, .closed = closed, .count = count, .volume = volume};
    best->witness.lo[0] = centre[0] - floor(centre[0]);
    best->witness.lo[1] = centre[1] - floor(centre[1]);
    best->witness.hi[0] = sqrt(square_radius);
}

static void add_event(pencil *p, double t, long delta)
{
    p->events[p->n_events++] = (event){t, delta};
}

/* Adds the event of a point at the vector q from the midpoint. The point is inside if |q|^2 - h^2 - 2 t q.n <= 0.
   Points on the rim are inside a closed disk and outside an open one. */
static void add_point(pencil *p, double qx, double qy, long weight)
{
    const double slope = 2 * (qx * p->normal[0] + qy * p->normal[1]);
    const double a = qx * qx + qy * qy - p->h2 + (p->closed ? -KOKSMA__DISK_RIM : KOKSMA__DISK_RIM);
    if (slope == 0 || fabs(a) > fabs(slope) * p->top) {
        p->count += a < 0 || (p->closed && a == 0) ? weight : 0;
    } else if (slope > 0) {
        add_event(p, a / slope, weight);
    } else {
        p->count += weight;
        add_event(p, a / slope, -weight);
    }
}

/* Fills p->count and p->events for the pencil through points i and j. On the torus several periodic images of a point
   may be near enough to matter. */
static void fill(pencil *p, size_t i, size_t j)
{
    const koksma__disk_set *set = p->set;
    const double reach = p->top + set->r + 1e-7, reach2 = reach * reach;
    p->count = p->closed ? (long)(set->weights[i] + set->weights[j]) : 0;
    p->n_events = 0;
    const int images = reach > 0.5 ? 4 : 1; /* visit the nearest periodic image, or all images that can be less than 1
                                               away */
    for (size_t k = 0; k < set->m; k++) {
        const double dx = set->xs[k] - p->middle[0], dy = set->ys[k] - p->middle[1];
        const double x = dx - round(dx), y = dy - round(dy);
        if (k == i || k == j || x * x + y * y > reach2) {
            continue;
        }
        const double xs[2] = {x, x > 0 ? x - 1 : x + 1}, ys[2] = {y, y > 0 ? y - 1 : y + 1};
        for (int image = 0; image < images; image++) {
            const double a = xs[image % 2], b = ys[image / 2];
            if (a * a + b * b <= reach2) {
                add_point(p, a, b, (long)set->weights[k]);
            }
        }
    }
}

/* Returns whether some disk of the pencil may be better than the best so far. The bound for each bin combines its
   most favourable count with its most favourable area. */
static bool promising(const pencil *p)
{
    long enter[BINS] = {0}, leave[BINS] = {0}, count = p->count;
    const double step = 2 * p->top / BINS, scale = p->top > 0 ? BINS / (2 * p->top) : 0;
    for (size_t e = 0; e < p->n_events; e++) {
        const double place = (p->events[e].t + p->top) * scale;
        const int bin = place < 0 ? 0 : place < BINS - 1 ? (int)place : BINS - 1;
        enter[bin] += p->events[e].delta > 0 ? p->events[e].delta : 0;
        leave[bin] -= p->events[e].delta < 0 ? p->events[e].delta : 0;
    }
    for (int b = 0; b < BINS; b++) {
        const double near = fabs(b < BINS / 2 ? (b + 1) * step - p->top : b * step - p->top),
                     far = fabs(b < BINS / 2 ? b * step - p->top : (b + 1) * step - p->top);
        const double n = (double)p->set->n, slack = 1e-12;
        const double bound = p->closed ? (double)(count + enter[b]) / n - M_PI * (p->h2 + near * near)
                                       : M_PI * (p->h2 + far * far) - (double)(count - leave[b]) / n;
        if (bound + slack > p->best->value) {
            return true;
        }
        count += enter[b] - leave[b];
    }
    return false;
}

/* Orders events by position t; at equal positions the events that increase the deviation come first. */
static int compare_closed(const void *a, const void *b)
{
    const event *p = a, *q = b;
    return p->t != q->t ? (p->t > q->t) - (p->t < q->t) : (p->delta < q->delta) - (p->delta > q->delta);
}

static int compare_open(const void *a, const void *b)
{
    const event *p = a, *q = b;
    return p->t != q->t ? (p->t > q->t) - (p->t < q->t) : (p->delta > q->delta) - (p->delta < q->delta);
}

static void walk(pencil *p)
{
    long count = p->count;
    qsort(p->events, p->n_events, sizeof *p->events, p->closed ? compare_closed : compare_open);
    for (size_t e = 0; e < p->n_events; e++) {
        const double t = p->events[e].t;
        const long delta = p->events[e].delta;
        const bool better = p->closed ? delta > 0 : delta < 0;
        count += better ? delta : 0;
        const double centre[2] = {p->middle[0] + t * p->normal[0], p->middle[1] + t * p->normal[1]};
        koksma__disk_try(p->set, p->best, p->closed, (size_t)count, centre, p->h2 + t * t);
        count += better ? 0 : delta;
    }
}

/* Tries the disks through points i and j, where (dx, dy) is the vector from i to the image of j. */
static void try_pair(pencil *p, size_t i, size_t j, double dx, double dy)
{
    const double length2 = dx * dx + dy * dy, length = sqrt(length2), r = p->set->r;
    if (length2 > 4 * r * r || length2 == 0) {
        return;
    }
    p->middle[0] = p->set->xs[i] + dx / 2;
    p->middle[1] = p->set->ys[i] + dy / 2;
    p->normal[0] = -dy / length;
    p->normal[1] = dx / length;
    p->h2 = length2 / 4;
    p->top = sqrt(fmax(r * r - p->h2, 0));
    for (int closed = 0; closed < 2; closed++) {
        p->closed = closed;
        fill(p, i, j);
        if (closed) { /* also try, if closed, the smallest disk; if open, the two largest */
            add_event(p, 0, 0);
        } else {
            add_event(p, -p->top, 0);
            add_event(p, p->top, 0);
        }
        if (promising(p)) {
            walk(p);
        }
    }
}

static koksma_status open_pencil(pencil *p, const koksma__disk_set *set, koksma__disk_best *best)
{
    const size_t bytes = (4 * set->m + 2) * sizeof(event);
    *p = (pencil){.set = set, .best = best, .events = malloc(bytes)};
    return p->events ? KOKSMA_OK : koksma__fail_memory(bytes);
}

koksma_status koksma__disk_pair(const koksma__disk_set *set, size_t i, size_t j, double dx, double dy,
                                koksma__disk_best *best)
{
    pencil p;
    KOKSMA__TRY(open_pencil(&p, set, best));
    try_pair(&p, i, j, dx, dy);
    free(p.events);
    return KOKSMA_OK;
}

koksma_status koksma__disk_pencils(const koksma__disk_set *set, size_t i, koksma__disk_best *best)
{
    pencil p;
    KOKSMA__TRY(open_pencil(&p, set, best));
    for (size_t j = i + 1; j < set->m; j++) {
        const double dx = set->xs[j] - set->xs[i], dy = set->ys[j] - set->ys[i];
        const double xs[2] = {dx, dx > 0 ? dx - 1 : dx + 1}, ys[2] = {dy, dy > 0 ? dy - 1 : dy + 1};
        for (int image = 0; image < 4; image++) {
            try_pair(&p, i, j, xs[image % 2], ys[image / 2]);
        }
    }
    free(p.events);
    return KOKSMA_OK;
}
