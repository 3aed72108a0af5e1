/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Intersects rays with few triangles, computes hit positions on triangles, and offsets the origins of rays that start on
 * triangles. A hit position is
 * computed from the corners, (1 - u - v) a + u b + v c, and not from the ray, so that it is as exact as the corners.
 *
 * The origin of a ray that starts on a triangle is moved along the normal, to the side to which the ray goes, by
 * 2^-20 of the largest coordinate of the triangle. That is 8 to 16 units in the last place of that coordinate, more than
 * the error of a position on the triangle, so the ray hits neither its own triangle nor those that share its edges.
 * (The idea is from Waechter & Binder 2019, but not the size of the offset.)
 */
#include <math.h>

#include "render/pipelines/batch_kernel.h"
#include "render/vector3.h"

#define OFF 0x1p-20f

INLINE float larger(float a, float b)
{
    return a > b ? a : b;
}

/* Computes the unit normal of the triangle in lane i, whose corners are counterclockwise. The edges of the
   triangle are scaled first, because the squared area of a small triangle underflows a float. */
INLINE void normal_of(const koksma__landings *restrict l, int i, float *nx, float *ny, float *nz)
{
    const float ax = l->corners[3][i] - l->corners[0][i], bx = l->corners[6][i] - l->corners[0][i];
    const float ay = l->corners[4][i] - l->corners[1][i], by = l->corners[7][i] - l->corners[1][i];
    const float az = l->corners[5][i] - l->corners[2][i], bz = l->corners[8][i] - l->corners[2][i];
    const float a = larger(larger(fabsf(ax), fabsf(ay)), fabsf(az));
    const float b = larger(larger(fabsf(bx), fabsf(by)), fabsf(bz));
    const float p = 1 / larger(a, 1e-30f), q = 1 / larger(b, 1e-30f);
    const float x = (ay * p) * (bz * q) - (az * p) * (by * q);
    const float y = (az * p) * (bx * q) - (ax * p) * (bz * q);
    const float z = (ax * p) * (by * q) - (ay * p) * (bx * q);
    const float scale = 1 / sqrtf(x * x + y * y + z * z);
    *nx = x * scale;
    *ny = y * scale;
    *nz = z * scale;
}

void BATCH_NAME(land)(const koksma__landings *restrict l, const koksma__rays *restrict r, int n,
                      koksma__hits *restrict h)
{
    for (int i = 0; i < STEP(n); i++) {
        const int hit = l->primitive[i] >= 0;
        const float u = l->u[i], v = l->v[i], w = 1 - u - v;
        const float px = w * l->corners[0][i] + u * l->corners[3][i] + v * l->corners[6][i] + l->shift[0][i];
        const float py = w * l->corners[1][i] + u * l->corners[4][i] + v * l->corners[7][i] + l->shift[1][i];
        const float pz = w * l->corners[2][i] + u * l->corners[5][i] + v * l->corners[8][i] + l->shift[2][i];
        float nx, ny, nz;
        normal_of(l, i, &nx, &ny, &nz);
        const float side = nx * r->dx[i] + ny * r->dy[i] + nz * r->dz[i] > 0 ? -1.0f : 1.0f;
        h->t[i] = hit ? l->t[i] : h->t[i];
        h->px[i] = hit ? px : h->px[i];
        h->py[i] = hit ? py : h->py[i];
        h->pz[i] = hit ? pz : h->pz[i];
        h->nx[i] = hit ? side * nx : h->nx[i];
        h->ny[i] = hit ? side * ny : h->ny[i];
        h->nz[i] = hit ? side * nz : h->nz[i];
        h->u[i] = hit ? 0 : h->u[i];
        h->v[i] = hit ? 0 : h->v[i];
        h->back[i] = hit ? side < 0 : h->back[i];
        h->primitive[i] = hit ? l->primitive[i] : h->primitive[i];
        h->material[i] = hit ? l->material[i] : h->material[i];
    }
}

void BATCH_NAME(step_off)(const koksma__landings *restrict l, const float *restrict dx, const float *restrict dy,
                          const float *restrict dz, int n, float *restrict ox, float *restrict oy, float *restrict oz)
{
    for (int i = 0; i < STEP(n); i++) {
        float nx, ny, nz, largest = 0;
        normal_of(l, i, &nx, &ny, &nz);
        for (int k = 0; k < 9; k++) {
            largest = larger(largest, fabsf(l->corners[k][i]) + fabsf(l->shift[k % 3][i]));
        }
        const float offset = nx * dx[i] + ny * dy[i] + nz * dz[i] < 0 ? -OFF * largest : OFF * largest;
        const int on = l->primitive[i] >= 0;
        ox[i] = on ? ox[i] + offset * nx : ox[i];
        oy[i] = on ? oy[i] + offset * ny : oy[i];
        oz[i] = on ? oz[i] + offset * nz : oz[i];
    }
}

