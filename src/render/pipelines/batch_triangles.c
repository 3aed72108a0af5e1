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

#define OFF 0x1p-20f

/* Computes the unit normal of the triangle in lane i, whose corners are counterclockwise. The edges of the
   triangle are scaled first, because the squared area of a small triangle underflows a float. */
INLINE koksma__v3 normal_of(const koksma__landings *restrict l, int i)
{
    const koksma__v3 corner = AT(l->corners, i), a = koksma__v3_subtract(AT(l->corners + 3, i), corner);
    const koksma__v3 b = koksma__v3_subtract(AT(l->corners + 6, i), corner);
    const float p = koksma__larger(koksma__larger(fabsf(a.x), fabsf(a.y)), fabsf(a.z));
    const float q = koksma__larger(koksma__larger(fabsf(b.x), fabsf(b.y)), fabsf(b.z));
    return koksma__v3_unit(koksma__v3_cross(koksma__v3_scale(a, 1 / koksma__larger(p, 1e-30f)),
                                            koksma__v3_scale(b, 1 / koksma__larger(q, 1e-30f))));
}

void BATCH_NAME(land)(const koksma__landings *restrict l, const koksma__rays *restrict r, int n,
                      koksma__hits *restrict h)
{
    for (int i = 0; i < STEP(n); i++) {
        const int hit = l->primitive[i] >= 0;
        const float u = l->u[i], v = l->v[i];
        const koksma__v3 a = koksma__v3_scale(AT(l->corners, i), 1 - u - v);
        const koksma__v3 b = koksma__v3_scale(AT(l->corners + 3, i), u),
                         c = koksma__v3_scale(AT(l->corners + 6, i), v);
        const koksma__v3 p = koksma__v3_add(koksma__v3_add(koksma__v3_add(a, b), c), AT(l->shift, i));
        const koksma__v3 normal = normal_of(l, i);
        const float side = koksma__v3_dot(normal, AT(r->d, i)) > 0 ? -1.0f : 1.0f;
        h->t[i] = hit ? l->t[i] : h->t[i];
        h->primitive[i] = hit ? l->primitive[i] : h->primitive[i];
        koksma__put_hit(h, i, hit, p, normal, side, 0, 0, l->material[i]);
    }
}

