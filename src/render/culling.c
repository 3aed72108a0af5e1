/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds the shapes that rays through a part of the film can hit. A ray from the eye o through film position (x, y)
 * goes along d = base + x step_x + y step_y. A flat shape has the centre c, the normal n, the axes u and v, and the
 * half side h along u; any other shape lies in the sphere of centre c and radius r. Then
 *
 *   flat shape:  with e = o - c, s = -sign(n.e), N = s n.d: the ray meets the shape's plane in front of the eye where
 *                N > 0, at u = e.u + |n.e| d.u / N; u > h there if and only if (e.u - h) N + |n.e| d.u > 0, and
 *                likewise for -u, v and -v. N and these four expressions are linear in (x, y). No ray through a
 *                rectangle of the film hits the shape if N <= 0 in the whole rectangle, or if one of the four
 *                expressions is > 0 in the whole rectangle.
 *   other shapes: the line through the eye misses the sphere around the shape if and only if
 *                |e x d|^2 - r^2 d.d > 0, a quadratic form in (x, y), bounded from below by its value, slopes and
 *                curvatures at the middle.
 *
 * Bounds are in double precision, but batch_shapes.c computes hits in floats. Shapes are therefore enlarged by more
 * than the rounding errors of these hits: a position at distance R from the eye has an error of about 10 units in the
 * last place of R across the ray, and along a flat shape that error divided by the sine |n.e| / R. The
 * rectangle on the film is enlarged by as much as rounding d to floats can move a ray there.
 *
 * Shadow rays, at the end: those from a part F of a surface to a light L lie in the convex hull of both. A shape in a
 * sphere of centre c and radius r blocks none of them if a plane separates the hull from the sphere:
 *
 *     a.(x - c) > r for all corners x of F and L, for some unit vector a.
 *
 * The only vector a that is tried points from the centre c to the nearest point of the line from the middle of F to
 * the middle of L.
 *
 * batch_shapes.c computes in floats, so r is increased by 2^-9 R, where R is the largest coordinate. The test of a
 * sphere compares squares that are off by about 10 units in the last place, 10 2^-24 R^2; the margin changes them by
 * more than 2^-18 R^2. A hit position has an error of 10 2^-24 R divided by the sine of the angle between ray and
 * surface, which GRAZING bounds.
 */
#include "render/culling.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"
#include "core/vector.h"

#define UNIT 0x1p-24 /* relative rounding error of a float */
#define SPARE 64     /* number of rounding errors of size UNIT that the margins allow for */
/* smallest sine of the angle between a plane and the rays for which a footprint on the plane is computed */
#define GRAZING 0x1p-7

/* a + x b + y c */
typedef struct linear {
    double a, b, c;
} linear;

typedef struct bound {
    bool is_sphere, sees_all; /* sees_all: no bound is known, so that the shape is never culled */
    size_t n;                 /* number of entries in `out`; a ray misses the shape where one of them is > 0 */
    linear out[5];
    double a, b, c, aa, ab, bb; /* for a sphere: rays miss it where a + b x + c y + aa x^2 + ab x y + bb y^2 > 0 */
    /* for a flat shape: N as defined at the top of this file, and the distance of the eye from the shape's plane */
    linear towards;
    double height;
    double centre[3], radius; /* radius of a sphere around the shape */
} bound;

struct koksma__frustum_cull {
    koksma__batch_camera camera;
    double longest; /* upper bound of the length of a direction d */
    double widen;   /* margin added to the film's rectangles */
    size_t n;
    bound bounds[];
};

