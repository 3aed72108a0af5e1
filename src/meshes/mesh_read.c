/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A mesh file as one mesh: its meshes one after the other, each where its nodes place it. A file of one mesh that is
 * placed once at the identity, as all but glTF and OBJ files are, is handed over without a copy. The mesh has normals
 * (texture coordinates) where all its parts have them.
 */
#include <math.h>
#include <string.h>

#include "core/status.h"
#include "meshes/mesh_file.h"

static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

bool koksma__matrix_mirrors(const double m[12])
{
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
               m[2] * (m[4] * m[9] - m[5] * m[8]) <
           0;
}

/* x -> matrix x for a vertex, and for a normal by the inverse transposed; sign undoes the determinant's. */
static void append_vertices(const koksma__mesh *from, const double matrix[12], koksma__mesh *out)
{
    const double sign = koksma__matrix_mirrors(matrix) ? -1 : 1;
    double turn[9];
    koksma__normal_matrix(matrix, turn);
    for (size_t i = 0; i < 3 * from->n_vertices; i++) {
        const double *row = matrix + 4 * (i % 3), *turned = turn + 3 * (i % 3);
        const float *v = from->vertices + (i - i % 3), *n = out->normals ? from->normals + (i - i % 3) : v;
        out->vertices[3 * out->n_vertices + i] =
            (float)(row[0] * (double)v[0] + row[1] * (double)v[1] + row[2] * (double)v[2] + row[3]);
        if (out->normals) {
            out->normals[3 * out->n_vertices + i] =
                (float)(sign * (turned[0] * (double)n[0] + turned[1] * (double)n[1] + turned[2] * (double)n[2]));
        }
    }
    if (out->uvs) {
        memcpy(out->uvs + 2 * out->n_vertices, from->uvs, 2 * from->n_vertices * sizeof *from->uvs);
    }
}

/* Behind the vertices and triangles that out has; there is room. */
static void append(const koksma__mesh *from, const double matrix[12], koksma__mesh *out)
{
    const bool swapped = koksma__matrix_mirrors(matrix);
    append_vertices(from, matrix, out);
    for (size_t i = 0; i < 3 * from->n_triangles; i++) {
        const size_t k = i % 3, corner = swapped && k ? 3 - k : k;
        out->indices[3 * out->n_triangles + i] = (uint32_t)out->n_vertices + from->indices[i - k + corner];
    }
    out->n_vertices += from->n_vertices;
    out->n_triangles += from->n_triangles;
}

static koksma_status join(const koksma__mesh_file *f, koksma__mesh *out)
{
    size_t n_vertices = 0, n_triangles = 0;
    bool normals = true, uvs = true;
    for (size_t i = 0; i < f->placements.n; i++) {
        const koksma__mesh *mesh = &koksma__file_mesh_at(f, koksma__file_placement_at(f, i)->mesh)->mesh;
        n_vertices += mesh->n_vertices;
        n_triangles += mesh->n_triangles;
        normals &= mesh->normals != NULL;
        uvs &= mesh->uvs != NULL;
    }
    const koksma_status status = koksma__mesh_init(n_vertices, n_triangles, normals, uvs, out);
    if (status) {
        return status;
    }
    out->n_vertices = out->n_triangles = 0;
    for (size_t i = 0; i < f->placements.n; i++) {
        const koksma__file_placement *p = koksma__file_placement_at(f, i);
        append(&koksma__file_mesh_at(f, p->mesh)->mesh, p->matrix, out);
    }
    return KOKSMA_OK;
}

koksma_status koksma__mesh_read(const char *path, koksma__mesh *out)
{
    koksma__mesh_file f;
    koksma_status status = koksma__mesh_file_read(path, &f);
    if (!status) {
        const koksma__file_placement *first = f.placements.items;
        if (f.placements.n == 1 && !memcmp(first->matrix, identity, sizeof identity)) {
            koksma__mesh *mesh = &koksma__file_mesh_at(&f, first->mesh)->mesh;
            memcpy(mesh->name, out->name, sizeof mesh->name);
            *out = *mesh;
            *mesh = (koksma__mesh){0};
        } else {
            status = join(&f, out);
        }
        status = status ? status : koksma__mesh_check(out);
        status = status ? koksma__fail_in(status, path) : KOKSMA_OK;
    }
    koksma__mesh_file_fini(&f);
    return status;
}