void BATCH_NAME(step_off)(const koksma__landings *restrict l, const koksma__lanes *restrict d, int n,
                          koksma__lanes *restrict o)
{
    for (int i = 0; i < STEP(n); i++) {
        const koksma__v3 normal = normal_of(l, i);
        float largest = 0;
        for (int k = 0; k < 9; k++) {
            largest = koksma__larger(largest, fabsf(l->corners[k][i]) + fabsf(l->shift[k % 3][i]));
        }
        const float offset = koksma__v3_dot(normal, AT(d, i)) < 0 ? -OFF * largest : OFF * largest;
        koksma__put(o, i, l->primitive[i] >= 0, koksma__v3_add(AT(o, i), koksma__v3_scale(normal, offset)));
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

static void meet_range(const koksma__batch_faces *faces, size_t first, size_t end, const koksma__lanes *restrict o,
                       const koksma__lanes *restrict d, int n, koksma__landings *restrict out)
{
    for (size_t k = first; k < end; k++) {
        const koksma__batch_face f = faces->faces[k];
        LANES_APART
        for (int i = 0; i < STEP(n); i++) {
            const meeting m = meet(&f, koksma__v3_subtract(AT(o, i), koksma__v3_of(f.corner)), AT(d, i));
            const int hit = m.inside & (m.t > 0) & (m.t < out->t[i]);
            out->t[i] = hit ? m.t : out->t[i];
            out->u[i] = hit ? m.u : out->u[i];
            out->v[i] = hit ? m.v : out->v[i];
            out->primitive[i] = hit ? f.part : out->primitive[i];
            out->triangle[i] = hit ? f.triangle : out->triangle[i];
        }
    }
}

static void shade_range(const koksma__batch_faces *faces, size_t first, size_t end, const koksma__lanes *restrict o,
                        const koksma__lanes *restrict d, int n, float *restrict light)
{
    for (size_t k = first; k < end; k++) {
        const koksma__batch_face f = faces->faces[k];
        LANES_APART
        for (int i = 0; i < STEP(n); i++) {
            const meeting m = meet(&f, koksma__v3_subtract(AT(o, i), koksma__v3_of(f.corner)), AT(d, i));
            const int hit = m.inside & (m.t > 0) & (m.t < KOKSMA__SHADOW_END);
            light[i] *= hit ? 0.0f : 1.0f;
        }
    }
}

static void meet_bundle(const koksma__batch_faces *faces, const koksma__batch_bundle *b, const koksma__slabs *s,
                        const koksma__lanes *o, const koksma__lanes *d, int n, koksma__landings *out)
{
    koksma__picks p;
    koksma__rays some;
    koksma__landings on;
    koksma__near_bundle(b, s, out->t, NULL, n, &p);
    if (p.n > STEP(n) / 2) {
        meet_range(faces, b->first, b->end, o, d, n, out);
    } else if (p.n) {
        const void *const from[] = {out->t, out->u, out->v, out->primitive, out->triangle};
        void *const to[] = {on.t, on.u, on.v, on.primitive, on.triangle};
        koksma__batch_pull_three(o, &p, some.o);
        koksma__batch_pull_three(d, &p, some.d);
        for (int k = 0; k < 5; k++) {
            koksma__batch_pull_whole(from[k], &p, to[k]);
        }
        meet_range(faces, b->first, b->end, some.o, some.d, koksma__batch_pulled(&p), &on);
        for (int k = 0; k < 5; k++) {
            koksma__batch_push(to[k], &p, (void *)from[k]);
        }
    }
}

static void shade_bundle(const koksma__batch_faces *faces, const koksma__batch_bundle *b, const koksma__slabs *s,
                         const koksma__lanes *o, const koksma__lanes *d, int n, float *light)
{
    KOKSMA__LANES(float, lit);
    koksma__picks p;
    koksma__rays some;
    koksma__near_bundle(b, s, NULL, light, n, &p);
    if (p.n > STEP(n) / 2) {
        shade_range(faces, b->first, b->end, o, d, n, light);
    } else if (p.n) {
        koksma__batch_pull_three(o, &p, some.o);
        koksma__batch_pull_three(d, &p, some.d);
        koksma__batch_pull_whole(light, &p, lit);
        shade_range(faces, b->first, b->end, some.o, some.d, koksma__batch_pulled(&p), lit);
        koksma__batch_push(lit, &p, light);
    }
}

int BATCH_NAME(meet_faces)(const koksma__batch_faces *faces, const koksma__lanes *o, const koksma__rays *rays,
                           const koksma__hits *h, int n, koksma__landings *out)
{
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
        koksma__slabs_of(o, rays->d, faces->size, n, &s);
    }
    for (int b = 0; b < faces->n_bundles; at = faces->bundles[b++].end) {
        meet_range(faces, at, faces->bundles[b].first, o, rays->d, n, out);
        meet_bundle(faces, &faces->bundles[b], &s, o, rays->d, n, out);
    }
    meet_range(faces, at, (size_t)faces->n, o, rays->d, n, out);
    for (int i = 0; i < STEP(n); i++) {
        count += out->primitive[i] >= 0;
    }
    return count;
}

static void shade_all(const koksma__batch_faces *faces, const koksma__lanes *o, const koksma__lanes *d, int n,
                      float *light)
{
    koksma__slabs s;
    size_t at = 0;
    if (faces->n_bundles) {
        koksma__slabs_of(o, d, faces->size, n, &s);
    }
    for (int b = 0; b < faces->n_bundles; at = faces->bundles[b++].end) {
        shade_range(faces, at, faces->bundles[b].first, o, d, n, light);
        shade_bundle(faces, &faces->bundles[b], &s, o, d, n, light);
    }
    shade_range(faces, at, (size_t)faces->n, o, d, n, light);
}

/* As in `occlude`, rays without light are left out where those are many. */
void BATCH_NAME(shade_faces)(const koksma__batch_faces *faces, const koksma__lanes *o, const koksma__hits *h, int n,
                             koksma__shadows *shadows)
{
    _Alignas(64) koksma__lanes d[3];
    KOKSMA__LANES(float, lit);
    KOKSMA__LANES(int32_t, flags);
    koksma__picks p;
    koksma__rays some;
    for (int i = 0; i < STEP(n); i++) { /* a ray ends where it would if it began at the hit */
        for (int k = 0; k < 3; k++) {
            d[k][i] = shadows->d[k][i] + (h->p[k][i] - o[k][i]);
        }
        flags[i] = shadows->light[i] != 0;
    }
    koksma__batch_pick(flags, n, &p);
    if (p.n > STEP(n) / 2) {
        shade_all(faces, o, d, n, shadows->light);
    } else if (p.n) {
        koksma__batch_pull_three(o, &p, some.o);
        koksma__batch_pull_three(d, &p, some.d);
        koksma__batch_pull_whole(shadows->light, &p, lit);
        shade_all(faces, some.o, some.d, koksma__batch_pulled(&p), lit);
        koksma__batch_push(lit, &p, shadows->light);
    }
}
