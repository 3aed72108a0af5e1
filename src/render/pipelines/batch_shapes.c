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
    const koksma__v3 c = koksma__v3_of(s->centre), normal = koksma__v3_of(s->normal);
    const koksma__v3 u = koksma__v3_of(s->axis_u), v = koksma__v3_of(s->axis_v);
    const int32_t id = s->id, material = s->material;
    for (int i = 0; i < STEP(n); i++) {
        const int hit = all | (h->primitive[i] == id);
        const koksma__v3 d = AT(r->d, i), p = koksma__v3_add(AT(r->o, i), koksma__v3_scale(d, h->t[i]));
        const koksma__v3 q = koksma__v3_subtract(p, c);
        const float side = koksma__v3_dot(normal, d) > 0 ? -1.0f : 1.0f;
        koksma__put_hit(h, i, hit, p, normal, side, koksma__v3_dot(q, u), koksma__v3_dot(q, v), material);
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

/* Rotates the vector v about a unit axis by the angle with this sine and cosine (Rodrigues' formula). */
INLINE koksma__v3 rotate(koksma__v3 axis, float sine, float cosine, koksma__v3 v)
{
    const koksma__v3 across = koksma__v3_scale(koksma__v3_cross(axis, v), sine);
    return koksma__v3_add(koksma__v3_add(koksma__v3_scale(v, cosine), across),
                          koksma__v3_scale(axis, (1 - cosine) * koksma__v3_dot(axis, v)));
}

/* Transforms lines o + t d, each at its time, to the frame in which the shape rests; t does not change. */
static void lines_at_rest(const koksma__batch_shape *s, const float *restrict time, int n,
                          const koksma__lanes *restrict o, const koksma__lanes *restrict d,
                          koksma__lanes *restrict to_o, koksma__lanes *restrict to_d)
{
    const koksma__v3 axis = koksma__v3_of(s->axis), pivot = koksma__v3_of(s->pivot),
                     motion = koksma__v3_of(s->motion);
    const float angle = s->angle, growth = s->growth;
    for (int i = 0; i < STEP(n); i++) {
        const float at = time[i], shrink = 1 / (1 + at * growth);
        const koksma__v3 e = koksma__v3_subtract(koksma__v3_subtract(AT(o, i), pivot), koksma__v3_scale(motion, at));
        float sine, cosine;
        koksma__sine_cosine_turns(-at * angle, &sine, &cosine);
        koksma__put(to_o, i, 1, koksma__v3_add(koksma__v3_scale(rotate(axis, sine, cosine, e), shrink), pivot));
        koksma__put(to_d, i, 1, koksma__v3_scale(rotate(axis, sine, cosine, AT(d, i)), shrink));
    }
}

static void hit_turned(const koksma__batch_shape *s, const koksma__rays *r, const int32_t *from, int n,
                       koksma__hits *h)
{
    koksma__rays rest;
    lines_at_rest(s, r->time, n, r->o, r->d, rest.o, rest.d);
    types[s->kind]->hit(s, &rest, from, n, h);
}

/* Completes the hits in the frame in which the shape rests, then transforms the positions and normals of the lanes
   that hit the shape back to the scene. */
static void finish_turned(const koksma__batch_shape *s, const koksma__rays *restrict r, int n,
                          koksma__hits *restrict h)
{
    const koksma__v3 axis = koksma__v3_of(s->axis);
    const float angle = s->angle;
    const int32_t id = s->id;
    koksma__rays rest;
    lines_at_rest(s, r->time, n, r->o, r->d, rest.o, rest.d);
    finish_shape(s, &rest, n, h, false);
    for (int i = 0; i < STEP(n); i++) {
        const int hit = h->primitive[i] == id;
        float sine, cosine;
        koksma__sine_cosine_turns(r->time[i] * angle, &sine, &cosine);
        koksma__put(h->p, i, hit, koksma__v3_add(AT(r->o, i), koksma__v3_scale(AT(r->d, i), h->t[i])));
        koksma__put(h->n, i, hit, rotate(axis, sine, cosine, AT(h->n, i)));
    }
}

static void shade_turned(const koksma__batch_shape *s, const koksma__hits *h, const int32_t *aimed, int n,
                         koksma__shadows *r)
{
    koksma__hits rest;
    koksma__shadows there;
    lines_at_rest(s, h->time, n, h->p, r->d, rest.p, there.d);
    memcpy(rest.primitive, h->primitive, sizeof rest.primitive);
    memcpy(there.light, r->light, sizeof there.light);
    types[s->kind]->shade(s, &rest, aimed, n, &there);
    memcpy(r->light, there.light, sizeof there.light);
}

/* ---- Bundles of shapes ---------------------------------------------------------------------------------------- */

static void pull_rays(const koksma__rays *r, const koksma__picks *p, koksma__rays *to)
{
    koksma__batch_pull_three(r->o, p, to->o);
    koksma__batch_pull_three(r->d, p, to->d);
}

/* Copies picked shadow rays, but for their times; `aimed` is room for their aims. */
static void pull_shadows(const koksma__hits *h, const koksma__shadows *r, const koksma__picks *p, int32_t *aimed,
                         koksma__hits *to_h, koksma__shadows *to)
{
    koksma__batch_pull_three(h->p, p, to_h->p);
    koksma__batch_pull_whole(h->primitive, p, to_h->primitive);
    koksma__batch_pull_three(r->d, p, to->d);
    koksma__batch_pull_whole(r->light, p, to->light);
    to->aimed = r->aimed ? aimed : NULL;
    if (r->aimed) {
        koksma__batch_pull_whole(r->aimed, p, aimed);
    }
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
    KOKSMA__LANES(int32_t, starts);
    koksma__picks p;
    koksma__slabs s;
    koksma__rays some;
    koksma__hits mine;
    koksma__slabs_of(r->o, r->d, shapes->size, n, &s);
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
    KOKSMA__LANES(int32_t, aimed);
    koksma__picks p;
    koksma__slabs s;
    koksma__hits some;
    koksma__shadows mine;
    koksma__slabs_of(h->p, r->d, shapes->size, n, &s);
    for (size_t b = 0; b < shapes->n_bundles; b++) {
        const koksma__batch_bundle *bundle = &shapes->bundles[b];
        koksma__near_bundle(bundle, &s, NULL, r->light, n, &p);
        if (!p.n) {
            continue;
        }
        const bool all = p.n > STEP(n) / 2;
        if (!all) {
            pull_shadows(h, r, &p, aimed, &some, &mine);
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
        koksma__put(hits->p, i, 1, (koksma__v3){0, 0, 0});
        koksma__put(hits->n, i, 1, (koksma__v3){0, 0, 0});
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
    for (int k = 0; k < 3; k++) {
        koksma__batch_push(done.p[k], p, h->p[k]);
        koksma__batch_push(done.n[k], p, h->n[k]);
    }
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
        pull_shadows(hits, shadows, &p, aimed, &some, &lit);
        koksma__batch_pull_whole(hits->time, &p, some.time);
        shade_all(shapes, &some, koksma__batch_pulled(&p), &lit);
        koksma__batch_push(lit.light, &p, shadows->light);
    }
}
