/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Analytic shapes against a block of rays.
 *
 *   flat:    t = n.(c - o) / n.d, then the place must lie within the bounds in (u, v)
 *   sphere:  |o + t d - c|^2 = r^2, with e = o - c:  d.d t^2 + 2 e.d t + (e.e - r^2) = 0
 *
 * A ray that starts on a shape (a shadow ray) meets that shape at t = 0 and has no epsilon: a flat shape never shades
 * its own points, and for a sphere the constant term is set to exactly 0, which leaves the far root, that is > 0 only
 * when the ray starts inwards.
 */
#include <math.h>

#include "render/pipelines/batch_kernel.h"
#include "render/scene.h"

typedef enum bounds { ENDLESS, IN_RECTANGLE, IN_DISK } bounds;

/* A shadow ray ends this much short of the luminaire. */
#define SHADOW_END (1 - 0x1p-16f)

INLINE int within(const koksma__batch_shape *s, float u, float v, bounds b)
{
    return b == ENDLESS        ? 1
           : b == IN_RECTANGLE ? (fabsf(u) <= s->half_u) & (fabsf(v) <= s->half_v)
                               : u * u + v * v <= s->radius2;
}

INLINE void hit_flat_in(const koksma__batch_shape *shape, const koksma__rays *restrict r,
                        const int32_t *restrict from, int n, koksma__hits *restrict h, bounds b)
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
        const int away = from ? from[i] != id : 1;
        const int hit = away & (t > 0) & (t < h->t[i]) & within(s, u, v, b);
        h->t[i] = hit ? t : h->t[i];
        h->primitive[i] = hit ? id : h->primitive[i];
    }
}

/* Where the centre is at time[i]. */
#define AT(k, c, time) (moves ? c + (time)*s->motion[k] : c)

INLINE void hit_sphere(const koksma__batch_shape *shape, const koksma__rays *restrict r, const int32_t *restrict from,
                       int n, koksma__hits *restrict h, bool moves)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2], radius2 = s->radius2;
    const int32_t id = s->id;
    for (int i = 0; i < STEP(n); i++) {
        const float ex = r->ox[i] - AT(0, cx, r->time[i]), ey = r->oy[i] - AT(1, cy, r->time[i]),
                    ez = r->oz[i] - AT(2, cz, r->time[i]);
        const float dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float a = dx * dx + dy * dy + dz * dz, b = ex * dx + ey * dy + ez * dz;
        const float inverse = 1 / a, middle = -b * inverse;
        /* The distance of the line from the centre, from its nearest point: no cancellation of large squares. */
        const float qx = ex + middle * dx, qy = ey + middle * dy, qz = ez + middle * dz;
        const float rest = radius2 - (qx * qx + qy * qy + qz * qz);
        const float reach = sqrtf((rest > 0 ? rest : 0) * inverse);
        const float near = middle - reach, far = middle + reach;
        const int away = from ? from[i] != id : 1;
        /* A ray that starts on the sphere has its roots at exactly 0 and 2 middle. */
        const float t = !away ? 2 * middle : near > 0 ? near : far;
        const int hit = (away ? rest > 0 : 1) & (t > 0) & (t < h->t[i]);
        h->t[i] = hit ? t : h->t[i];
        h->primitive[i] = hit ? id : h->primitive[i];
    }
}

/* Place, normal and coordinates of the lanes that hit flat shape s; all: every lane does. */
INLINE void finish_flat(const koksma__batch_shape *s, const koksma__rays *restrict r, int n, koksma__hits *restrict h,
                        bool all)
{
    const int32_t id = s->id;
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2];
    const float nx = s->normal[0], ny = s->normal[1], nz = s->normal[2];
    const float ux = s->axis_u[0], uy = s->axis_u[1], uz = s->axis_u[2];
    const float vx = s->axis_v[0], vy = s->axis_v[1], vz = s->axis_v[2];
    const int32_t material = s->material;
    for (int i = 0; i < STEP(n); i++) {
        const int hit = all | (h->primitive[i] == id);
        const float t = h->t[i], dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float px = r->ox[i] + t * dx, py = r->oy[i] + t * dy, pz = r->oz[i] + t * dz;
        const float qx = px - cx, qy = py - cy, qz = pz - cz;
        const float side = nx * dx + ny * dy + nz * dz > 0 ? -1.0f : 1.0f;
        const float u = qx * ux + qy * uy + qz * uz, v = qx * vx + qy * vy + qz * vz;
        h->px[i] = hit ? px : h->px[i];
        h->py[i] = hit ? py : h->py[i];
        h->pz[i] = hit ? pz : h->pz[i];
        h->nx[i] = hit ? side * nx : h->nx[i];
        h->ny[i] = hit ? side * ny : h->ny[i];
        h->nz[i] = hit ? side * nz : h->nz[i];
        h->u[i] = hit ? u : h->u[i];
        h->v[i] = hit ? v : h->v[i];
        h->back[i] = hit ? side < 0 : h->back[i];
        h->material[i] = hit ? material : h->material[i];
    }
}

