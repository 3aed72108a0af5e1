/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Intersects blocks of rays with analytic shapes, for the closest hits and for shadows: calls the loops of each
 * shape's kind (src/render/shapes) in turn, and completes hits on flat shapes.
 */
#include <math.h>

#include "render/pipelines/batch_kernel.h"
#include "render/shapes/shapes.h"

/* Indexed by koksma__batch_shape.kind. */
static const koksma__shape_type *const types[] = {
#define SHAPE(name) &KOKSMA__SHAPE(name),
#define COMPOUND(name) NULL,
#define COMPOUND_OF(name, file) NULL,
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

int BATCH_NAME(closest)(const koksma__batch_shapes *shapes, const koksma__rays *rays, const int32_t *from, int n,
                        koksma__hits *hits)
{
    if (shapes->n == 1 && !from && types[shapes->shapes->kind]->only) {
        return types[shapes->shapes->kind]->only(shapes->shapes, rays, n, hits);
    }
    KOKSMA__LANES(int32_t, nowhere);
    for (int i = 0; i < STEP(n); i++) {
        nowhere[i] = -1;
        hits->t[i] = INFINITY;
        hits->primitive[i] = -1;
    }
    for (size_t k = 0; k < shapes->n; k++) {
        types[shapes->shapes[k].kind]->hit(&shapes->shapes[k], rays, from ? from : nowhere, n, hits);
    }
    int done = koksma__batch_count_hits(hits, -1, n), count = 0;
    const int hit = STEP(n) - done;
    if (hit < STEP(n)) {
        clear(hits, n);
    }
    for (size_t k = 0; k < shapes->n && done < STEP(n); k++, done += count) {
        count = koksma__batch_count_hits(hits, shapes->shapes[k].id, n);
        if (count) {
            finish_shape(&shapes->shapes[k], rays, n, hits, count == STEP(n));
        }
    }
    return hit;
}

void BATCH_NAME(occlude)(const koksma__batch_shapes *shapes, const koksma__hits *hits, int n,
                         koksma__shadows *shadows)
{
    KOKSMA__LANES(int32_t, nowhere);
    for (int i = 0; i < STEP(n); i++) {
        nowhere[i] = -1;
    }
    for (size_t k = 0; k < shapes->n; k++) {
        const koksma__batch_shape *s = &shapes->shapes[k];
        /* a shape without a material is the surface of a light */
        types[s->kind]->shade(s, hits, s->material < 0 && shadows->aimed ? shadows->aimed : nowhere, n, shadows);
    }
}
