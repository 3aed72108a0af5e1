/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The intersection loops of flat shapes: t = n.(c - o) / n.d, then the position must lie within the bounds in (u, v).
 * A kind defines its bounds as a function of (u, v), which the compiler inlines into the kind's copy of each loop:
 * KOKSMA__FLAT_LOOPS.
 *
 * A ray that starts on a flat shape never meets it, without any epsilon.
 */
#ifndef KOKSMA_RENDER_SHAPES_FLAT_LOOPS_H
#define KOKSMA_RENDER_SHAPES_FLAT_LOOPS_H

#include "core/vector.h"
#include "render/pipelines/batch_kernel.h"
#include "render/shapes/shapes.h"

/* The bounds: 1 where (u, v) is on the shape, 0 elsewhere. */
typedef int koksma__within(const koksma__batch_shape *s, float u, float v);

INLINE void koksma__flat_hit(const koksma__batch_shape *shape, const koksma__rays *restrict r,
                             const int32_t *restrict from, int n, koksma__hits *restrict h, koksma__within *within)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const int32_t id = s->id;
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2];
    const float nx = s->normal[0], ny = s->normal[1], nz = s->normal[2];
    const float ux = s->axis_u[0], uy = s->axis_u[1], uz = s->axis_u[2];
    const float vx = s->axis_v[0], vy = s->axis_v[1], vz = s->axis_v[2];
    for (int i = 0; i < STEP(n); i++) {
        const float ex = r->ox[i] - cx, ey = r->oy[i] - cy, ez = r->oz[i] - cz;
        const float dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float t = -(nx * ex + ny * ey + nz * ez) / (nx * dx + ny * dy + nz * dz);
        const float qx = ex + t * dx, qy = ey + t * dy, qz = ez + t * dz;
        const float u = qx * ux + qy * uy + qz * uz, v = qx * vx + qy * vy + qz * vz;
        const int away = from[i] != id;
        const int hit = away & (t > 0) & (t < h->t[i]) & within(s, u, v);
        h->t[i] = hit ? t : h->t[i];
        h->primitive[i] = hit ? id : h->primitive[i];
    }
}

/* The loops `hit` and `finish` combined, for a block of rays that start on no shape and can hit no other shape. */
INLINE int koksma__flat_only(const koksma__batch_shape *shape, const koksma__rays *restrict r, int n,
                             koksma__hits *restrict h, koksma__within *within)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const int32_t id = s->id, material = s->material;
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2];
    const float nx = s->normal[0], ny = s->normal[1], nz = s->normal[2];
    const float ux = s->axis_u[0], uy = s->axis_u[1], uz = s->axis_u[2];
    const float vx = s->axis_v[0], vy = s->axis_v[1], vz = s->axis_v[2];
    int count = 0;
    for (int i = 0; i < STEP(n); i++) {
        const float ox = r->ox[i], oy = r->oy[i], oz = r->oz[i], dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float ex = ox - cx, ey = oy - cy, ez = oz - cz, slope = nx * dx + ny * dy + nz * dz;
        const float t = -(nx * ex + ny * ey + nz * ez) / slope;
        const float tx = t * dx, ty = t * dy, tz = t * dz;
        const float hx = ex + tx, hy = ey + ty, hz = ez + tz, px = ox + tx, py = oy + ty, pz = oz + tz;
        const float u = hx * ux + hy * uy + hz * uz, v = hx * vx + hy * vy + hz * vz;
        const int hit = (t > 0) & (t < INFINITY) & within(s, u, v);
        const float qx = px - cx, qy = py - cy, qz = pz - cz, side = slope > 0 ? -1.0f : 1.0f;
        const float pu = qx * ux + qy * uy + qz * uz, pv = qx * vx + qy * vy + qz * vz;
        h->t[i] = hit ? t : INFINITY;
        h->px[i] = hit ? px : 0;
        h->py[i] = hit ? py : 0;
        h->pz[i] = hit ? pz : 0;
        h->nx[i] = hit ? side * nx : 0;
        h->ny[i] = hit ? side * ny : 0;
        h->nz[i] = hit ? side * nz : 0;
        h->u[i] = hit ? pu : 0;
        h->v[i] = hit ? pv : 0;
        h->back[i] = hit & (slope > 0);
        h->primitive[i] = hit ? id : -1;
        h->material[i] = hit ? material : -1;
        count += hit;
    }
    return count;
}

