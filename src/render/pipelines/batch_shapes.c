/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Intersects blocks of rays with analytic shapes, for the closest hits and for shadows: calls the loops of each
 * shape's kind (src/render/shapes) in turn, and completes hits on flat shapes. For a shape that turns, each ray is
 * transformed, at the ray's own time, to the frame in which the shape rests; so the loops for shapes at rest also
 * serve shapes that turn.
 */
#include <math.h>
#include <string.h>

#include "render/pipelines/batch_kernel.h"
#include "render/shapes/shapes.h"
#include "render/vector3.h"

/* Indexed by koksma__batch_shape.kind. */
static const koksma__shape_type *const types[] = {
#define SHAPE(name) &KOKSMA__SHAPE(name),
#define COMPOUND(name) NULL,
#include "render/shapes/shapes.def"
};

/* Computes the position, normal and coordinates of the lanes that hit the flat shape s. all: whether every lane hit
   it. */
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

static void finish_shape(const koksma__batch_shape *s, const koksma__rays *rays, int n, koksma__hits *hits, bool all)
{
    if (types[s->kind]->finish) {
        types[s->kind]->finish(s, rays, n, hits, all);
    } else if (all) {
        finish_flat(s, rays, n, hits, true);
    } else {
        finish_flat(s, rays, n, hits, false);
    }
}

/* ---- Shapes that turn ----------------------------------------------------------------------------------------- */

/* Rotates the vector (x, y, z) about a unit axis by the angle with this sine and cosine (Rodrigues' formula). */
INLINE void rotate(const float axis[3], float sine, float cosine, float *x, float *y, float *z)
{
    const float ax = axis[0], ay = axis[1], az = axis[2], vx = *x, vy = *y, vz = *z;
    const float along = (1 - cosine) * (ax * vx + ay * vy + az * vz);
    *x = cosine * vx + sine * (ay * vz - az * vy) + along * ax;
    *y = cosine * vy + sine * (az * vx - ax * vz) + along * ay;
    *z = cosine * vz + sine * (ax * vy - ay * vx) + along * az;
}

/* Transforms lines o + t d, each at its time, to the frame in which the shape rests; t does not change. */
INLINE void lines_at_rest(const koksma__batch_shape *shape, const float *restrict time, int n,
                          const float *const *restrict from, float *const *restrict to)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const float *restrict ox = from[0], *restrict oy = from[1], *restrict oz = from[2];
    const float *restrict dx = from[3], *restrict dy = from[4], *restrict dz = from[5];
    float *restrict tx = to[0], *restrict ty = to[1], *restrict tz = to[2];
    float *restrict ux = to[3], *restrict uy = to[4], *restrict uz = to[5];
    for (int i = 0; i < STEP(n); i++) {
        const float at = time[i], shrink = 1 / (1 + at * s->growth);
        float ex = ox[i] - s->pivot[0] - at * s->motion[0], ey = oy[i] - s->pivot[1] - at * s->motion[1],
              ez = oz[i] - s->pivot[2] - at * s->motion[2], fx = dx[i], fy = dy[i], fz = dz[i], sine, cosine;
        koksma__sine_cosine_turns(-at * s->angle, &sine, &cosine);
        rotate(s->axis, sine, cosine, &ex, &ey, &ez);
        rotate(s->axis, sine, cosine, &fx, &fy, &fz);
        tx[i] = shrink * ex + s->pivot[0];
        ty[i] = shrink * ey + s->pivot[1];
        tz[i] = shrink * ez + s->pivot[2];
        ux[i] = shrink * fx;
        uy[i] = shrink * fy;
        uz[i] = shrink * fz;
    }
}

static void rays_at_rest(const koksma__batch_shape *s, const koksma__rays *r, int n, koksma__rays *out)
{
    const float *const from[6] = {r->ox, r->oy, r->oz, r->dx, r->dy, r->dz};
    float *const to[6] = {out->ox, out->oy, out->oz, out->dx, out->dy, out->dz};
    lines_at_rest(s, r->time, n, from, to);
}

static void hit_turned(const koksma__batch_shape *s, const koksma__rays *r, const int32_t *from, int n,
                       koksma__hits *h)
{
    koksma__rays rest;
    rays_at_rest(s, r, n, &rest);
    types[s->kind]->hit(s, &rest, from, n, h);
}

/* Completes the hits in the frame in which the shape rests, then transforms the positions and normals of the lanes
   that hit the shape back to the scene. */