static double dot(const float a[3], const double b[3])
{
    return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

static linear along(const koksma__batch_camera *c, const double w[3])
{
    return (linear){dot(c->base, w), dot(c->step_x, w), dot(c->step_y, w)};
}

static linear combine(double p, linear l, double q, linear m)
{
    return (linear){p * l.a + q * m.a, p * l.b + q * m.b, p * l.c + q * m.c};
}

static double length1(const float a[3])
{
    return fabs((double)a[0]) + fabs((double)a[1]) + fabs((double)a[2]);
}

static bound bound_flat(const koksma__batch_camera *camera, const koksma__batch_shape *s, double longest)
{
    bound b = {.n = 1};
    double e[3], n[3], u[3], v[3], distance = 0;
    for (int k = 0; k < 3; k++) {
        e[k] = (double)camera->eye[k] - (double)s->centre[k];
        n[k] = (double)s->normal[k];
        u[k] = (double)s->axis_u[k];
        v[k] = (double)s->axis_v[k];
        distance += fabs(e[k]);
    }
    const double height = n[0] * e[0] + n[1] * e[1] + n[2] * e[2], size = fabs(height);
    const double magnitude = distance + length1(s->centre) + length1(camera->eye);
    const linear towards = combine(height > 0 ? -1 : 1, along(camera, n), 0, (linear){0, 0, 0});
    b.sees_all = !(size > SPARE * UNIT * magnitude);
    b.towards = towards;
    b.height = size;
    b.out[0] = combine(-1, towards, 0, towards);
    b.out[0].a -= SPARE * UNIT * longest;
    const double half_u = (double)s->half_u, half_v = (double)s->half_v;
    if (!(half_u < (double)INFINITY)) {
        return b;
    }
    const double reach = magnitude + half_u + half_v, spare = SPARE * UNIT * (reach + reach * (reach / size));
    const double e_u = e[0] * u[0] + e[1] * u[1] + e[2] * u[2], e_v = e[0] * v[0] + e[1] * v[1] + e[2] * v[2];
    const linear d_u = along(camera, u), d_v = along(camera, v);
    b.out[b.n++] = combine(e_u - (half_u + spare), towards, size, d_u);
    b.out[b.n++] = combine(-e_u - (half_u + spare), towards, -size, d_u);
    b.out[b.n++] = combine(e_v - (half_v + spare), towards, size, d_v);
    b.out[b.n++] = combine(-e_v - (half_v + spare), towards, -size, d_v);
    return b;
}

static void cross(const double e[3], const float d[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        out[k] = e[l] * (double)d[m] - e[m] * (double)d[l];
    }
}

/* (e x a).(e x b) - r^2 a.b */
static double form(const double e[3], double radius2, const float a[3], const float b[3])
{
    double ea[3], eb[3], sum = 0;
    cross(e, a, ea);
    cross(e, b, eb);
    for (int k = 0; k < 3; k++) {
        sum += ea[k] * eb[k] - radius2 * (double)a[k] * (double)b[k];
    }
    return sum;
}

static bound bound_sphere(const koksma__batch_camera *camera, const koksma__batch_shape *s)
{
    double e[3], magnitude = 0;
    for (int k = 0; k < 3; k++) {
        e[k] = (double)camera->eye[k] - (double)s->centre[k];
        magnitude += fabs((double)camera->eye[k]) + fabs((double)s->centre[k]);
    }
    const double radius = sqrt((double)s->radius2), wide = radius + SPARE * UNIT * (magnitude + radius);
    const float *base = camera->base, *x = camera->step_x, *y = camera->step_y;
    return (bound){.is_sphere = true,
                   .sees_all = s->moves,
                   .a = form(e, wide * wide, base, base),
                   .b = 2 * form(e, wide * wide, base, x),
                   .c = 2 * form(e, wide * wide, base, y),
                   .aa = form(e, wide * wide, x, x),
                   .ab = 2 * form(e, wide * wide, x, y),
                   .bb = form(e, wide * wide, y, y)};
}

koksma_status koksma__frustum_cull_open(const koksma__batch_camera *camera, const koksma__batch_shapes *shapes,
                                        int width, int height, koksma__frustum_cull **out)
{
    const size_t size = sizeof(koksma__frustum_cull) + shapes->n * sizeof(bound);
    koksma__frustum_cull *cull = *out = malloc(size);
    KOKSMA__REQUIRE_MEMORY(cull, size);
    const double x = length1(camera->step_x), y = length1(camera->step_y);
    const double longest = length1(camera->base) + (width + 2) * x + (height + 2) * y;
    cull->n = shapes->n;
    cull->camera = *camera;
    cull->longest = longest;
    cull->widen = 0x1p-10 + SPARE * UNIT * longest / (x < y ? x : y);
    for (size_t i = 0; i < shapes->n; i++) {
        const koksma__batch_shape *s = &shapes->shapes[i];
        cull->bounds[i] = s->is_flat ? bound_flat(camera, s, longest) : bound_sphere(camera, s);
        for (int k = 0; k < 3; k++) {
            cull->bounds[i].centre[k] = (double)s->centre[k];
        }
        cull->bounds[i].radius = sqrt((double)s->radius2);
    }
    return KOKSMA_OK;
}

void koksma__frustum_cull_close(koksma__frustum_cull *cull)
{
    free(cull);
}

/* A rectangle of the film: its middle and half sides. */
typedef struct part {
    double x, y, half_x, half_y;
} part;

static bool is_out(const bound *b, part p)
{
    if (b->is_sphere) {
        const double value = b->a + p.x * (b->b + b->aa * p.x + b->ab * p.y) + p.y * (b->c + b->bb * p.y);
        const double slope_x = b->b + 2 * b->aa * p.x + b->ab * p.y, slope_y = b->c + 2 * b->bb * p.y + b->ab * p.x;
        const double spread = fabs(slope_x) * p.half_x + fabs(slope_y) * p.half_y +
                              fabs(b->aa) * p.half_x * p.half_x + fabs(b->ab) * p.half_x * p.half_y +
                              fabs(b->bb) * p.half_y * p.half_y;
        const double scale = fabs(b->a) + fabs(b->b * p.x) + fabs(b->c * p.y);
        return value - spread > 0x1p-40 * scale;
    }
    for (size_t i = 0; i < b->n; i++) {
        const linear l = b->out[i];
        if (l.a + p.x * l.b + p.y * l.c - fabs(l.b) * p.half_x - fabs(l.c) * p.half_y > 0) {
            return true;
        }
    }
    return false;
}

size_t koksma__frustum_cull_shapes(const koksma__frustum_cull *cull, const double x[2], const double y[2],
                                   size_t *seen)
{
    const part p = {(x[0] + x[1]) / 2, (y[0] + y[1]) / 2, (x[1] - x[0]) / 2 + cull->widen,
                    (y[1] - y[0]) / 2 + cull->widen};
    size_t n = 0;
    for (size_t i = 0; i < cull->n; i++) {
        if (cull->bounds[i].sees_all || !is_out(&cull->bounds[i], p)) {
            seen[n++] = i;
        }
    }
    return n;
}

bool koksma__frustum_cull_footprint(const koksma__frustum_cull *cull, size_t i, const double x[2], const double y[2],
                                    koksma__footprint *out)
{
    const bound *b = &cull->bounds[i];
    const koksma__batch_camera *c = &cull->camera;
    *out = (koksma__footprint){.n = 1, .radius = b->radius};
    if (b->is_sphere) {
        memcpy(out->at[0], b->centre, sizeof b->centre);
        return !b->sees_all;
    }
    bool all = !b->sees_all;
    *out = (koksma__footprint){.n = 4};
    for (int corner = 0; corner < 4; corner++) {
        const double px = corner & 1 ? x[1] + cull->widen : x[0] - cull->widen;
        const double py = corner & 2 ? y[1] + cull->widen : y[0] - cull->widen;
        const double towards = b->towards.a + px * b->towards.b + py * b->towards.c;
        all &= towards > GRAZING * cull->longest;
        for (int k = 0; k < 3; k++) {
            const double d = (double)c->base[k] + px * (double)c->step_x[k] + py * (double)c->step_y[k];
            out->at[corner][k] = (double)c->eye[k] + b->height / towards * d;
        }
    }
    return all;
}

/* ---- Shadow rays ------------------------------------------------------------------------------------------------ */

#define MARGIN 0x1p-9

/* The corners of the light, and its middle. */
static void corners_of(const koksma__batch_light *l, double corners[4][3], double middle[3])
{
    for (int k = 0; k < 3; k++) {
        const double x = (double)l->edge_x[k], y = (double)l->edge_y[k], c = (double)l->corner[k];
        const double at[4] = {c, c + x, c + y, c + x + y};
        for (int i = 0; i < 4; i++) {
            corners[i][k] = at[i];
        }
        middle[k] = c + (x + y) / 2;
    }
}

/* The vector from c to the nearest point of the line through f and g. */
static void nearest(const double f[3], const double g[3], const double c[3], double to[3])
{
    double along[3], from[3];
    for (int k = 0; k < 3; k++) {
        along[k] = g[k] - f[k];
        from[k] = f[k] - c[k];
    }
    const double t = -koksma__dot(from, along) / koksma__dot(along, along), in = t > 0 ? t < 1 ? t : 1 : 0;
    for (int k = 0; k < 3; k++) {
        to[k] = from[k] + in * along[k];
    }
}

/* The smallest a.(x - c) over n points x; *size is raised to the largest sum of the absolute coordinates of a
   point. */
static double least(const double (*at)[3], int n, const double a[3], const double c[3], double *size)
{
    double low = (double)INFINITY;
    for (int i = 0; i < n; i++) {
        const double x[3] = {at[i][0] - c[0], at[i][1] - c[1], at[i][2] - c[2]};
        low = fmin(low, koksma__dot(a, x));
        *size = fmax(*size, fabs(at[i][0]) + fabs(at[i][1]) + fabs(at[i][2]));
    }
    return low;
}

bool koksma__shadow_cull_clear(const koksma__footprint *from, const koksma__batch_light *light,
                               const koksma__batch_shape *shape)
{
    const double c[3] = {(double)shape->centre[0], (double)shape->centre[1], (double)shape->centre[2]};
    const double radius =
        shape->is_flat ? koksma__hypot((double)shape->half_u, (double)shape->half_v) : sqrt((double)shape->radius2);
    double corners[4][3], g[3], f[3] = {0, 0, 0}, a[3], size = fabs(c[0]) + fabs(c[1]) + fabs(c[2]) + radius;
    corners_of(light, corners, g);
    for (int i = 0; i < from->n; i++) {
        for (int k = 0; k < 3; k++) {
            f[k] += from->at[i][k] / from->n;
        }
    }
    nearest(f, g, c, a);
    const double lit = least((const double(*)[3])corners, 4, a, c, &size);
    const double seen = least(from->at, from->n, a, c, &size), length = sqrt(koksma__dot(a, a));
    const double reach = radius + MARGIN * (size + from->radius);
    return !shape->moves && !shape->turns && lit > reach * length && seen > (reach + from->radius) * length;
}