INLINE void finish_sphere(const koksma__batch_shape *s, const koksma__rays *restrict r, int n,
                          koksma__hits *restrict h, bool all, bool moves)
{
    const int32_t id = s->id;
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2], scale = s->inverse_radius;
    const int32_t material = s->material;
    for (int i = 0; i < STEP(n); i++) {
        const int hit = all | (h->primitive[i] == id);
        const float t = h->t[i], dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float px = r->ox[i] + t * dx, py = r->oy[i] + t * dy, pz = r->oz[i] + t * dz;
        const float qx = (px - AT(0, cx, r->time[i])) * scale, qy = (py - AT(1, cy, r->time[i])) * scale,
                    qz = (pz - AT(2, cz, r->time[i])) * scale;
        const float side = qx * dx + qy * dy + qz * dz > 0 ? -1.0f : 1.0f;
        h->px[i] = hit ? px : h->px[i];
        h->py[i] = hit ? py : h->py[i];
        h->pz[i] = hit ? pz : h->pz[i];
        h->nx[i] = hit ? side * qx : h->nx[i];
        h->ny[i] = hit ? side * qy : h->ny[i];
        h->nz[i] = hit ? side * qz : h->nz[i];
        h->u[i] = hit ? 0 : h->u[i];
        h->v[i] = hit ? 0 : h->v[i];
        h->back[i] = hit ? side < 0 : h->back[i];
        h->material[i] = hit ? material : h->material[i];
    }
}

static int count_hits(const koksma__hits *h, int32_t id, int n)
{
    int count = 0;
    for (int i = 0; i < STEP(n); i++) {
        count += h->primitive[i] == id;
    }
    return count;
}

INLINE void hit_shape_from(const koksma__batch_shape *s, const koksma__rays *rays, const int32_t *from, int n,
                           koksma__hits *hits)
{
    switch (s->kind) {
    case KOKSMA__SHAPE_SPHERE:
        if (s->moves) {
            hit_sphere(s, rays, from, n, hits, true);
        } else {
            hit_sphere(s, rays, from, n, hits, false);
        }
        return;
    case KOKSMA__SHAPE_RECTANGLE:
        hit_flat_in(s, rays, from, n, hits, IN_RECTANGLE);
        return;
    case KOKSMA__SHAPE_DISK:
        hit_flat_in(s, rays, from, n, hits, IN_DISK);
        return;
    default:
        hit_flat_in(s, rays, from, n, hits, ENDLESS);
    }
}

static void hit_shape(const koksma__batch_shape *s, const koksma__rays *rays, const int32_t *from, int n,
                      koksma__hits *hits)
{
    if (from) {
        hit_shape_from(s, rays, from, n, hits);
    } else {
        hit_shape_from(s, rays, NULL, n, hits);
    }
}

static void finish_shape(const koksma__batch_shape *s, const koksma__rays *rays, int n, koksma__hits *hits, bool all)
{
    if (s->moves) {
        finish_sphere(s, rays, n, hits, false, true);
    } else if (s->kind == KOKSMA__SHAPE_SPHERE && all) {
        finish_sphere(s, rays, n, hits, true, false);
    } else if (s->kind == KOKSMA__SHAPE_SPHERE) {
        finish_sphere(s, rays, n, hits, false, false);
    } else if (all) {
        finish_flat(s, rays, n, hits, true);
    } else {
        finish_flat(s, rays, n, hits, false);
    }
}

static void clear(koksma__hits *hits, int n)
{
    for (int i = 0; i < STEP(n); i++) {
        hits->material[i] = -1;
        hits->back[i] = 0;
        hits->px[i] = hits->py[i] = hits->pz[i] = 0;
        hits->nx[i] = hits->ny[i] = hits->nz[i] = 0;
        hits->u[i] = hits->v[i] = 0;
    }
}

/* Both in one, for a block of rays that start nowhere and can meet nothing else. */
INLINE int only_flat_in(const koksma__batch_shape *shape, const koksma__rays *restrict r, int n,
                        koksma__hits *restrict h, bounds b)
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
        const int hit = (t > 0) & (t < INFINITY) & within(s, u, v, b);
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

static int only_flat(const koksma__batch_shape *s, const koksma__rays *rays, int n, koksma__hits *hits)
{
    return s->kind == KOKSMA__SHAPE_RECTANGLE ? only_flat_in(s, rays, n, hits, IN_RECTANGLE)
           : s->kind == KOKSMA__SHAPE_DISK    ? only_flat_in(s, rays, n, hits, IN_DISK)
                                              : only_flat_in(s, rays, n, hits, ENDLESS);
}