static void finish_turned(const koksma__batch_shape *shape, const koksma__rays *restrict r, int n,
                          koksma__hits *restrict h)
{
    koksma__rays rest;
    const koksma__batch_shape copy = *shape, *s = &copy;
    rays_at_rest(s, r, n, &rest);
    finish_shape(s, &rest, n, h, false);
    for (int i = 0; i < STEP(n); i++) {
        const int hit = h->primitive[i] == s->id;
        float nx = h->nx[i], ny = h->ny[i], nz = h->nz[i], sine, cosine;
        koksma__sine_cosine_turns(r->time[i] * s->angle, &sine, &cosine);
        rotate(s->axis, sine, cosine, &nx, &ny, &nz);
        h->px[i] = hit ? r->ox[i] + h->t[i] * r->dx[i] : h->px[i];
        h->py[i] = hit ? r->oy[i] + h->t[i] * r->dy[i] : h->py[i];
        h->pz[i] = hit ? r->oz[i] + h->t[i] * r->dz[i] : h->pz[i];
        h->nx[i] = hit ? nx : h->nx[i];
        h->ny[i] = hit ? ny : h->ny[i];
        h->nz[i] = hit ? nz : h->nz[i];
    }
}

static void shade_turned(const koksma__batch_shape *s, const koksma__hits *h, const int32_t *aimed, int n,
                         koksma__shadows *r)
{
    koksma__hits rest;
    koksma__shadows there;
    const float *const from[6] = {h->px, h->py, h->pz, r->dx, r->dy, r->dz};
    float *const to[6] = {rest.px, rest.py, rest.pz, there.dx, there.dy, there.dz};
    lines_at_rest(s, h->time, n, from, to);
    memcpy(rest.primitive, h->primitive, sizeof rest.primitive);
    memcpy(there.light, r->light, sizeof there.light);
    types[s->kind]->shade(s, &rest, aimed, n, &there);
    memcpy(r->light, there.light, sizeof there.light);
}

/* ---- Bundles of shapes ---------------------------------------------------------------------------------------- */

static void pull_rays(const koksma__rays *r, const koksma__picks *p, koksma__rays *to)
{
    koksma__batch_pull_whole(r->ox, p, to->ox);
    koksma__batch_pull_whole(r->oy, p, to->oy);
    koksma__batch_pull_whole(r->oz, p, to->oz);
    koksma__batch_pull_whole(r->dx, p, to->dx);
    koksma__batch_pull_whole(r->dy, p, to->dy);
    koksma__batch_pull_whole(r->dz, p, to->dz);
}

/* Keeps the closer of the hits of each lane; of two at the same t that of the first shape, whatever their order. */
INLINE void keep(const koksma__hits *restrict mine, const int32_t *restrict lanes, int n, koksma__hits *restrict h)
{
    for (int j = 0; j < n; j++) {
        const int i = lanes ? lanes[j] : j;
        const int closer = mine->t[j] < h->t[i];
        const int same = (mine->primitive[j] >= 0) & (mine->t[j] <= h->t[i]) & (mine->primitive[j] < h->primitive[i]);
        h->t[i] = closer | same ? mine->t[j] : h->t[i];
        h->primitive[i] = closer | same ? mine->primitive[j] : h->primitive[i];
    }
}

static void hit_bundles(const koksma__batch_shapes *shapes, const koksma__rays *r, const int32_t *from, int n,
                        koksma__hits *h)
{
    const float *const o[3] = {r->ox, r->oy, r->oz}, *const d[3] = {r->dx, r->dy, r->dz};
    KOKSMA__LANES(int32_t, starts);
    koksma__picks p;
    koksma__slabs s;
    koksma__rays some;
    koksma__hits mine;
    koksma__slabs_of(o, d, shapes->size, n, &s);
    for (size_t b = 0; b < shapes->n_bundles; b++) {
        const koksma__batch_bundle *bundle = &shapes->bundles[b];
        koksma__near_bundle(bundle, &s, h->t, NULL, n, &p);
        if (!p.n) {
            continue;
        }
        const bool all = p.n > STEP(n) / 2;
        const int whole = all ? n : koksma__batch_pulled(&p);
        if (!all) {
            pull_rays(r, &p, &some);
            koksma__batch_pull_whole(from, &p, starts);
        }
        for (int j = 0; j < STEP(whole); j++) {
            mine.t[j] = INFINITY;
            mine.primitive[j] = -1;
        }
        for (size_t k = bundle->first; k < bundle->end; k++) {
            const koksma__batch_shape *shape = &shapes->shapes[shapes->order[k]];
            types[shape->kind]->hit(shape, all ? r : &some, all ? from : starts, whole, &mine);
        }
        if (all) {
            keep(&mine, NULL, STEP(n), h);
        } else {
            keep(&mine, p.lane, p.n, h);
        }
    }
}

