/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Loop's subdivision (Loop 1987), with the masks of Pharr, Jakob and Humphreys (Physically Based Rendering, 3rd edition,
 * section 3.8). Each level adds a vertex on every edge and moves the old vertices; after the last level all vertices
 * are moved to the limit surface, which infinitely many levels would reach. A vertex v has n neighbours, whose sum is
 * N; b is 3 / (8 n), or 3/16 for n = 3. The masks are
 *
 *   old vertex      (1 - n b) v + b N                   at a border with the neighbours p, q:  3/4 v + 1/8 (p + q)
 *   edge v w        3/8 (v + w) + 1/8 (c + d), the corners opposite to it                      1/2 (v + w)
 *   limit           (1 - n g) v + g N, g = 1 / (n + 3 / (8 b))                                 3/5 v + 1/5 (p + q)
 *
 * A border is an edge of one triangle, or of more than two. A vertex without border edges is moved by the masks on the
 * left, a vertex with two border edges by the masks on the right, and any other vertex is not moved. Edges are found by
 * sorting the triangles' sides by their two vertices, in linear time for any mesh; a hash table would take the square
 * of that for indices that are chosen so that their hashes agree. Normals are computed from the fine triangles,
 * weighted by angles; they approach the normals of the limit surface.
 */
#include "meshes/mesh.h"

#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"

/* An edge between the vertices a < b, the first two corners opposite to it, and its number of triangles. */
typedef struct edge {
    uint32_t a, b, opposite[2], n;
} edge;

/* What surrounds a vertex: the sum of its n neighbours, and the sum of the neighbours to which its border edges lead;
   `borders` is the number of these edges. */
typedef struct ring {
    double sum[3], border_sum[3];
    uint32_t n, borders;
} ring;

typedef struct level {
    size_t n_vertices, n_triangles, n_edges;
    double *vertices;
    uint32_t *corners, *sides; /* sides: for each corner the edge from it to the next corner */
    edge *edges;
    ring *rings;
} level;

static void fini(level *l)
{
    KOKSMA__FREE(l->vertices, l->corners, l->sides, l->edges, l->rings);
    *l = (level){0};
}

/* Allocates the arrays of a level of this size; a level has at most as many edges as triangle corners. */
static koksma_status init(level *l, size_t n_vertices, size_t n_triangles)
{
    *l = (level){.n_vertices = n_vertices, .n_triangles = n_triangles};
    l->vertices = malloc((3 * n_vertices + 1) * sizeof *l->vertices);
    l->corners = malloc((3 * n_triangles + 1) * sizeof *l->corners);
    l->sides = malloc((3 * n_triangles + 1) * sizeof *l->sides);
    l->edges = malloc((3 * n_triangles + 1) * sizeof *l->edges);
    l->rings = calloc(n_vertices + 1, sizeof *l->rings);
    if (!l->vertices || !l->corners || !l->sides || !l->edges || !l->rings) {
        fini(l);
        return koksma__fail_memory(3 * n_triangles * sizeof *l->edges);
    }
    return KOKSMA_OK;
}

/* The two ends of the side that begins at corner i: the smaller and the larger vertex. */
static uint32_t end_of(const level *l, size_t i, bool larger)
{
    const uint32_t v = l->corners[i], w = l->corners[i - i % 3 + (i + 1) % 3];
    return (v < w) == larger ? w : v;
}

/* Sorts the sides in `from`, or all in their order if it is NULL, by one of their ends into `to`; those with the
   same end stay in their order. `starts` has a place more than there are vertices. */
static void sort_by(const level *l, bool larger, const uint32_t *from, uint32_t *starts, uint32_t *to)
{
    const size_t n = 3 * l->n_triangles;
    memset(starts, 0, (l->n_vertices + 1) * sizeof *starts);
    for (size_t i = 0; i < n; i++) {
        starts[end_of(l, i, larger) + 1]++;
    }
    for (size_t v = 0; v < l->n_vertices; v++) {
        starts[v + 1] += starts[v];
    }
    for (size_t i = 0; i < n; i++) {
        const uint32_t side = from ? from[i] : (uint32_t)i;
        to[starts[end_of(l, side, larger)]++] = side;
    }
}

/* Sets first[i] to the first side between the same two vertices as side i. `order` and `starts` are scratch. */
static void find_alike(const level *l, uint32_t *order, uint32_t *starts, uint32_t *first)
{
    const size_t n = 3 * l->n_triangles;
    sort_by(l, true, NULL, starts, order);
    sort_by(l, false, order, starts, first);
    memcpy(order, first, n * sizeof *order);
    uint32_t found = 0;
    for (size_t i = 0; i < n; i++) {
        const uint32_t side = order[i];
        if (!i || end_of(l, side, false) != end_of(l, found, false) ||
            end_of(l, side, true) != end_of(l, found, true)) {
            found = side;
        }
        first[side] = found;
    }
}

static void add_neighbour(level *l, uint32_t to, uint32_t other, bool is_border)
{
    ring *r = &l->rings[to];
    r->n++;
    r->borders += is_border;
    for (int k = 0; k < 3; k++) {
        const double x = l->vertices[3 * (size_t)other + (size_t)k];
        r->sum[k] += x;
        r->border_sum[k] += is_border ? x : 0;
    }
}

