/* SPDX-License-Identifier: Apache-2.0 */
/*
 * edge in 3 dimensions. The deficit of an open half-space is the excess of its complement, a closed half-space. So
 * the measure is the supremum of count/n - volume over closed half-spaces. It is reached by a half-space that has the
 * least volume among those that contain some subset of the points. Consider the section of its bounding plane with
 * the cube. This plane goes through three points; or through two points whose line contains the centroid of the
 * section (otherwise turning the plane about that line would reduce the volume); or through one point, which is the
 * centroid.
 *
 * The cube is unchanged by reflection in its centre. For such bodies Meyer and Reisner (1991) proved: for each
 * v < 1/2 there is a convex body in the cube such that every plane that cuts off the volume v touches this body, at
 * the centroid of the plane's section. The bodies are nested: the larger v, the smaller the body. Therefore only one
 * of these bodies touches a given line or a given point. Hence, as a plane turns about a line, the volume has one
 * minimum and one maximum, opposite to each other, and is stationary nowhere else: golden section search finds the
 * minimum. For planes through a point, compute for each horizontal line through the point the least volume over the
 * planes through that line. As a function of the direction of the line this least volume has one minimum.
 *
 * There is one exception: many sections can have the same centroid if it is on an axis of the cube. The volume is
 * then constant while the plane turns. Then some optimal plane also goes through another point and through a corner
 * of the cube or a third point; or the plane can turn without meeting another point, and the plane perpendicular to
 * the axis is optimal.
 *
 * The cost is n^3/6 planes with one pass over the points for each plane. A point within 2e-15 of a plane counts as on
 * it, which causes errors of a few 1e-15 in the values. Normals of planes through three points are computed with 106
 * bits, because the points may be almost collinear.
 */
#include "measures/edge/edge.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "core/double_double.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "measures/shared/shared.h"

/* SECONDS: number of second points in a block. With 1024 points, a block then takes some ten milliseconds, after which
   the caller is asked whether to go on. */
enum { MAX_N = 1024, SECONDS = 16, ABOUT_LINE = 8, ABOUT_POINT = 64, STEPS = 72 };

static const double on_plane = 2e-15;

/* The closed half-space a . x <= c. */
typedef struct half_space {
    double value, a[3], c, volume;
} half_space;

typedef struct search {
    size_t n;
    const double *points;
    double *coordinates[3];
    size_t parts;     /* number of blocks of each first point */
    half_space *best; /* the best half-space of each block */
    double deadline_s;
    atomic_bool late;
} search;

/* The planes through p with normal e cos(angle) + f sin(angle). */
typedef struct fan {
    const double *p;
    double e[3], f[3];
} fan;

/* Returns a . x, with the order of additions that users need to check a witness. */
static double project(const double a[3], const double x[3])
{
    return a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
}

/* Tries the half-spaces on both sides of the plane through p with this normal. */
static void consider(const search *s, half_space *best, const double normal[3], const double p[3])
{
    const double size = fmax(fabs(normal[0]), fmax(fabs(normal[1]), fabs(normal[2])));
    if (!(size > 0)) {
        return;
    }
    const double a[3] = {normal[0] / size, normal[1] / size, normal[2] / size};
    const double c = project(a, p), low = c - on_plane, high = c + on_plane, n = (double)s->n;
    const double *x = s->coordinates[0], *y = s->coordinates[1], *z = s->coordinates[2];
    double below = 0, above = 0;
    for (size_t i = 0; i < s->n; i++) {
        const double here = a[0] * x[i] + a[1] * y[i] + a[2] * z[i];
        below += here <= high ? 1.0 : 0.0;
        above += here >= low ? 1.0 : 0.0;
    }
    const double volume = koksma__volume_below_through(a, p);
    if (below / n - volume > best->value) {
        *best = (half_space){below / n - volume, {a[0], a[1], a[2]}, c, volume};
    }
    if (above / n - (1 - volume) > best->value) {
        *best = (half_space){above / n - (1 - volume), {-a[0], -a[1], -a[2]}, -c, 1 - volume};
    }
}

static void normal_at(const fan *f, double angle, double normal[3])
{
    double x, y;
    koksma__cos_sin(angle, &x, &y);
    for (int k = 0; k < 3; k++) {
        normal[k] = x * f->e[k] + y * f->f[k];
    }
}