/* nowhere: -1 in all lanes */
static void shade_shape(const koksma__batch_shape *s, const koksma__hits *h, const int32_t *nowhere, int n,
                        koksma__shadows *r)
{
    /* a shape without a material is the surface of a light */
    const int32_t *aimed = s->material < 0 && r->aimed ? r->aimed : nowhere;
    (s->turns ? shade_turned : types[s->kind]->shade)(s, h, aimed, n, r);
}

static void shade_bundles(const koksma__batch_shapes *shapes, const koksma__hits *h, const int32_t *nowhere, int n,
                          koksma__shadows *r)
{
    const float *const o[3] = {h->px, h->py, h->pz}, *const d[3] = {r->dx, r->dy, r->dz};
    KOKSMA__LANES(int32_t, aimed);
    koksma__picks p;
    koksma__slabs s;
    koksma__hits some;
    koksma__shadows mine;
    mine.aimed = r->aimed ? aimed : NULL;
    koksma__slabs_of(o, d, shapes->size, n, &s);
    for (size_t b = 0; b < shapes->n_bundles; b++) {
        const koksma__batch_bundle *bundle = &shapes->bundles[b];
        koksma__near_bundle(bundle, &s, NULL, r->light, n, &p);
        if (!p.n) {
            continue;
        }
        const bool all = p.n > STEP(n) / 2;
        if (!all) {
            koksma__batch_pull_whole(h->px, &p, some.px);
            koksma__batch_pull_whole(h->py, &p, some.py);
            koksma__batch_pull_whole(h->pz, &p, some.pz);
            koksma__batch_pull_whole(h->primitive, &p, some.primitive);
            koksma__batch_pull_whole(r->dx, &p, mine.dx);
            koksma__batch_pull_whole(r->dy, &p, mine.dy);
            koksma__batch_pull_whole(r->dz, &p, mine.dz);
            koksma__batch_pull_whole(r->light, &p, mine.light);
        }
        if (!all && r->aimed) {
            koksma__batch_pull_whole(r->aimed, &p, aimed);
        }
        for (size_t k = bundle->first; k < bundle->end; k++) {
            shade_shape(&shapes->shapes[shapes->order[k]], all ? h : &some, nowhere,
                        all ? n : koksma__batch_pulled(&p), all ? r : &mine);
        }
        if (!all) {
            koksma__batch_push(mine.light, &p, r->light);
        }
    }
}

/* ---- Lists of shapes ------------------------------------------------------------------------------------------ */

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

/* Completes the picked hits, which are on the shape s. */
static void finish_some(const koksma__batch_shape *s, const koksma__rays *rays, const koksma__picks *p,
                        koksma__hits *h)
{
    koksma__rays some;
    koksma__hits done;
    pull_rays(rays, p, &some);
    koksma__batch_pull_whole(h->t, p, done.t);
    finish_shape(s, &some, koksma__batch_pulled(p), &done, true);
    koksma__batch_push(done.px, p, h->px);
    koksma__batch_push(done.py, p, h->py);
    koksma__batch_push(done.pz, p, h->pz);
    koksma__batch_push(done.nx, p, h->nx);
    koksma__batch_push(done.ny, p, h->ny);
    koksma__batch_push(done.nz, p, h->nz);
    koksma__batch_push(done.u, p, h->u);
    koksma__batch_push(done.v, p, h->v);
    koksma__batch_push(done.back, p, h->back);
    koksma__batch_push(done.material, p, h->material);
}

/* Completes the hits on shapes in a list with bundles, of which a block may meet many, each in few lanes. */
static void finish_each(const koksma__batch_shapes *shapes, const koksma__rays *rays, int n, koksma__hits *h)
{
    KOKSMA__LANES(int32_t, left);
    KOKSMA__LANES(int32_t, mine);
    koksma__picks p;
    memcpy(left, h->primitive, sizeof left);
    for (int i = 0; i < STEP(n); i++) {
        const int32_t id = left[i];
        if (id < 0) {
            continue;
        }
        for (int j = 0; j < STEP(n); j++) {
            mine[j] = left[j] == id;
            left[j] = left[j] == id ? -1 : left[j];
        }
        koksma__batch_pick(mine, n, &p);
        const koksma__batch_shape *s = &shapes->shapes[id];
        if (s->turns) {
            finish_turned(s, rays, n, h);
        } else if (s->moves || p.n > STEP(n) / 8) {
            finish_shape(s, rays, n, h, p.n == STEP(n));
        } else {
            finish_some(s, rays, &p, h);
        }
    }
}