/* Finds the edges and what surrounds each vertex. */
static koksma_status connect(level *l)
{
    const size_t n = 3 * l->n_triangles;
    uint32_t *order = malloc((n + 1) * sizeof *order), *first = malloc((n + 1) * sizeof *first);
    uint32_t *starts = malloc((l->n_vertices + 1) * sizeof *starts);
    if (!order || !first || !starts) {
        KOKSMA__FREE(order, first, starts);
        return koksma__fail_memory((2 * n + l->n_vertices) * sizeof *order);
    }
    find_alike(l, order, starts, first);
    for (size_t i = 0; i < n; i++) {
        if (first[i] == i) {
            l->sides[i] = (uint32_t)l->n_edges;
            l->edges[l->n_edges++] = (edge){.a = end_of(l, i, false), .b = end_of(l, i, true)};
        } else {
            l->sides[i] = l->sides[first[i]];
        }
        edge *e = &l->edges[l->sides[i]];
        if (e->n < 2) {
            e->opposite[e->n] = l->corners[i - i % 3 + (i + 2) % 3];
        }
        e->n++;
    }
    KOKSMA__FREE(order, first, starts);
    for (size_t i = 0; i < l->n_edges; i++) {
        const edge *e = &l->edges[i];
        add_neighbour(l, e->a, e->b, e->n != 2);
        add_neighbour(l, e->b, e->a, e->n != 2);
    }
    return KOKSMA_OK;
}

/* Moves vertex i by the mask `old vertex` or by the mask `limit` (see the top of this file). */
static void move(const level *l, size_t i, bool to_limit, double out[3])
{
    const ring *r = &l->rings[i];
    const double n = r->n, b = r->n == 3 ? 3.0 / 16 : 3 / (8 * n), inner = to_limit ? 1 / (n + 3 / (8 * b)) : b;
    const double border = to_limit ? 1.0 / 5 : 1.0 / 8;
    for (size_t k = 0; k < 3; k++) {
        const double v = l->vertices[3 * i + k];
        out[k] = r->borders == 2       ? (1 - 2 * border) * v + border * r->border_sum[k]
                 : r->borders || !r->n ? v
                                       : (1 - n * inner) * v + inner * r->sum[k];
    }
}

static void place_on_edge(const level *l, const edge *e, double out[3])
{
    for (size_t k = 0; k < 3; k++) {
        const double ends = l->vertices[3 * (size_t)e->a + k] + l->vertices[3 * (size_t)e->b + k];
        out[k] =
            e->n != 2
                ? ends / 2
                : 3.0 / 8 * ends +
                      (l->vertices[3 * (size_t)e->opposite[0] + k] + l->vertices[3 * (size_t)e->opposite[1] + k]) / 8;
    }
}

/* Divides each triangle into four: one at each corner and one in the middle. */
static koksma_status divide(const level *from, level *to)
{
    const uint32_t n = (uint32_t)from->n_vertices;
    KOKSMA__TRY(init(to, from->n_vertices + from->n_edges, 4 * from->n_triangles));
    for (size_t i = 0; i < from->n_vertices; i++) {
        move(from, i, false, to->vertices + 3 * i);
    }
    for (size_t i = 0; i < from->n_edges; i++) {
        place_on_edge(from, &from->edges[i], to->vertices + 3 * (n + i));
    }
    for (size_t t = 0; t < from->n_triangles; t++) {
        const uint32_t *v = from->corners + 3 * t, *s = from->sides + 3 * t;
        const uint32_t divided[12] = {v[0],     n + s[0], n + s[2], n + s[0], v[1],     n + s[1],
                                      n + s[2], n + s[1], v[2],     n + s[0], n + s[1], n + s[2]};
        memcpy(to->corners + 12 * t, divided, sizeof divided);
    }
    return connect(to);
}

static koksma_status start(const koksma__mesh *mesh, level *out)
{
    KOKSMA__TRY(init(out, mesh->n_vertices, mesh->n_triangles));
    for (size_t i = 0; i < 3 * mesh->n_vertices; i++) {
        out->vertices[i] = (double)mesh->vertices[i];
    }
    memcpy(out->corners, mesh->indices, 3 * mesh->n_triangles * sizeof *out->corners);
    return connect(out);
}

static koksma_status finish(const level *l, koksma__mesh *out)
{
    KOKSMA__TRY(koksma__mesh_init(l->n_vertices, l->n_triangles, false, false, out));
    for (size_t i = 0; i < l->n_vertices; i++) {
        double v[3];
        move(l, i, true, v);
        for (size_t k = 0; k < 3; k++) {
            out->vertices[3 * i + k] = (float)v[k];
        }
    }
    memcpy(out->indices, l->corners, 3 * l->n_triangles * sizeof *out->indices);
    KOKSMA__TRY(koksma__mesh_check(out));
    return koksma__mesh_smooth_by_angles(out);
}

koksma_status koksma__mesh_loop(const koksma__mesh *mesh, int levels, koksma__mesh *out)
{
    level now = {0}, next = {0};
    koksma_status status = start(mesh, &now);
    for (int i = 0; !status && i < levels; i++) {
        if (now.n_triangles > KOKSMA__MAX_TRIANGLES / 4) {
            status =
                koksma__fail(KOKSMA_MALFORMED, "a mesh divided into more than %zu triangles", KOKSMA__MAX_TRIANGLES);
            break;
        }
        status = divide(&now, &next);
        fini(&now);
        now = next;
        next = (level){0};
    }
    status = status ? status : finish(&now, out);
    fini(&now);
    return status;
}
