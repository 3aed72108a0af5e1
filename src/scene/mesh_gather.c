/* SPDX-License-Identifier: Apache-2.0 */
#include "scene/model_build.h"

/* Polygons are fans around their first corner: right for convex ones. assimp would cut others well, too, but ends
   the program when a mesh has nothing to cut. */
size_t koksma__file_triangles(const koksma__file_mesh *mesh)
{
    size_t n = 0, corners;
    for (size_t i = 0; i < mesh->n_faces; i++) {
        mesh->face(mesh->faces, i, &corners);
        n += corners >= 3 ? corners - 2 : 0;
    }
    return n;
}

void koksma__gather_count(void *gatherer, const koksma__file_mesh *mesh, const double matrix[12])
{
    koksma__gatherer *g = gatherer;
    (void)matrix;
    const size_t triangles = koksma__file_triangles(mesh);
    if (triangles) {
        g->vertices += mesh->n_vertices;
        g->triangles += triangles;
        g->normals &= mesh->normals != NULL;
        g->uvs &= mesh->uvs != NULL;
    }
}

bool koksma__matrix_mirrors(const double m[12])
{
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
               m[2] * (m[4] * m[9] - m[5] * m[8]) <
           0;
}

/* sign undoes the determinant's. */
static void turn_normal(const double turn[9], double sign, const float v[3], float out[3])
{
    for (int r = 0; r < 3; r++) {
        const double *row = turn + 3 * r;
        out[r] = (float)(sign * (row[0] * (double)v[0] + row[1] * (double)v[1] + row[2] * (double)v[2]));
    }
}

static void append_vertices(const koksma__file_mesh *mesh, const double matrix[12], double sign, size_t base,
                            koksma__mesh *out)
{
    double turn[9];
    koksma__normal_matrix(matrix, turn);
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        const float *v = mesh->positions + 3 * i;
        for (size_t k = 0; k < 3; k++) {
            const double *row = matrix + 4 * k;
            out->vertices[3 * (base + i) + k] =
                (float)(row[0] * (double)v[0] + row[1] * (double)v[1] + row[2] * (double)v[2] + row[3]);
        }
        if (out->normals) {
            turn_normal(turn, sign, mesh->normals + 3 * i, out->normals + 3 * (base + i));
        }
        if (out->uvs) {
            out->uvs[2 * (base + i)] = mesh->uvs[3 * i];
            out->uvs[2 * (base + i) + 1] = mesh->uvs[3 * i + 1];
        }
    }
}

void koksma__gather_append(void *gatherer, const koksma__file_mesh *mesh, const double matrix[12])
{
    koksma__gatherer *g = gatherer;
    if (!koksma__file_triangles(mesh)) {
        return;
    }
    const size_t base = g->vertices;
    const bool swapped = koksma__matrix_mirrors(matrix) != g->mirrored;
    append_vertices(mesh, matrix, swapped ? -1 : 1, base, g->out);
    for (size_t i = 0; i < mesh->n_faces; i++) {
        size_t n_corners;
        const unsigned *face = mesh->face(mesh->faces, i, &n_corners);
        for (size_t c = 2; c < n_corners; c++) {
            const size_t corners[3] = {face[0], face[swapped ? c : c - 1], face[swapped ? c - 1 : c]};
            for (size_t k = 0; k < 3; k++) { /* beyond its mesh: beyond ours, too, which check() says */
                g->out->indices[3 * g->triangles + k] =
                    corners[k] < mesh->n_vertices ? (uint32_t)(base + corners[k]) : UINT32_MAX;
            }
            g->triangles++;
        }
    }
    g->vertices += mesh->n_vertices;
}

koksma_status koksma__file_mesh_take(const koksma__file_mesh *mesh, bool mirrored, koksma__mesh *out)
{
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    koksma__gatherer g = {.out = out, .mirrored = mirrored};
    const koksma_status status =
        koksma__mesh_init(mesh->n_vertices, koksma__file_triangles(mesh), mesh->normals, mesh->uvs, out);
    if (status) {
        return status;
    }
    koksma__gather_append(&g, mesh, identity);
    return koksma__mesh_check(out);
}
