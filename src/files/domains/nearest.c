/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Nearest positions on triangles, by a hierarchy of boxes: a set of more than four triangles is halved at the median of
 * their centroids along the longest side of the centroids' bounding box. A search visits the nearer half first and
 * leaves out boxes that are further away than the best position so far. The nearest position of one triangle is that of
 * Ericson, Real-Time Collision Detection (2005), 5.1.5. Building takes O(n log n); a search takes about O(log n) if it
 * starts near the result.
 */
#include "domains/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/vector.h"

enum { LEAF = 4 };

typedef struct box {
    double low[3], high[3];
} box;

struct koksma__nearest {
    const koksma__point_domain *domain;
    size_t n;
    uint32_t *order;             /* the triangles, leaf by leaf */
    box *boxes;                  /* node i has the children 2 i + 1 and 2 i + 2 */
    double *centroids, *corners; /* three and nine coordinates of each triangle */
};

void koksma__triangle_corners(const koksma__point_domain *domain, uint32_t part, double corners[3][3])
{
    static const double at[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    for (int c = 0; c < 3; c++) {
        const koksma__domain_point point = {part, {at[c][0], at[c][1]}};
        domain->place(domain->data, &point, corners[c]);
    }
}

static void add_to_box(box *b, const double x[3])
{
    for (int k = 0; k < 3; k++) {
        b->low[k] = fmin(b->low[k], x[k]);
        b->high[k] = fmax(b->high[k], x[k]);
    }
}

static koksma_status build(const koksma__nearest *s, size_t node, size_t first, size_t end, const koksma_run *run)
{
    const box empty = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    box all = empty, centroids = empty;
    for (size_t i = first; i < end; i++) {
        double corners[3][3];
        koksma__triangle_corners(s->domain, s->order[i], corners);
        for (int c = 0; c < 3; c++) {
            add_to_box(&all, corners[c]);
        }
        add_to_box(&centroids, s->centroids + 3 * (size_t)s->order[i]);
    }
    s->boxes[node] = all;
    if (end - first <= LEAF) {
        return koksma__look(run, node, 0);
    }
    int axis = 0;
    for (int k = 1; k < 3; k++) {
        axis = centroids.high[k] - centroids.low[k] > centroids.high[axis] - centroids.low[axis] ? k : axis;
    }
    const size_t middle = first + (end - first) / 2;
    koksma__select(s->order, first, end, middle, s->centroids, 3, (size_t)axis);
    KOKSMA__TRY(build(s, 2 * node + 1, first, middle, run));
    return build(s, 2 * node + 2, middle, end, run);
}

koksma_status koksma__nearest_open(const koksma__point_domain *domain, const koksma_run *run, koksma__nearest **out)
{
    size_t n_boxes = 1;
    for (size_t largest = domain->n_parts; largest > LEAF; largest -= largest / 2) {
        n_boxes = 2 * n_boxes + 1;
    }
    const size_t n = domain->n_parts, bytes = sizeof(koksma__nearest) + n_boxes * sizeof(box) +
                                              12 * n * sizeof(double) + n * sizeof(uint32_t);
    koksma__nearest *s = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(s, bytes);
    *s = (koksma__nearest){.domain = domain, .n = n, .boxes = (box *)(s + 1)};
    s->centroids = (double *)(s->boxes + n_boxes);
    s->corners = s->centroids + 3 * n;
    s->order = (uint32_t *)(s->corners + 9 * n);
    for (size_t i = 0; i < n; i++) {
        const koksma__domain_point centre = {(uint32_t)i, {1.0 / 3, 1.0 / 3}};
        s->order[i] = (uint32_t)i;
        domain->place(domain->data, &centre, s->centroids + 3 * i);
        koksma__triangle_corners(domain, (uint32_t)i, (double(*)[3])(s->corners + 9 * i));
    }
    *out = s; /* the caller closes it, also after an interruption */
    return build(s, 0, 0, n, run);
}

void koksma__nearest_close(koksma__nearest *s)
{
    free(s);
}

/* Returns the t in [0,1] for which the point from + t (to - from) of an edge is nearest to x. */
static double along_edge(const double *x, const double *from, const double *to)
{
    double edge[3], way[3];
    koksma__subtract(to, from, edge);
    koksma__subtract(x, from, way);
    const double square = koksma__dot(edge, edge);
    return square > 0 ? fmin(fmax(koksma__dot(edge, way) / square, 0), 1) : 0;
}

/* Computes the position of a triangle that is nearest to x, as the weights of its corners 1 and 2. */
static void nearest_on(const double c[3][3], const double *x, double at[2])
{
    double e1[3], e2[3], way[3], best = INFINITY;
    koksma__subtract(c[1], c[0], e1);
    koksma__subtract(c[2], c[0], e2);
    koksma__subtract(x, c[0], way);
    const double a = koksma__dot(e1, e1), b = koksma__dot(e1, e2), d = koksma__dot(e2, e2), p = koksma__dot(e1, way),
                 q = koksma__dot(e2, way);
    const double area = a * d - b * b, u = (d * p - b * q) / area, v = (a * q - b * p) / area;
    if (area > 0 && u >= 0 && v >= 0 && u + v <= 1) {
        at[0] = u;
        at[1] = v;
        return;
    }
    const double t[3] = {along_edge(x, c[0], c[1]), along_edge(x, c[0], c[2]), along_edge(x, c[1], c[2])};
    const double tries[3][2] = {{t[0], 0}, {0, t[1]}, {1 - t[2], t[2]}};
    for (int i = 0; i < 3; i++) {
        double off[3];
        for (int k = 0; k < 3; k++) {
            off[k] = tries[i][0] * e1[k] + tries[i][1] * e2[k] - way[k];
        }
        if (koksma__dot(off, off) < best) {
            best = koksma__dot(off, off);
            memcpy(at, tries[i], 2 * sizeof *at);
        }
    }
}

/* A search: the nearest position found so far, and its squared distance. */
typedef struct hunt {
    const koksma__nearest *s;
    const double *x;
    koksma__domain_point *found;
    double best;
} hunt;

static void try_triangle(hunt *h, uint32_t part)
{
    const double(*corners)[3] = (const double(*)[3])(h->s->corners + 9 * (size_t)part);
    double square = 0;
    koksma__domain_point p = {.part = part};
    nearest_on(corners, h->x, p.at);
    for (int k = 0; k < 3; k++) {
        const double y =
            corners[0][k] + p.at[0] * (corners[1][k] - corners[0][k]) + p.at[1] * (corners[2][k] - corners[0][k]);
        square += (y - h->x[k]) * (y - h->x[k]);
    }
    if (square < h->best) {
        h->best = square;
        *h->found = p;
    }
}

static double to_box(const box *b, const double *x)
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        const double below = b->low[k] - x[k], above = x[k] - b->high[k], most = below > above ? below : above;
        square += most > 0 ? most * most : 0;
    }
    return square;
}

static void visit(hunt *h, size_t node, size_t first, size_t end)
{
    if (end - first <= LEAF) {
        for (size_t i = first; i < end; i++) {
            try_triangle(h, h->s->order[i]);
        }
        return;
    }
    const size_t middle = first + (end - first) / 2;
    const double to[2] = {to_box(&h->s->boxes[2 * node + 1], h->x), to_box(&h->s->boxes[2 * node + 2], h->x)};
    for (int i = 0; i < 2; i++) {
        const bool second = (to[1] < to[0]) != (i == 1);
        if (to[second] < h->best) {
            visit(h, 2 * node + 1 + second, second ? middle : first, second ? end : middle);
        }
    }
}

void koksma__nearest_find(const koksma__nearest *s, const double x[3], koksma__domain_point *found)
{
    hunt h = {.s = s, .x = x, .found = found, .best = INFINITY};
    try_triangle(&h, found->part);
    visit(&h, 0, 0, s->n);
}
