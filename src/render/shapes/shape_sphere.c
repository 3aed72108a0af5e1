/* SPDX-License-Identifier: Apache-2.0 */
/*
 * sphere: |p - c - t motion|^2 = r^2 at time t. For a ray o + t d with e = o - c: d.d t^2 + 2 e.d t + (e.e - r^2) =
 * 0.
 *
 * A ray that starts on the sphere needs no epsilon: its constant term is set to exactly 0, so that only the far root
 * is left, which is positive only if the ray starts inwards.
 */
#include "core/vector.h"
#include "render/pipelines/batch_kernel.h"
#include "render/shapes/shapes.h"

/* Coordinate k of the centre at this time. */
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
        /* the vector from the centre to the line's nearest point is used, which avoids cancellation of large
           squares */
        const float qx = ex + middle * dx, qy = ey + middle * dy, qz = ez + middle * dz;
        const float rest = radius2 - (qx * qx + qy * qy + qz * qz);
        const float reach = sqrtf((rest > 0 ? rest : 0) * inverse);
        const float near = middle - reach, far = middle + reach;
        const int away = from[i] != id;
        /* a ray that starts on the sphere has its roots at exactly 0 and 2 * middle */
        const float t = !away ? 2 * middle : near > 0 ? near : far;
        const int hit = (away ? rest > 0 : 1) & (t > 0) & (t < h->t[i]);
        h->t[i] = hit ? t : h->t[i];
        h->primitive[i] = hit ? id : h->primitive[i];
    }
}

/* Sets position and normal of the lanes that hit the sphere. all: whether every lane hits it. */
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

/* Blocks the shadow rays for which |e + t d|^2 = r^2 has a root in (0, end). Multiplied by a = d.d the equation is (a
   t + b)^2 = D with b = e.d and, by Lagrange's identity, D = a r^2 - |e x d|^2: this avoids a difference of large
   squares, so that small spheres far away keep their shadows. An end of the ray is inside the sphere if (a t + b)^2 <
   D; if both ends are outside, the line must cross the sphere between them. For a ray that starts on the sphere, D is
   exactly b^2. */
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
        const float start = b * b, last = a * KOKSMA__SHADOW_END + b, end = last * last;
        const float away = h->primitive[i] != id ? 1.0f : 0.0f;
        const float reach = away * (a * radius2 - (x * x + y * y + z * z)) + (1 - away) * start;
        const int enters = (start > reach) & (end < reach);
        const int crosses = (start >= reach) & (end >= reach) & (b < 0) & (last > 0) & (reach > 0);
        const int leaves = (start < reach) & (end > reach);
        const int other = aimed[i] != id;
        r->light[i] *= other & (enters | crosses | leaves) ? 0.0f : 1.0f;
    }
}

/* Blocks shadow rays like shade_sphere, for a sphere at rest on which all rays start: the rays that go inwards are
   blocked. */
static void shade_own(const koksma__batch_shape *s, const koksma__hits *restrict h, const int32_t *aimed, int n,
                      koksma__shadows *restrict r)
{
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2];
    const int32_t id = s->id;
    for (int i = 0; i < STEP(n); i++) {
        const float ex = h->px[i] - cx, ey = h->py[i] - cy, ez = h->pz[i] - cz;
        const float dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float a = dx * dx + dy * dy + dz * dz, b = ex * dx + ey * dy + ez * dz;
        const float start = b * b, last = a * KOKSMA__SHADOW_END + b, end = last * last;
        const int crosses = (end >= start) & (b < 0) & (last > 0) & (start > 0);
        r->light[i] *= (aimed[i] != id) & crosses ? 0.0f : 1.0f;
    }
}

/* The loops are compiled twice, for moving spheres and for others. */
static void hit(const koksma__batch_shape *s, const koksma__rays *rays, const int32_t *from, int n,
                koksma__hits *hits)
{
    if (s->moves) {
        hit_sphere(s, rays, from, n, hits, true);
    } else {
        hit_sphere(s, rays, from, n, hits, false);
    }
}

static void finish(const koksma__batch_shape *s, const koksma__rays *rays, int n, koksma__hits *hits, bool all)
{
    if (s->moves) {
        finish_sphere(s, rays, n, hits, false, true);
    } else if (all) {
        finish_sphere(s, rays, n, hits, true, false);
    } else {
        finish_sphere(s, rays, n, hits, false, false);
    }
}

static void shade(const koksma__batch_shape *s, const koksma__hits *hits, const int32_t *aimed, int n,
                  koksma__shadows *shadows)
{
    if (s->moves) {
        shade_sphere(s, hits, aimed, n, shadows, true);
    } else if (koksma__batch_count_hits(hits, s->id, n) == STEP(n)) {
        shade_own(s, hits, aimed, n, shadows);
    } else {
        shade_sphere(s, hits, aimed, n, shadows, false);
    }
}

static double equation(const koksma__shape *shape, const double p[3], double *beyond)
{
    double q[3];
    koksma__subtract(p, shape->centre, q);
    *beyond = -1;
    return koksma__dot(q, q) - shape->half[0] * shape->half[0];
}

static koksma_status parse(const char *name, const field *f, koksma_scene *scene, koksma__shape *shape)
{
    (void)name, (void)scene;
    return koksma__shape_motion(f, false, shape);
}

static const koksma__parameter parameters[] = {{"radius", KOKSMA__RADIUS, .at = offsetof(koksma__shape, half)},
                                               {"centre", KOKSMA__POINT, .at = offsetof(koksma__shape, centre)},
                                               {"motion", KOKSMA__POINT, true, .at = offsetof(koksma__shape, motion)},
                                               {0}};

const koksma__shape_type KOKSMA__SHAPE(sphere) = {
    .kind = {.name = "sphere", .title = "a sphere", .cite = "-", .parameters = parameters, .keys = KEYS("to")},
    .parse = parse,
    .equation = equation,
    .hit = hit,
    .finish = finish,
    .shade = shade,
};