/* A function of an angle: about_line gives the volume below the plane of a fan at this angle, about_point the least
   volume below the planes through p that contain the horizontal direction at this angle. The function writes the
   normal of the plane to best, unless best is NULL. */
typedef double (*turned)(const double *p, const void *context, double angle, double best[3]);

static double golden(turned f, const double *p, const void *context, double low, double high)
{
    const double ratio = (sqrt(5.0) - 1) / 2;
    double left = high - ratio * (high - low), right = low + ratio * (high - low);
    double at_left = f(p, context, left, NULL), at_right = f(p, context, right, NULL);
    for (int step = 0; step < STEPS; step++) {
        if (at_left < at_right) {
            high = right;
            right = left;
            at_right = at_left;
            left = high - ratio * (high - low);
            at_left = f(p, context, left, NULL);
        } else {
            low = left;
            left = right;
            at_left = at_right;
            right = low + ratio * (high - low);
            at_right = f(p, context, right, NULL);
        }
    }
    return at_left < at_right ? left : right;
}

static double about_line(const double *p, const void *context, double angle, double best[3])
{
    double normal[3];
    normal_at(context, angle, best ? best : normal);
    return koksma__volume_below_through(best ? best : normal, p);
}

/* Returns the angle where f is least. f has one minimum and one maximum in a period, so the minimum is in one of the
   two intervals beside the least of equidistant samples. */
static double least(turned f, const double *p, const void *context, double period, int samples)
{
    const double step = period / samples;
    double angle = 0, value = HUGE_VAL;
    for (int k = 0; k < samples; k++) {
        const double here = f(p, context, k * step, NULL);
        if (here < value) {
            value = here;
            angle = k * step;
        }
    }
    const double before = golden(f, p, context, angle - step, angle),
                 after = golden(f, p, context, angle, angle + step);
    const double at_before = f(p, context, before, NULL), at_after = f(p, context, after, NULL);
    angle = at_before < value ? before : angle;
    value = at_before < value ? at_before : value;
    return at_after < value ? after : angle;
}

static double least_about_line(const fan *f, double best[3])
{
    return about_line(f->p, f, least(about_line, f->p, f, 2 * M_PI, ABOUT_LINE), best);
}

static double about_point(const double *p, const void *context, double angle, double best[3])
{
    double normal[3];
    (void)context;
    const fan f = {p, {-koksma__sin(angle), koksma__cos(angle), 0}, {0, 0, 1}};
    return least_about_line(&f, best ? best : normal);
}

static void try_point(const search *s, half_space *best, const double *p)
{
    static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double normal[3];
    for (int k = 0; k < 3; k++) { /* planes perpendicular to the axes, which include the faces of the cube */
        consider(s, best, axes[k], p);
    }
    about_point(p, NULL, least(about_point, p, NULL, M_PI, ABOUT_POINT), normal);
    consider(s, best, normal, p);
}

/* (q - p) x (r - p) */
static void normal_through(const double *p, const double *q, const double *r, double normal[3])
{
    koksma__dd u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = koksma__dd_sum(q[k], -p[k]);
        v[k] = koksma__dd_sum(r[k], -p[k]);
    }
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        const koksma__dd less = koksma__dd_mul(u[m], v[l]);
        normal[k] = koksma__dd_add(koksma__dd_mul(u[l], v[m]), (koksma__dd){-less.hi, -less.lo}).hi;
    }
}

/* Sets f to the fan of planes through p and q, with two unit vectors normal to q - p and to each other. Returns false
   if p equals q. */
static bool fan_about(const double *p, const double *q, fan *f)
{
    double u[3], size = 0;
    for (int k = 0; k < 3; k++) {
        u[k] = q[k] - p[k];
        size = fmax(size, fabs(u[k]));
    }
    if (!(size > 0)) {
        return false;
    }
    double square = 0; /* of the line's direction, with a largest component of 1 */
    for (int k = 0; k < 3; k++) {
        u[k] /= size;
        square += u[k] * u[k];
    }
    const double length = sqrt(square);
    int least_axis = 0;
    for (int k = 0; k < 3; k++) {
        u[k] /= length;
        least_axis = fabs(u[k]) < fabs(u[least_axis]) ? k : least_axis;
    }
    const int l = (least_axis + 1) % 3, m = (least_axis + 2) % 3;
    const double across = sqrt(u[l] * u[l] + u[m] * u[m]);
    *f = (fan){.p = p};
    f->e[l] = -u[m] / across;
    f->e[m] = u[l] / across;
    for (int k = 0; k < 3; k++) {
        f->f[k] = u[(k + 1) % 3] * f->e[(k + 2) % 3] - u[(k + 2) % 3] * f->e[(k + 1) % 3];
    }
    return true;
}

