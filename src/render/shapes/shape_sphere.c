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

/* The vector from the centre at this time to p. */
INLINE koksma__v3 from_centre(const koksma__batch_shape *s, koksma__v3 p, float time, bool moves)
{
    const koksma__v3 c = koksma__v3_of(s->centre), way = koksma__v3_scale(koksma__v3_of(s->motion), time);
    return koksma__v3_subtract(p, moves ? koksma__v3_add(c, way) : c);
}

INLINE void hit_sphere(const koksma__batch_shape *shape, const koksma__rays *restrict r, const int32_t *restrict from,
                       int n, koksma__hits *restrict h, bool moves)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const float radius2 = s->radius2;
    const int32_t id = s->id;
    for (int i = 0; i < STEP(n); i++) {
        const koksma__v3 e = from_centre(s, AT(r->o, i), moves ? r->time[i] : 0, moves), d = AT(r->d, i);
        const float a = koksma__v3_dot(d, d), inverse = 1 / a, middle = -koksma__v3_dot(e, d) * inverse;
        /* the vector from the centre to the line's nearest point is used, which avoids cancellation of large
           squares */
        const koksma__v3 q = koksma__v3_add(e, koksma__v3_scale(d, middle));
        const float rest = radius2 - koksma__v3_dot(q, q), reach = sqrtf((rest > 0 ? rest : 0) * inverse);
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
INLINE void finish_sphere(const koksma__batch_shape *shape, const koksma__rays *restrict r, int n,
                          koksma__hits *restrict h, bool all, bool moves)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const int32_t id = s->id, material = s->material;
    const float scale = s->inverse_radius;
    for (int i = 0; i < STEP(n); i++) {
        const int hit = all | (h->primitive[i] == id);
        const koksma__v3 d = AT(r->d, i), p = koksma__v3_add(AT(r->o, i), koksma__v3_scale(d, h->t[i]));
        const koksma__v3 q = koksma__v3_scale(from_centre(s, p, moves ? r->time[i] : 0, moves), scale);
        koksma__put_hit(h, i, hit, p, q, koksma__v3_dot(q, d) > 0 ? -1.0f : 1.0f, 0, 0, material);
    }
}

/* Blocks the shadow rays for which |e + t d|^2 = r^2 has a root in (0, end). Multiplied by a = d.d the equation is (a
   t + b)^2 = D with b = e.d and, by Lagrange's identity, D = a r^2 - |e x d|^2: this avoids a difference of large
   squares, so that small spheres far away keep their shadows. An end of the ray is inside the sphere if (a t + b)^2 <
   D; if both ends are outside, the line must cross the sphere between them. For a ray that starts on the sphere, D is
   exactly b^2. */
INLINE void shade_sphere(const koksma__batch_shape *shape, const koksma__hits *restrict h, const int32_t *aimed,
                         int n, koksma__shadows *restrict r, bool moves)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const float radius2 = s->radius2;
    const int32_t id = s->id;
    for (int i = 0; i < STEP(n); i++) {
        const koksma__v3 e = from_centre(s, AT(h->p, i), moves ? h->time[i] : 0, moves), d = AT(r->d, i);
        const koksma__v3 x = koksma__v3_cross(e, d);
        const float a = koksma__v3_dot(d, d), b = koksma__v3_dot(e, d);
        const float start = b * b, last = a * KOKSMA__SHADOW_END + b, end = last * last;
        const float away = h->primitive[i] != id ? 1.0f : 0.0f;
        const float reach = away * (a * radius2 - koksma__v3_dot(x, x)) + (1 - away) * start;
        const int enters = (start > reach) & (end < reach);
        const int crosses = (start >= reach) & (end >= reach) & (b < 0) & (last > 0) & (reach > 0);
        const int leaves = (start < reach) & (end > reach);
        r->light[i] *= (aimed[i] != id) & (enters | crosses | leaves) ? 0.0f : 1.0f;
    }
}

/* Blocks shadow rays like shade_sphere, for a sphere at rest on which all rays start: the rays that go inwards are
   blocked. */
static void shade_own(const koksma__batch_shape *s, const koksma__hits *restrict h, const int32_t *aimed, int n,
                      koksma__shadows *restrict r)
{
    const koksma__v3 c = koksma__v3_of(s->centre);
    const int32_t id = s->id;
    for (int i = 0; i < STEP(n); i++) {
        const koksma__v3 e = koksma__v3_subtract(AT(h->p, i), c), d = AT(r->d, i);
        const float a = koksma__v3_dot(d, d), b = koksma__v3_dot(e, d);
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
