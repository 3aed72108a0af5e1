/* SPDX-License-Identifier: Apache-2.0 */
/* The part of accel_embree.c that knows no Embree: triangles of placed meshes, places and normals on them. */
#ifndef KOKSMA_RENDER_MESH_PARTS_H
#define KOKSMA_RENDER_MESH_PARTS_H

#include <math.h>
#include <string.h>

#include "render/batch.h"
#include "render/vector3.h"
#include "scene/mesh.h"

#define STEP_OFF 0x1p-20f

/* What is known of a placement. Vertices are placed, or (of an instance) in the mesh's coordinates. */
typedef struct part {
    const koksma__mesh *mesh;
    float *placed; /* owned by Embree; NULL: the mesh's own */
    bool is_instance, smooth, moves;
    float matrix[12], cofactors[9], motion[3];
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

/* The corners of a triangle, at time 0. */
static inline void corners_of(const part *p, uint32_t triangle, float out[3][3])
{
    const uint32_t *index = p->mesh->indices + 3 * (size_t)triangle;
    const float *vertices = p->placed ? p->placed : p->mesh->vertices;
    for (int c = 0; c < 3; c++) {
        const float *v = vertices + 3 * (size_t)index[c];
        if (p->is_instance) {
            place(p, v, out[c]);
        } else {
            memcpy(out[c], v, 3 * sizeof *v);
        }
    }
}

/* The unit normal, counterclockwise; in double, because the area of a small triangle is a very small number. */
static inline void normal_of(float c[3][3], float out[3])
{
    double a[3], b[3], n[3];
    for (int k = 0; k < 3; k++) {
        a[k] = (double)c[1][k] - (double)c[0][k];
        b[k] = (double)c[2][k] - (double)c[0][k];
    }
    for (int k = 0; k < 3; k++) {
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    const double scale = 1 / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) {
        out[k] = (float)(n[k] * scale);
    }
}

/* The normal between the vertices' own, turned to the side of the triangle's; false where there is none, or where it
   leads away from the eye although the triangle is seen. */
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
        const float *row = p->cofactors + 3 * k;
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

/* Lane i hit a triangle of part p at (u, v). */
static inline void finish(const part *p, uint32_t triangle, float u, float v, const koksma__rays *rays, int i,
                          koksma__hits *hits)
{
    const uint32_t *index = p->mesh->indices + 3 * (size_t)triangle;
    const float w[3] = {1 - u - v, u, v}, d[3] = {rays->dx[i], rays->dy[i], rays->dz[i]};
    const float time = p->moves ? rays->time[i] : 0;
    float corners[3][3], at[3], n[3], bent[3], uv[2] = {0, 0};
    corners_of(p, triangle, corners);
    normal_of(corners, n);
    for (int k = 0; k < 3; k++) {
        at[k] = w[0] * corners[0][k] + w[1] * corners[1][k] + w[2] * corners[2][k] + time * p->motion[k];
    }
    const bool back = koksma__dot3(n, d) > 0;
    for (int k = 0; k < 3; k++) {
        n[k] = back ? -n[k] : n[k];
    }
    if (p->smooth && smooth_normal(p, index, w, n, d, bent)) {
        memcpy(n, bent, sizeof n);
    }
    for (int c = 0; p->mesh->uvs && c < 3; c++) {
        uv[0] += w[c] * p->mesh->uvs[2 * (size_t)index[c]];
        uv[1] += w[c] * p->mesh->uvs[2 * (size_t)index[c] + 1];
    }
    hits->px[i] = at[0];
    hits->py[i] = at[1];
    hits->pz[i] = at[2];
    hits->nx[i] = n[0];
    hits->ny[i] = n[1];
    hits->nz[i] = n[2];
    hits->u[i] = uv[0];
    hits->v[i] = uv[1];
    hits->back[i] = back;
    hits->primitive[i] = p->first + (int32_t)triangle;
    hits->material[i] = p->material;
}

/* Moves a start on a triangle off it, to the side that d leads to. */
static inline void step_off(const part *p, uint32_t triangle, const float d[3], float o[3])
{
    float corners[3][3], n[3], largest = 0;
    corners_of(p, triangle, corners);
    normal_of(corners, n);
    for (int i = 0; i < 9; i++) {
        const float size = fabsf(corners[i / 3][i % 3]) + fabsf(p->motion[i % 3]);
        largest = size > largest ? size : largest;
    }
    const float way = koksma__dot3(n, d) < 0 ? -STEP_OFF * largest : STEP_OFF * largest;
    for (int k = 0; k < 3; k++) {
        o[k] += way * n[k];
    }
}

#endif
