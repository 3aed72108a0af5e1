/* SPDX-License-Identifier: Apache-2.0 */
/* The part of accel_embree.c that knows no Embree: triangles of placed meshes. */
#ifndef KOKSMA_RENDER_ACCEL_MESH_PARTS_H
#define KOKSMA_RENDER_ACCEL_MESH_PARTS_H

#include <math.h>
#include <string.h>

#include "meshes/mesh.h"
#include "render/pipelines/batch.h"
#include "render/vector3.h"

/* What is known of a placement. Vertices are placed, or (of an instance) in the mesh's coordinates. */
typedef struct part {
    const koksma__mesh *mesh;
    float *placed; /* owned by Embree; NULL: the mesh's own */
    bool is_instance, smooth, moves;
    float matrix[12], normal_matrix[9], motion[3];
    int32_t material, light;
    int32_t first; /* number of its first triangle, as a primitive */
} part;

static inline void place(const part *p, const float v[3], float out[3])
{
    for (int k = 0; k < 3; k++) {
        const float *row = p->matrix + 4 * k;
        out[k] = row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + row[3];
    }
}

/* Rays leave a large mesh's triangles in no order that the processor could foresee: what a block of them needs is
   asked for together, before the first of it is used. */
static inline void fetch_triangle(const part *p, uint32_t triangle)
{
    __builtin_prefetch(p->mesh->indices + 3 * (size_t)triangle);
}

static inline void fetch_corners(const part *p, uint32_t triangle)
{
    const uint32_t *index = p->mesh->indices + 3 * (size_t)triangle;
    const float *vertices = p->placed ? p->placed : p->mesh->vertices;
    for (int c = 0; c < 3; c++) {
        __builtin_prefetch(vertices + 3 * (size_t)index[c]);
    }
}

/* l->primitive: numbers of parts, -1: none. */
static inline void fetch_landings(const part *parts, const koksma__landings *l, int n)
{
    for (int i = 0; i < n; i++) {
        if (l->primitive[i] >= 0) {
            fetch_corners(&parts[l->primitive[i]], l->triangle[i]);
        }
    }
}

/* Triangle `triangle` of the part at this time, into lane i. */
static inline void set_lane(const part *p, uint32_t triangle, float time, int i, koksma__landings *l)
{
    const uint32_t *index = p->mesh->indices + 3 * (size_t)triangle;
    const float *vertices = p->placed ? p->placed : p->mesh->vertices;
    for (int c = 0; c < 3; c++) {
        const float *v = vertices + 3 * (size_t)index[c];
        float moved[3];
        if (p->is_instance) {
            place(p, v, moved);
            v = moved;
        }
        for (int k = 0; k < 3; k++) {
            l->corners[3 * c + k][i] = v[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        l->shift[k][i] = p->moves ? time * p->motion[k] : 0;
    }
    l->primitive[i] = p->first + (int32_t)triangle;
    l->material[i] = p->material;
}

/* The normal between the vertices' own, turned to the side of the triangle's; false where there is none, or where it
   leads away from the eye although the triangle is seen. What a mirror or glass sends off by it may run into the
   triangle's own mesh, and its light is lost: of a white octahedron .014 in mirror, .021 in glass (docs/scenes.md).
 */
static inline bool smooth_normal(const part *p, const uint32_t *index, const float w[3], const float geometric[3],
                                 const float d[3], float out[3])
{
    float n[3] = {0, 0, 0};
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < 3; k++) {
            n[k] += w[c] * p->mesh->normals[3 * (size_t)index[c] + (size_t)k];
        }
    }
    for (int k = 0; k < 3; k++) {
        const float *row = p->normal_matrix + 3 * k;
        out[k] = row[0] * n[0] + row[1] * n[1] + row[2] * n[2];
    }
    if (!(koksma__dot3(out, out) > 1e-12f)) {
        return false;
    }
    const float side = koksma__dot3(out, geometric) < 0 ? -1.0f : 1.0f;
    for (int k = 0; k < 3; k++) {
        out[k] *= side;
    }
    koksma__unit3(out);
    return koksma__dot3(out, d) < 0;
}

/* What lane i has of its vertices: the normal between theirs, and the texture's coordinates. */
static inline void refine(const part *p, const koksma__landings *l, const koksma__rays *rays, int i,
                          koksma__hits *hits)
{
    const uint32_t *index = p->mesh->indices + 3 * (size_t)(l->primitive[i] - p->first);
    const float w[3] = {1 - l->u[i] - l->v[i], l->u[i], l->v[i]};
    const float d[3] = {rays->dx[i], rays->dy[i], rays->dz[i]}, n[3] = {hits->nx[i], hits->ny[i], hits->nz[i]};
    float bent[3];
    if (p->smooth && smooth_normal(p, index, w, n, d, bent)) {
        hits->nx[i] = bent[0];
        hits->ny[i] = bent[1];
        hits->nz[i] = bent[2];
    }
    for (int c = 0; p->mesh->uvs && c < 3; c++) {
        hits->u[i] += w[c] * p->mesh->uvs[2 * (size_t)index[c]];
        hits->v[i] += w[c] * p->mesh->uvs[2 * (size_t)index[c] + 1];
    }
}

#endif