/* aimed: the shape of the light at which each ray is aimed. Neither that shape nor the shape on which the ray starts
   can block the ray. */
INLINE void koksma__flat_shade(const koksma__batch_shape *shape, const koksma__hits *restrict h, const int32_t *aimed,
                               int n, koksma__shadows *restrict r, koksma__within *within)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const int32_t id = s->id;
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2];
    const float nx = s->normal[0], ny = s->normal[1], nz = s->normal[2];
    const float ux = s->axis_u[0], uy = s->axis_u[1], uz = s->axis_u[2];
    const float vx = s->axis_v[0], vy = s->axis_v[1], vz = s->axis_v[2];
    for (int i = 0; i < STEP(n); i++) {
        const float ex = h->px[i] - cx, ey = h->py[i] - cy, ez = h->pz[i] - cz;
        const float dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float t = -(nx * ex + ny * ey + nz * ez) / (nx * dx + ny * dy + nz * dz);
        const float qx = ex + t * dx, qy = ey + t * dy, qz = ez + t * dz;
        const float u = qx * ux + qy * uy + qz * uz, v = qx * vx + qy * vy + qz * vz;
        const int other = (h->primitive[i] != id) & (aimed[i] != id);
        const int hit = other & (t > 0) & (t < KOKSMA__SHADOW_END) & within(s, u, v);
        r->light[i] *= hit ? 0.0f : 1.0f;
    }
}

/* Defines the loops `hit`, `only` and `shade` of a kind of shape; the function `within` tests its bounds. */
#define KOKSMA__FLAT_LOOPS(within)                                                                                   \
    static void hit(const koksma__batch_shape *s, const koksma__rays *rays, const int32_t *from, int n,              \
                    koksma__hits *hits)                                                                              \
    {                                                                                                                \
        koksma__flat_hit(s, rays, from, n, hits, within);                                                            \
    }                                                                                                                \
    static int only(const koksma__batch_shape *s, const koksma__rays *rays, int n, koksma__hits *hits)               \
    {                                                                                                                \
        return koksma__flat_only(s, rays, n, hits, within);                                                          \
    }                                                                                                                \
    static void shade(const koksma__batch_shape *s, const koksma__hits *hits, const int32_t *aimed, int n,           \
                      koksma__shadows *shadows)                                                                      \
    {                                                                                                                \
        koksma__flat_shade(s, hits, aimed, n, shadows, within);                                                      \
    }

/* Converts p to the shape's coordinates u and v; returns the height above its plane. */
static inline double koksma__flat_coordinates(const koksma__shape *shape, const double p[3], double uv[2])
{
    double q[3];
    koksma__subtract(p, shape->centre, q);
    uv[0] = koksma__dot(q, shape->axis_u);
    uv[1] = koksma__dot(q, shape->axis_v);
    return koksma__dot(q, shape->normal);
}

/* The fields that all flat kinds have. */
#define KOKSMA__SHAPE_CENTRE                                                                                         \
    {                                                                                                                \
        "centre", KOKSMA__POINT, .at = offsetof(koksma__shape, centre)                                               \
    }
#define KOKSMA__SHAPE_NORMAL                                                                                         \
    {                                                                                                                \
        "normal", KOKSMA__DIRECTION, .at = offsetof(koksma__shape, normal)                                           \
    }
#define KOKSMA__FLAT_SHAPE_KEYS ((const char *const[]){"up", "motion", "to", NULL})

#endif