/* ---- Few triangles ---------------------------------------------------------------------------------------------- */

typedef struct meeting {
    float t, u, v;
    int inside;
} meeting;

/* Where the line e + t d, from a face's corner, meets the face's plane, and whether that is within the face. */
INLINE meeting meet(const koksma__batch_face *f, koksma__v3 e, koksma__v3 d)
{
    const float *n = f->normal, *a = f->across[0], *b = f->across[1];
    const float slack = f->slack * (f->size + (fabsf(e.x) + fabsf(e.y) + fabsf(e.z)));
    const float t = -(n[0] * e.x + n[1] * e.y + n[2] * e.z) / (n[0] * d.x + n[1] * d.y + n[2] * d.z);
    const float x = e.x + t * d.x, y = e.y + t * d.y, z = e.z + t * d.z;
    const float u = a[0] * x + a[1] * y + a[2] * z, v = b[0] * x + b[1] * y + b[2] * z;
    return (meeting){t, u, v, (u >= -slack) & (v >= -slack) & (u + v <= 1 + slack)};
}

/* Rays, or shadow rays by their end, and what they meet. */
typedef struct lines {
    const float *x, *y, *z, *dx, *dy, *dz;
} lines;

static void meet_range(const koksma__batch_faces *faces, size_t first, size_t end, const lines *r, int n,
                       koksma__landings *restrict out)
{
    const float *restrict x = r->x, *restrict y = r->y, *restrict z = r->z;
    const float *restrict dx = r->dx, *restrict dy = r->dy, *restrict dz = r->dz;
    float *restrict ts = out->t, *restrict us = out->u, *restrict vs = out->v;
    int32_t *restrict parts = out->primitive;
    uint32_t *restrict triangles = out->triangle;
    for (size_t k = first; k < end; k++) {
        const koksma__batch_face f = faces->faces[k];
        LANES_APART
        for (int i = 0; i < STEP(n); i++) {
            const koksma__v3 e = {x[i] - f.corner[0], y[i] - f.corner[1], z[i] - f.corner[2]};
            const meeting m = meet(&f, e, (koksma__v3){dx[i], dy[i], dz[i]});
            const int hit = m.inside & (m.t > 0) & (m.t < ts[i]);
            ts[i] = hit ? m.t : ts[i];
            us[i] = hit ? m.u : us[i];
            vs[i] = hit ? m.v : vs[i];
            parts[i] = hit ? f.part : parts[i];
            triangles[i] = hit ? f.triangle : triangles[i];
        }
    }
}

static void shade_range(const koksma__batch_faces *faces, size_t first, size_t end, const lines *r, int n,
                        float *restrict light)
{
    const float *restrict x = r->x, *restrict y = r->y, *restrict z = r->z;
    const float *restrict dx = r->dx, *restrict dy = r->dy, *restrict dz = r->dz;
    for (size_t k = first; k < end; k++) {
        const koksma__batch_face f = faces->faces[k];
        LANES_APART
        for (int i = 0; i < STEP(n); i++) {
            const koksma__v3 e = {x[i] - f.corner[0], y[i] - f.corner[1], z[i] - f.corner[2]};
            const meeting m = meet(&f, e, (koksma__v3){dx[i], dy[i], dz[i]});
            const int hit = m.inside & (m.t > 0) & (m.t < KOKSMA__SHADOW_END);
            light[i] *= hit ? 0.0f : 1.0f;
        }
    }
}

static lines pull_lines(const lines *r, const koksma__picks *p, koksma__rays *to)
{
    koksma__batch_pull_whole(r->x, p, to->ox);
    koksma__batch_pull_whole(r->y, p, to->oy);
    koksma__batch_pull_whole(r->z, p, to->oz);
    koksma__batch_pull_whole(r->dx, p, to->dx);
    koksma__batch_pull_whole(r->dy, p, to->dy);
    koksma__batch_pull_whole(r->dz, p, to->dz);
    return (lines){to->ox, to->oy, to->oz, to->dx, to->dy, to->dz};
}

