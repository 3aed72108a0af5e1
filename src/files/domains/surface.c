/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_generate_on: points on the triangles of a model, uniform in area. A candidate is a uniform point in a
 * triangle that is drawn with probability proportional to its area, by bisection in the running sums of the areas;
 * the warp `triangle` maps the unit square to the triangle. The methods of choose.c get positions that are scaled so
 * that the smallest cube about the model becomes the unit cube.
 *
 */
#include <koksma/density.h>
#include <koksma/warp.h>

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/points.h"
#include "core/random.h"
#include "core/status.h"
#include "core/vector.h"
#include "domains/field.h"
#include "meshes/mesh_file.h"

/* ---- The field ---- */

enum { DEEPEST = 24, NODES_A_POINT = 8 };

typedef struct surface_field {
    const koksma__point_domain *domain;
    koksma__nearest *nearest;
    koksma__field *field;
    const koksma_run *run; /* only while the field is opened */
    size_t capacity;
    double width, per_area; /* number of points per area */
} surface_field;

static double width(const void *data, const double *x)
{
    (void)x;
    return ((const surface_field *)data)->width;
}

static bool settle(const void *data, double *x, koksma__domain_point *point)
{
    const surface_field *f = data;
    koksma__nearest_find(f->nearest, x, point);
    f->domain->place(f->domain->data, point, x);
    return true;
}

/* Computes the corners of a triangle and the cross product of two of its edges. */
static void edges_of(const koksma__point_domain *domain, uint32_t part, double c[3][3], double normal[3])
{
    double e[2][3];
    koksma__triangle_corners(domain, part, c);
    koksma__subtract(c[1], c[0], e[0]);
    koksma__subtract(c[2], c[0], e[1]);
    koksma__cross(e[0], e[1], normal);
}

static void along(const void *data, const koksma__domain_point *point, double *vector)
{
    const surface_field *f = data;
    double corners[3][3], normal[3];
    edges_of(f->domain, point->part, corners, normal);
    const double square = koksma__dot(normal, normal), part = square > 0 ? koksma__dot(normal, vector) / square : 0;
    for (int k = 0; k < 3; k++) {
        vector[k] -= part * normal[k];
    }
}

static void close_field(void *data)
{
    surface_field *f = data;
    koksma__nearest_close(f->nearest);
    free(f);
}

/* Adds the node of a triangle or, if it is too large, of its quarters. The covariance matrix of a triangle with edges
   of lengths a, b and c has the trace (a^2 + b^2 + c^2) / 36. */
static koksma_status add_triangle(surface_field *f, const double c[3][3], int depth)
{
    double e[3][3], longest = 0, squares = 0, normal[3], middle[3][3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            e[i][k] = c[(i + 1) % 3][k] - c[i][k];
            middle[i][k] = (c[(i + 1) % 3][k] + c[i][k]) / 2;
        }
        squares += koksma__dot(e[i], e[i]);
        longest = fmax(longest, koksma__dot(e[i], e[i]));
    }
    /* an equilateral triangle with sides of sqrt 2 times that of a square has the variance of the square */
    const double least = M_SQRT2 * KOKSMA__NODE_WIDTHS * f->width;
    if (longest > least * least && depth < DEEPEST) {
        for (int i = 0; i < 4; i++) {
            double quarter[3][3];
            for (int k = 0; k < 3; k++) {
                quarter[0][k] = i < 3 ? c[i][k] : middle[0][k];
                quarter[1][k] = i < 3 ? middle[i][k] : middle[1][k];
                quarter[2][k] = i < 3 ? middle[(i + 2) % 3][k] : middle[2][k];
            }
            KOKSMA__TRY(add_triangle(f, quarter, depth + 1));
        }
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__look(f->run, f->field->n_nodes, 0));
    koksma__cross(e[0], e[1], normal);
    koksma__field_node node = {.mass = f->per_area * 0.5 * sqrt(koksma__dot(normal, normal)),
                               .square = f->width * f->width + squares / 36};
    for (int k = 0; k < 3; k++) {
        node.x[k] = (c[0][k] + c[1][k] + c[2][k]) / 3;
    }
    return node.mass > 0 ? koksma__field_add(f->field, &f->capacity, node) : KOKSMA_OK;
}