/* Completes the hits on shapes in a short list; some lanes may have none. */
static void finish_all(const koksma__batch_shapes *shapes, const koksma__rays *rays, int n, int hit,
                       koksma__hits *hits)
{
    int done = STEP(n) - hit, count = 0;
    for (size_t k = 0; k < shapes->n && done < STEP(n); k++, done += count) {
        count = koksma__batch_count_hits(hits, shapes->shapes[k].id, n);
        if (count && shapes->shapes[k].turns) {
            finish_turned(&shapes->shapes[k], rays, n, hits);
        } else if (count) {
            finish_shape(&shapes->shapes[k], rays, n, hits, count == STEP(n));
        }
    }
}

enum { FEW = 4 }; /* fewer shapes are not worth the copies */

/* The shapes of a list that are in no bundle. */
static size_t alone(const koksma__batch_shapes *shapes)
{
    return shapes->n_bundles ? shapes->n_alone : shapes->n;
}

static const koksma__batch_shape *shape_at(const koksma__batch_shapes *shapes, size_t k)
{
    return &shapes->shapes[shapes->n_bundles ? shapes->order[k] : k];
}

int BATCH_NAME(closest)(const koksma__batch_shapes *shapes, const koksma__rays *rays, const int32_t *from, int n,
                        koksma__hits *hits)
{
    if (shapes->n == 1 && !from && types[shapes->shapes->kind]->only && !shapes->shapes->turns) {
        return types[shapes->shapes->kind]->only(shapes->shapes, rays, n, hits);
    }
    KOKSMA__LANES(int32_t, nowhere);
    for (int i = 0; i < STEP(n); i++) {
        nowhere[i] = -1;
        hits->t[i] = INFINITY;
        hits->primitive[i] = -1;
    }
    for (size_t k = 0; k < alone(shapes); k++) {
        const koksma__batch_shape *s = shape_at(shapes, k);
        (s->turns ? hit_turned : types[s->kind]->hit)(s, rays, from ? from : nowhere, n, hits);
    }
    if (shapes->n_bundles) {
        hit_bundles(shapes, rays, from ? from : nowhere, n, hits);
    }
    const int hit = STEP(n) - koksma__batch_count_hits(hits, -1, n);
    if (hit < STEP(n)) {
        clear(hits, n);
    }
    if (shapes->n_bundles) {
        finish_each(shapes, rays, n, hits);
    } else {
        finish_all(shapes, rays, n, hit, hits);
    }
    return hit;
}

static void shade_all(const koksma__batch_shapes *shapes, const koksma__hits *hits, int n, koksma__shadows *shadows)
{
    KOKSMA__LANES(int32_t, nowhere);
    for (int i = 0; i < STEP(n); i++) {
        nowhere[i] = -1;
    }
    for (size_t k = 0; k < alone(shapes); k++) {
        shade_shape(shape_at(shapes, k), hits, nowhere, n, shadows);
    }
    if (shapes->n_bundles) {
        shade_bundles(shapes, hits, nowhere, n, shadows);
    }
}

/* Shadow rays that carry no light are left out where those are many, and shapes not few. */
void BATCH_NAME(occlude)(const koksma__batch_shapes *shapes, const koksma__hits *hits, int n,
                         koksma__shadows *shadows)
{
    KOKSMA__LANES(int32_t, flags);
    KOKSMA__LANES(int32_t, aimed);
    koksma__picks p;
    koksma__hits some;
    koksma__shadows lit;
    if (shapes->n < FEW) {
        shade_all(shapes, hits, n, shadows);
        return;
    }
    for (int i = 0; i < STEP(n); i++) {
        flags[i] = shadows->light[i] != 0;
    }
    koksma__batch_pick(flags, n, &p);
    if (p.n > STEP(n) / 2) {
        shade_all(shapes, hits, n, shadows);
    } else if (p.n) {
        koksma__batch_pull_whole(hits->px, &p, some.px);
        koksma__batch_pull_whole(hits->py, &p, some.py);
        koksma__batch_pull_whole(hits->pz, &p, some.pz);
        koksma__batch_pull_whole(hits->time, &p, some.time);
        koksma__batch_pull_whole(hits->primitive, &p, some.primitive);
        koksma__batch_pull_whole(shadows->dx, &p, lit.dx);
        koksma__batch_pull_whole(shadows->dy, &p, lit.dy);
        koksma__batch_pull_whole(shadows->dz, &p, lit.dz);
        koksma__batch_pull_whole(shadows->light, &p, lit.light);
        lit.aimed = shadows->aimed ? aimed : NULL;
        if (shadows->aimed) {
            koksma__batch_pull_whole(shadows->aimed, &p, aimed);
        }
        shade_all(shapes, &some, koksma__batch_pulled(&p), &lit);
        koksma__batch_push(lit.light, &p, shadows->light);
    }
}
