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

#include "render/batch.h"
#include "scene/scene.h"

#define KERNEL(result, name, arguments) result BATCH_NAME(name) arguments;
#include "render/batch.def"
#undef KERNEL

#define STEP(n) ((n) & ~(KOKSMA__LANE_STEP - 1)) /* tells the compiler that there is no remainder */

/* A shadow ray ends this much short of the luminaire. */
#define SHADOW_END (1 - 0x1p-16f)

static void hit_flat(const koksma__batch_shape *s, int32_t id, const koksma__rays *restrict r, int n,
                     koksma__hits *restrict h)
{
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2];
    const float nx = s->normal[0], ny = s->normal[1], nz = s->normal[2];
    const float ux = s->axis_u[0], uy = s->axis_u[1], uz = s->axis_u[2];
    const float vx = s->axis_v[0], vy = s->axis_v[1], vz = s->axis_v[2];
    const float half_u = s->half_u, half_v = s->half_v, radius2 = s->radius2;
    for (int i = 0; i < STEP(n); i++) {
        const float ex = r->ox[i] - cx, ey = r->oy[i] - cy, ez = r->oz[i] - cz;
        const float dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float t = -(nx * ex + ny * ey + nz * ez) / (nx * dx + ny * dy + nz * dz);
        const float qx = ex + t * dx, qy = ey + t * dy, qz = ez + t * dz;
        const float u = qx * ux + qy * uy + qz * uz, v = qx * vx + qy * vy + qz * vz;
        const int hit =
            (t > 0) & (t < h->t[i]) & (fabsf(u) <= half_u) & (fabsf(v) <= half_v) & (u * u + v * v <= radius2);
        h->t[i] = hit ? t : h->t[i];
        h->primitive[i] = hit ? id : h->primitive[i];
    }
}

static void hit_sphere(const koksma__batch_shape *s, int32_t id, const koksma__rays *restrict r, int n,
                       koksma__hits *restrict h)
{
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2], radius2 = s->radius2;
    for (int i = 0; i < STEP(n); i++) {
        const float ex = r->ox[i] - cx, ey = r->oy[i] - cy, ez = r->oz[i] - cz;
        const float dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float a = dx * dx + dy * dy + dz * dz, b = ex * dx + ey * dy + ez * dz;
        const float inverse = 1 / a, middle = -b * inverse;
        /* The distance of the line from the centre, from its nearest point: no cancellation of large squares. */
        const float qx = ex + middle * dx, qy = ey + middle * dy, qz = ez + middle * dz;
        const float rest = radius2 - (qx * qx + qy * qy + qz * qz);
        const float reach = sqrtf((rest > 0 ? rest : 0) * inverse);
        const float near = middle - reach, far = middle + reach;
        const float t = near > 0 ? near : far;
        const int hit = (rest > 0) & (t > 0) & (t < h->t[i]);
        h->t[i] = hit ? t : h->t[i];
        h->primitive[i] = hit ? id : h->primitive[i];
    }
}

/* Place, normal and coordinates of the lanes that hit flat shape s. */
static void finish_flat(const koksma__batch_shape *s, int32_t id, const koksma__rays *restrict r, int n,
                        koksma__hits *restrict h)
{
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2];
    const float nx = s->normal[0], ny = s->normal[1], nz = s->normal[2];
    const float ux = s->axis_u[0], uy = s->axis_u[1], uz = s->axis_u[2];
    const float vx = s->axis_v[0], vy = s->axis_v[1], vz = s->axis_v[2];
    const int32_t material = s->material;
    for (int i = 0; i < STEP(n); i++) {
        const int hit = h->primitive[i] == id;
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
        h->material[i] = hit ? material : h->material[i];
    }
}