/* Compares the cubes that contain two nodes; positions are in units of a cube's side. */
static int by_cube(const koksma__field_node *p, const koksma__field_node *q)
{
    for (int k = 0; k < 3; k++) {
        const double i = floor(p->x[k]), j = floor(q->x[k]);
        if (i != j) {
            return i < j ? -1 : 1;
        }
    }
    return 0;
}

/* Compares the cubes, then the positions, then the masses; nodes that agree in all of these may be in any order. */
static int by_all(const void *a, const void *b)
{
    const koksma__field_node *p = a, *q = b;
    int order = by_cube(p, q);
    for (int k = 0; k < 3 && !order; k++) {
        order = (p->x[k] > q->x[k]) - (p->x[k] < q->x[k]);
    }
    return order ? order : (p->mass > q->mass) - (p->mass < q->mass);
}

/* Replaces the nodes in each cube of side width / 2 by one node at their centroid, weighted by mass, with the sum of
   their masses. Its `square` (field.h) has the variance of their positions about the centroid; their own variances are
   left out. */
static void merge(surface_field *f)
{
    koksma__field_node *nodes = f->field->nodes;
    const double side = f->width / 2;
    const size_t n = f->field->n_nodes;
    for (size_t i = 0; i < n; i++) {
        for (int k = 0; k < 3; k++) {
            nodes[i].x[k] /= side;
        }
    }
    qsort(nodes, n, sizeof *nodes, by_all);
    size_t merged = 0;
    for (size_t i = 0, end; i < n; i = end) {
        koksma__field_node sum = {.mass = 0};
        double spread = 0;
        for (end = i; end < n && by_cube(&nodes[i], &nodes[end]) == 0; end++) {
            sum.mass += nodes[end].mass;
            for (int k = 0; k < 3; k++) {
                sum.x[k] += nodes[end].mass * nodes[end].x[k] * side;
                spread += nodes[end].mass * nodes[end].x[k] * nodes[end].x[k] * side * side;
            }
        }
        for (int k = 0; k < 3; k++) {
            sum.x[k] /= sum.mass;
        }
        spread = fmax(spread / sum.mass - koksma__dot(sum.x, sum.x), 0);
        sum.square = f->width * f->width + spread; /* spread: twice the variance along an axis of the surface */
        nodes[merged++] = sum;
    }
    f->field->n_nodes = merged;
}

static koksma_status open_field(const koksma__point_domain *domain, size_t n, double sigma, const koksma_run *run,
                                koksma__field *field)
{
    surface_field *f = malloc(sizeof *f);
    KOKSMA__REQUIRE_MEMORY(f, sizeof *f);
    *f = (surface_field){.domain = domain, .field = field, .run = run};
    f->width = sigma * sqrt(domain->area / (double)n);
    f->per_area = (double)n / domain->area;
    *field = (koksma__field){.data = f, .width = width, .settle = settle, .along = along, .close = close_field};
    KOKSMA__TRY(
        koksma__nearest_open(domain, run, &f->nearest)); /* the caller closes the field, also after an error */
    for (size_t part = 0; part < domain->n_parts; part++) {
        double corners[3][3], normal[3];
        edges_of(domain, (uint32_t)part, corners, normal);
        KOKSMA__TRY(add_triangle(f, corners, 0));
    }
    if (field->n_nodes > NODES_A_POINT * n) {
        merge(f);
    }
    return KOKSMA_OK;
}

/* ---- The domain ---- */

typedef struct surface {
    koksma__mesh mesh;
    double *sums; /* sums[t]: total area of triangles 0 to t */
    double side;  /* side of the bounding cube */
    const koksma_warp *warp;
} surface;

/* The first corner of a triangle, the two edges from this corner, and their cross product. */
typedef struct triangle {
    double corner[3], edge[2][3], normal[3];
} triangle;

static triangle triangle_of(const koksma__mesh *mesh, size_t t)
{
    triangle a;
    const float *p[3];
    for (size_t c = 0; c < 3; c++) {
        p[c] = mesh->vertices + 3 * (size_t)mesh->indices[3 * t + c];
    }
    for (int k = 0; k < 3; k++) {
        a.corner[k] = (double)p[0][k];
        a.edge[0][k] = (double)p[1][k] - (double)p[0][k];
        a.edge[1][k] = (double)p[2][k] - (double)p[0][k];
    }
    koksma__cross(a.edge[0], a.edge[1], a.normal);
    return a;
}

static double length(const double v[3])
{
    return sqrt(koksma__dot(v, v));
}

