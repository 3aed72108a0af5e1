/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_generate_on: points on the triangles of a model, uniform in area. A candidate is a uniform point in a
 * triangle that is drawn with probability proportional to its area, by bisection in the running sums of the areas;
 * the warp `triangle` maps the unit square to the triangle. The methods of choose.c get positions that are scaled so
 * that the smallest cube about the model becomes the unit cube.
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
#include "domains/domain.h"
#include "meshes/mesh_file.h"

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
                                         .lengths = {1, 1, 1},
                                         .area = area / s->side / s->side,
                                         .data = s,
                                         .draw = draw,
                                         .place = place};
    koksma__domain_point *points = NULL;
    koksma_status status = koksma__domain_choose(&domain, spec, seed, run, out->n, &points);
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
    KOKSMA__FAIL_IF(!out->xs || !out->n, KOKSMA_ARGUMENT, "%s: it takes initialised points", __func__);
    KOKSMA__FAIL_IF(
        out->dim != 3 && out->dim != 6 && out->dim != 7, KOKSMA_DIM,
        "points on a model have dim = 3, or 6 with their normal, or 7 with their triangle as well; not %d", out->dim);
    KOKSMA__TRY(koksma__points_fit(out->n, out->dim));
    surface s = {.warp = koksma_warp_find("triangle")};
    koksma_status status = koksma__mesh_read(path, KOKSMA__BY_USER, NULL, &s.mesh);
    status = status ? status : choose(&s, spec, seed, run, out);
    koksma__mesh_fini(&s.mesh);
    return status;
}
