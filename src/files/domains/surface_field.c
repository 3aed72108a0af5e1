/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The target (field.h) of gaussian-blue-noise on a model: every point has the width sigma sqrt(area / n), and a moved
 * point returns to the nearest position of the model. Nodes are the triangles, quartered until no edge is longer than
 * 1.4 widths. If this makes more than 8 nodes for each point, all nodes in a cube with a side of half a width become
 * one node at their centroid.
 *
 * Distances are measured in space, not along the surface; the other methods do the same. At an open border of the model
 * the density ends, which keeps points from crowding there.
 */
#include "domains/surface_field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "domains/nearest.h"

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

static void cross(const double *a, const double *b, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Computes the corners of a triangle and the cross product of two of its edges. */
static void edges_of(const koksma__point_domain *domain, uint32_t part, double c[3][3], double normal[3])
{
    static const double at[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    double e[2][3];
    for (int i = 0; i < 3; i++) {
        const koksma__domain_point point = {part, {at[i][0], at[i][1]}};
        domain->place(domain->data, &point, c[i]);
    }
    for (int k = 0; k < 3; k++) {
        e[0][k] = c[1][k] - c[0][k];
        e[1][k] = c[2][k] - c[0][k];
    }
    cross(e[0], e[1], normal);
}

static void along(const void *data, const koksma__domain_point *point, double *vector)
{
    const surface_field *f = data;
    double corners[3][3], normal[3];
    edges_of(f->domain, point->part, corners, normal);
    const double square = dot(normal, normal), part = square > 0 ? dot(normal, vector) / square : 0;
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
        squares += dot(e[i], e[i]);
        longest = fmax(longest, dot(e[i], e[i]));
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
    cross(e[0], e[1], normal);
    koksma__field_node node = {.mass = f->per_area * 0.5 * sqrt(dot(normal, normal)),
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
        spread = fmax(spread / sum.mass - dot(sum.x, sum.x), 0);
        sum.square = f->width * f->width + spread; /* spread: twice the variance along an axis of the surface */
        nodes[merged++] = sum;
    }
    f->field->n_nodes = merged;
}

koksma_status koksma__surface_field_open(const koksma__point_domain *domain, size_t n, double sigma,
                                         const koksma_run *run, koksma__field *field)
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