static void finish_sphere(const koksma__batch_shape *s, int32_t id, const koksma__rays *restrict r, int n,
                          koksma__hits *restrict h)
{
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2], scale = s->inverse_radius;
    const int32_t material = s->material;
    for (int i = 0; i < STEP(n); i++) {
        const int hit = h->primitive[i] == id;
        const float t = h->t[i], dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float px = r->ox[i] + t * dx, py = r->oy[i] + t * dy, pz = r->oz[i] + t * dz;
        const float qx = (px - cx) * scale, qy = (py - cy) * scale, qz = (pz - cz) * scale;
        const float side = qx * dx + qy * dy + qz * dz > 0 ? -1.0f : 1.0f;
        h->px[i] = hit ? px : h->px[i];
        h->py[i] = hit ? py : h->py[i];
        h->pz[i] = hit ? pz : h->pz[i];
        h->nx[i] = hit ? side * qx : h->nx[i];
        h->ny[i] = hit ? side * qy : h->ny[i];
        h->nz[i] = hit ? side * qz : h->nz[i];
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

int BATCH_NAME(closest)(const koksma__batch_shapes *shapes, const koksma__rays *rays, int n, koksma__hits *hits)
{
    for (int i = 0; i < STEP(n); i++) {
        hits->t[i] = INFINITY;
        hits->primitive[i] = hits->material[i] = -1;
        hits->px[i] = hits->py[i] = hits->pz[i] = 0;
        hits->nx[i] = hits->ny[i] = hits->nz[i] = 0;
        hits->u[i] = hits->v[i] = 0;
    }
    for (size_t k = 0; k < shapes->n; k++) {
        const koksma__batch_shape *s = &shapes->shapes[k];
        (s->kind == KOKSMA__SHAPE_SPHERE ? hit_sphere : hit_flat)(s, (int32_t)k, rays, n, hits);
    }
    int missed = count_hits(hits, -1, n);
    const int hit = STEP(n) - missed;
    for (size_t k = 0; k < shapes->n && missed < STEP(n); k++) {
        const koksma__batch_shape *s = &shapes->shapes[k];
        const int count = count_hits(hits, (int32_t)k, n);
        if (count) {
            (s->kind == KOKSMA__SHAPE_SPHERE ? finish_sphere : finish_flat)(s, (int32_t)k, rays, n, hits);
        }
        missed += count;
    }
    return hit;
}

static void shade_flat(const koksma__batch_shape *s, int32_t id, const koksma__hits *restrict h, int n,
                       koksma__shadows *restrict r)
{
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2];
    const float nx = s->normal[0], ny = s->normal[1], nz = s->normal[2];
    const float ux = s->axis_u[0], uy = s->axis_u[1], uz = s->axis_u[2];
    const float vx = s->axis_v[0], vy = s->axis_v[1], vz = s->axis_v[2];
    const float half_u = s->half_u, half_v = s->half_v, radius2 = s->radius2;
    for (int i = 0; i < STEP(n); i++) {
        const float ex = h->px[i] - cx, ey = h->py[i] - cy, ez = h->pz[i] - cz;
        const float dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float t = -(nx * ex + ny * ey + nz * ez) / (nx * dx + ny * dy + nz * dz);
        const float qx = ex + t * dx, qy = ey + t * dy, qz = ez + t * dz;
        const float u = qx * ux + qy * uy + qz * uz, v = qx * vx + qy * vy + qz * vz;
        const int hit = (h->primitive[i] != id) & (t > 0) & (t < SHADOW_END) & (fabsf(u) <= half_u) &
                        (fabsf(v) <= half_v) & (u * u + v * v <= radius2);
        r->light[i] *= hit ? 0.0f : 1.0f;
    }
}

static void shade_sphere(const koksma__batch_shape *s, int32_t id, const koksma__hits *restrict h, int n,
                         koksma__shadows *restrict r)
{
    const float cx = s->centre[0], cy = s->centre[1], cz = s->centre[2], radius2 = s->radius2;
    for (int i = 0; i < STEP(n); i++) {
        const float ex = h->px[i] - cx, ey = h->py[i] - cy, ez = h->pz[i] - cz;
        const float dx = r->dx[i], dy = r->dy[i], dz = r->dz[i];
        const float a = dx * dx + dy * dy + dz * dz, b = ex * dx + ey * dy + ez * dz;
        const float away = h->primitive[i] != id ? 1.0f : 0.0f;
        const float c = away * (ex * ex + ey * ey + ez * ez - radius2);
        /* Has f(t) = a t^2 + 2 b t + c a root in (0, end)? By signs, without dividing: f(0) = c and f(end) tell which
           ends are inside; with both outside the vertex must lie between them and below 0. */
        const float at_end = (a * SHADOW_END + 2 * b) * SHADOW_END + c;
        const int enters = (c > 0) & (at_end < 0);
        const int crosses = (c >= 0) & (at_end >= 0) & (b < 0) & (-b < a * SHADOW_END) & (b * b > a * c);
        const int leaves = (c < 0) & (at_end > 0);
        r->light[i] *= enters | crosses | leaves ? 0.0f : 1.0f;
    }
}

void BATCH_NAME(occlude)(const koksma__batch_shapes *shapes, const koksma__hits *hits, int n,
                         koksma__shadows *shadows)
{
    for (size_t k = 0; k < shapes->n; k++) {
        const koksma__batch_shape *s = &shapes->shapes[k];
        (s->kind == KOKSMA__SHAPE_SPHERE ? shade_sphere : shade_flat)(s, (int32_t)k, hits, n, shadows);
    }
}