static void try_pair(const search *s, half_space *best, const double *p, const double *q)
{
    fan f;
    double normal[3];
    if (!fan_about(p, q, &f)) {
        return;
    }
    least_about_line(&f, normal);
    consider(s, best, normal, p);
    for (int corner = 0; corner < 8; corner++) {
        const double vertex[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
        normal_through(p, q, vertex, normal);
        consider(s, best, normal, p);
    }
}

/* Tries the planes through a first point, a second one of at most SECONDS later points, and a third one that is later
   still. The block to which the first point itself belongs also tries the planes through this point alone. */
static koksma_status try_block(void *context, size_t block)
{
    search *s = context;
    half_space best = {.value = -1};
    const size_t i = block / s->parts, part = block % s->parts, from = part * SECONDS;
    const size_t end = from + SECONDS < s->n ? from + SECONDS : s->n;
    s->best[block] = best;
    if (end <= i) {
        return KOKSMA_OK;
    }
    if (block > 0 && (atomic_load(&s->late) || koksma__now_s() > s->deadline_s)) {
        atomic_store(&s->late, true);
        return KOKSMA_OK;
    }
    const double *p = s->points + 3 * i;
    if (from <= i) {
        try_point(s, &best, p);
    }
    for (size_t j = from <= i ? i + 1 : from; j < end; j++) {
        const double *q = s->points + 3 * j;
        try_pair(s, &best, p, q);
        for (size_t k = j + 1; k < s->n; k++) {
            double normal[3];
            normal_through(p, q, s->points + 3 * k, normal);
            consider(s, &best, normal, p);
        }
    }
    s->best[block] = best;
    return KOKSMA_OK;
}

static void finish(const search *s, koksma_value *out)
{
    half_space best = {.value = -1};
    for (size_t b = 0; b < s->n * s->parts; b++) {
        best = s->best[b].value > best.value ? s->best[b] : best;
    }
    koksma_witness w = {.kind = KOKSMA_WITNESS_HALF_PLANE,
                        .dim = 3,
                        .closed = true,
                        .volume = best.volume,
                        .lo = {best.a[0], best.a[1], best.a[2]},
                        .hi = {-HUGE_VAL}};
    for (size_t i = 0; i < s->n; i++) {
        const double here = project(best.a, s->points + 3 * i);
        if (here <= best.c + on_plane) {
            w.hi[0] = fmax(w.hi[0], here);
            w.count++;
        }
    }
    const bool late = atomic_load(&s->late);
    out->value = out->lower = best.value;
    out->upper = late ? 1 : best.value; /* some planes were not tried, so the upper bound is 1 */
    out->exact = !late;
    out->witness = w;
}

koksma_status koksma__edge_space(const koksma_points *points, const koksma_run *run, koksma_value *out)
{
    const size_t n = points->n;
    KOKSMA__FAIL_IF(n > MAX_N, KOKSMA_N, "edge: n = %zu: it takes up to %d points in 3D; l2-edge takes more", n,
                    MAX_N);
    search s = {.n = n,
                .points = points->xs,
                .parts = (n + SECONDS - 1) / SECONDS,
                .deadline_s = koksma__deadline_s(run, 0.95)};
    const size_t blocks = n * s.parts, bytes = blocks * sizeof *s.best + 3 * n * sizeof(double);
    s.best = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(s.best, bytes);
    for (size_t k = 0; k < 3; k++) {
        s.coordinates[k] = (double *)(s.best + blocks) + k * n;
        for (size_t i = 0; i < n; i++) {
            s.coordinates[k][i] = points->xs[3 * i + k];
        }
    }
    const koksma_status status = koksma__parallel(run, blocks, try_block, &s);
    if (!status) {
        finish(&s, out);
    }
    free(s.best);
    return status;
}