int BATCH_NAME(closest)(const koksma__batch_shapes *shapes, const koksma__rays *rays, const int32_t *from, int n,
                        koksma__hits *hits)
{
    if (shapes->n == 1 && !from && shapes->shapes->kind != KOKSMA__SHAPE_SPHERE) {
        return only_flat(shapes->shapes, rays, n, hits);
    }
    for (int i = 0; i < STEP(n); i++) {
        hits->t[i] = INFINITY;
        hits->primitive[i] = -1;
    }
    for (size_t k = 0; k < shapes->n; k++) {
        hit_shape(&shapes->shapes[k], rays, from, n, hits);
    }
    int done = count_hits(hits, -1, n), count = 0;
    const int hit = STEP(n) - done;
    if (hit < STEP(n)) {
        clear(hits, n);
    }
    for (size_t k = 0; k < shapes->n && done < STEP(n); k++, done += count) {
        count = count_hits(hits, shapes->shapes[k].id, n);
        if (count) {
            finish_shape(&shapes->shapes[k], rays, n, hits, count == STEP(n));
        }
    }
    return hit;
}

/* aimed: NULL, or the luminaire that each ray goes to and that can't stand in its way, as the shape that it starts on
   can't. */
INLINE void shade_flat_in(const koksma__batch_shape *shape, const koksma__hits *restrict h, const int32_t *aimed,
                          int n, koksma__shadows *restrict r, bounds b)
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
        const int other = (h->primitive[i] != id) & (aimed ? aimed[i] != id : 1);
        const int hit = other & (t > 0) & (t < SHADOW_END) & within(s, u, v, b);
        r->light[i] *= hit ? 0.0f : 1.0f;
    }
}

/* Has |e + t d|^2 = r^2 a root in (0, end)? Times a = d.d the equation is (a t + b)^2 = D with b = e.d and, by
   Lagrange's identity, D = a r^2 - |e x d|^2: no difference of large squares, so that small spheres far away keep
   their shadows. An end is inside where (a t + b)^2 < D; with both outside the line must cross the sphere between
   them. On a ray that starts on the sphere D is exactly b^2. */
INLINE void shade_sphere(const koksma__batch_shape *s, const koksma__hits *restrict h, const int32_t *aimed, int n,
                         koksma__shadows *restrict r, bool moves)
{
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2], radius2 = s->radius2;
    const int32_t id = s->id;
    for (int i = 0; i < STEP(n); i++) {
        const float ex = h->px[i] - AT(0, cx, h->time[i]), ey = h->py[i] - AT(1, cy, h->time[i]),
                    ez = h->pz[i] - AT(2, cz, h->time[i]);
        const float dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float a = dx * dx + dy * dy + dz * dz, b = ex * dx + ey * dy + ez * dz;
        const float x = ey * dz - ez * dy, y = ez * dx - ex * dz, z = ex * dy - ey * dx;
        const float start = b * b, last = a * SHADOW_END + b, end = last * last;
        const float away = h->primitive[i] != id ? 1.0f : 0.0f;
        const float reach = away * (a * radius2 - (x * x + y * y + z * z)) + (1 - away) * start;
        const int enters = (start > reach) & (end < reach);
        const int crosses = (start >= reach) & (end >= reach) & (b < 0) & (last > 0) & (reach > 0);
        const int leaves = (start < reach) & (end > reach);
        const int other = aimed ? aimed[i] != id : 1;
        r->light[i] *= other & (enters | crosses | leaves) ? 0.0f : 1.0f;
    }
}

INLINE void shade_shape(const koksma__batch_shape *s, const koksma__hits *hits, const int32_t *aimed, int n,
                        koksma__shadows *shadows)
{
    switch (s->kind) {
    case KOKSMA__SHAPE_SPHERE:
        if (s->moves) {
            shade_sphere(s, hits, aimed, n, shadows, true);
        } else {
            shade_sphere(s, hits, aimed, n, shadows, false);
        }
        return;
    case KOKSMA__SHAPE_RECTANGLE:
        shade_flat_in(s, hits, aimed, n, shadows, IN_RECTANGLE);
        return;
    case KOKSMA__SHAPE_DISK:
        shade_flat_in(s, hits, aimed, n, shadows, IN_DISK);
        return;
    default:
        shade_flat_in(s, hits, aimed, n, shadows, ENDLESS);
    }
}

void BATCH_NAME(occlude)(const koksma__batch_shapes *shapes, const koksma__hits *hits, int n,
                         koksma__shadows *shadows)
{
    for (size_t k = 0; k < shapes->n; k++) {
        const koksma__batch_shape *s = &shapes->shapes[k];
        if (shadows->aimed && s->material < 0) { /* a luminaire's surface */
            shade_shape(s, hits, shadows->aimed, n, shadows);
        } else {
            shade_shape(s, hits, NULL, n, shadows);
        }
    }
}