static void draw(const void *data, uint64_t seed, uint64_t i, koksma__domain_point *point)
{
    const surface *s = data;
    const size_t n = s->mesh.n_triangles;
    double which[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i, 0, which);
    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i, 1, point->at);
    point->part = (uint32_t)koksma__domain_find(s->sums, n, which[0] * s->sums[n - 1]);
    s->warp->map(point->at, point->at);
}

/* Computes the position of a point in the model's coordinates. */
static void place_in_model(const surface *s, const koksma__domain_point *point, double *x)
{
    const triangle a = triangle_of(&s->mesh, point->part);
    for (int k = 0; k < 3; k++) {
        x[k] = a.corner[k] + point->at[0] * a.edge[0][k] + point->at[1] * a.edge[1][k];
    }
}

static double share(const void *data, size_t part)
{
    const surface *s = data;
    return s->sums[part] - (part ? s->sums[part - 1] : 0);
}

static double unit_of(const void *data, size_t part)
{
    (void)data;
    (void)part;
    return 1;
}

static void place(const void *data, const koksma__domain_point *point, double *x)
{
    const surface *s = data;
    place_in_model(s, point, x);
    for (int k = 0; k < 3; k++) {
        x[k] = fmin(fmax((x[k] - s->mesh.low[k]) / s->side, 0), 1 - 0x1p-53);
    }
}

static void write_points(const surface *s, const koksma__domain_point *points, koksma_points *out)
{
    for (size_t i = 0; i < out->n; i++) {
        double *x = out->xs + i * (size_t)out->dim;
        const size_t t = points[i].part;
        place_in_model(s, &points[i], x);
        if (out->dim >= 6) {
            const triangle a = triangle_of(&s->mesh, t);
            for (int k = 0; k < 3; k++) {
                x[3 + k] = a.normal[k] / length(a.normal);
            }
        }
        if (out->dim == 7) {
            x[6] = (double)t;
        }
    }
}

static koksma_status choose(surface *s, const koksma_spec *spec, uint64_t seed, const koksma_run *run,
                            koksma_points *out)
{
    const size_t n = s->mesh.n_triangles;
    double area = 0;
    s->sums = malloc(n * sizeof *s->sums);
    KOKSMA__REQUIRE_MEMORY(s->sums, n * sizeof *s->sums);
    for (size_t t = 0; t < n; t++) {
        const triangle a = triangle_of(&s->mesh, t);
        s->sums[t] = area += 0.5 * length(a.normal);
    }
    for (int k = 0; k < 3; k++) {
        s->side = fmax(s->side, s->mesh.high[k] - s->mesh.low[k]);
    }
    const koksma__point_domain domain = {.what = "on a model",
                                         .dim = 3,
                                         .corners = 3,
                                         .lengths = {1, 1, 1},
                                         .area = area / s->side / s->side,
                                         .unit = 1 / s->side,
                                         .n_parts = n,
                                         .data = s,
                                         .draw = draw,
                                         .place = place,
                                         .share = share,
                                         .unit_of = unit_of,
                                         .open_field = open_field};
    size_t count = out->n;
    koksma__domain_point *points = NULL;
    koksma_status status = koksma__domain_choose(&domain, spec, seed, run, &count, &points);
    if (!status && !out->n) {
        status = koksma_points_init(out, count, out->dim);
    }
    if (!status) {
        write_points(s, points, out);
    }
    free(points);
    free(s->sums);
    return status;
}

koksma_status koksma_generate_on(const koksma_spec *spec, uint64_t seed, const char *path, const koksma_run *run,
                                 koksma_points *out)
{
    KOKSMA__REQUIRE(spec, path, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(!out->xs != !out->n, KOKSMA_ARGUMENT, "%s: it takes initialised points, or n = 0 and xs = NULL",
                    __func__);
    KOKSMA__FAIL_IF(
        out->dim != 3 && out->dim != 6 && out->dim != 7, KOKSMA_DIM,
        "points on a model have dim = 3, or 6 with their normal, or 7 with their triangle as well; not %d", out->dim);
    KOKSMA__TRY(out->n ? koksma__points_fit(out->n, out->dim) : KOKSMA_OK);
    surface s = {.warp = koksma_warp_find("triangle")};
    koksma_status status = koksma__mesh_read(path, KOKSMA__BY_USER, NULL, &s.mesh);
    status = status ? status : choose(&s, spec, seed, run, out);
    koksma__mesh_fini(&s.mesh);
    return status;
}