static void meet_bundle(const koksma__batch_faces *faces, const koksma__batch_bundle *b, const koksma__slabs *s,
                        const lines *r, int n, koksma__landings *out)
{
    koksma__picks p;
    koksma__rays some;
    koksma__landings on;
    koksma__near_bundle(b, s, out->t, NULL, n, &p);
    if (p.n > STEP(n) / 2) {
        meet_range(faces, b->first, b->end, r, n, out);
    } else if (p.n) {
        const lines picked = pull_lines(r, &p, &some);
        koksma__batch_pull_whole(out->t, &p, on.t);
        koksma__batch_pull_whole(out->u, &p, on.u);
        koksma__batch_pull_whole(out->v, &p, on.v);
        koksma__batch_pull_whole(out->primitive, &p, on.primitive);
        koksma__batch_pull_whole(out->triangle, &p, on.triangle);
        meet_range(faces, b->first, b->end, &picked, koksma__batch_pulled(&p), &on);
        koksma__batch_push(on.t, &p, out->t);
        koksma__batch_push(on.u, &p, out->u);
        koksma__batch_push(on.v, &p, out->v);
        koksma__batch_push(on.primitive, &p, out->primitive);
        koksma__batch_push(on.triangle, &p, out->triangle);
    }
}

static void shade_bundle(const koksma__batch_faces *faces, const koksma__batch_bundle *b, const koksma__slabs *s,
                         const lines *r, int n, float *light)
{
    KOKSMA__LANES(float, lit);
    koksma__picks p;
    koksma__rays some;
    koksma__near_bundle(b, s, NULL, light, n, &p);
    if (p.n > STEP(n) / 2) {
        shade_range(faces, b->first, b->end, r, n, light);
    } else if (p.n) {
        const lines picked = pull_lines(r, &p, &some);
        koksma__batch_pull_whole(light, &p, lit);
        shade_range(faces, b->first, b->end, &picked, koksma__batch_pulled(&p), lit);
        koksma__batch_push(lit, &p, light);
    }
}

int BATCH_NAME(meet_faces)(const koksma__batch_faces *faces, const float *x, const float *y, const float *z,
                           const koksma__rays *rays, const koksma__hits *h, int n, koksma__landings *out)
{
    const float *const o[3] = {x, y, z}, *const d[3] = {rays->dx, rays->dy, rays->dz};
    const lines r = {x, y, z, rays->dx, rays->dy, rays->dz};
    koksma__slabs s;
    size_t at = 0;
    int count = 0;
    for (int i = 0; i < STEP(n); i++) {
        out->t[i] = h->t[i];
        out->u[i] = out->v[i] = 0;
        out->primitive[i] = -1;
        out->triangle[i] = 0;
    }
    if (faces->n_bundles) {
        koksma__slabs_of(o, d, faces->size, n, &s);
    }
    for (int b = 0; b < faces->n_bundles; at = faces->bundles[b++].end) {
        meet_range(faces, at, faces->bundles[b].first, &r, n, out);
        meet_bundle(faces, &faces->bundles[b], &s, &r, n, out);
    }
    meet_range(faces, at, (size_t)faces->n, &r, n, out);
    for (int i = 0; i < STEP(n); i++) {
        count += out->primitive[i] >= 0;
    }
    return count;
}

static void shade_all(const koksma__batch_faces *faces, const lines *r, int n, float *light)
{
    const float *const o[3] = {r->x, r->y, r->z}, *const d[3] = {r->dx, r->dy, r->dz};
    koksma__slabs s;
    size_t at = 0;
    if (faces->n_bundles) {
        koksma__slabs_of(o, d, faces->size, n, &s);
    }
    for (int b = 0; b < faces->n_bundles; at = faces->bundles[b++].end) {
        shade_range(faces, at, faces->bundles[b].first, r, n, light);
        shade_bundle(faces, &faces->bundles[b], &s, r, n, light);
    }
    shade_range(faces, at, (size_t)faces->n, r, n, light);
}

/* As in `occlude`, rays without light are left out where those are many. */
void BATCH_NAME(shade_faces)(const koksma__batch_faces *faces, const float *x, const float *y, const float *z,
                             const koksma__hits *h, int n, koksma__shadows *shadows)
{
    _Alignas(64) float d[3][KOKSMA__BLOCK];
    KOKSMA__LANES(float, lit);
    KOKSMA__LANES(int32_t, flags);
    koksma__picks p;
    koksma__rays some;
    const lines r = {x, y, z, d[0], d[1], d[2]};
    for (int i = 0; i < STEP(n); i++) { /* a ray ends where it would if it began at the hit */
        d[0][i] = shadows->dx[i] + (h->px[i] - x[i]);
        d[1][i] = shadows->dy[i] + (h->py[i] - y[i]);
        d[2][i] = shadows->dz[i] + (h->pz[i] - z[i]);
        flags[i] = shadows->light[i] != 0;
    }
    koksma__batch_pick(flags, n, &p);
    if (p.n > STEP(n) / 2) {
        shade_all(faces, &r, n, shadows->light);
    } else if (p.n) {
        const lines picked = pull_lines(&r, &p, &some);
        koksma__batch_pull_whole(shadows->light, &p, lit);
        shade_all(faces, &picked, koksma__batch_pulled(&p), lit);
        koksma__batch_push(lit, &p, shadows->light);
    }
}
