/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Opens mesh files with the reader for the ending of their name, and joins the contents of a file into one mesh: the
 * file's meshes one after the other, each transformed by its placement. A file with one mesh placed once at the
 * identity, as PLY files are, becomes the result without a copy. The result has normals (or texture
 * coordinates) if all its parts have them.
 */
#include <stdlib.h>
#include <string.h>

#include "core/hash.h"
#include "core/status.h"
#include "meshes/readers.h"

/* ---- Readers -------------------------------------------------------------------------------- */

/* Checks a file's first bytes: PLY and binary glTF begin with "ply" and "glTF"; all other files must be text. */
static koksma_status check_start(const unsigned char *bytes, size_t size)
{
    const bool binary = size >= 4 && (!memcmp(bytes, "glTF", 4) || !memcmp(bytes, "ply", 3));
    return binary ? KOKSMA_OK : koksma__check_text(bytes, size);
}

static koksma_status check_gzip(const unsigned char *bytes, size_t size)
{
    KOKSMA__FAIL_IF(size < 2 || bytes[0] != 0x1F || bytes[1] != 0x8B, KOKSMA_MALFORMED,
                    "not 1F 8B, with which gzip files begin");
    return KOKSMA_OK;
}

/* The reader for an ending of a file's name. The hash of a model's scene is the sum of the hashes of its files, with
   the model's own hash counted `times` times: stored studies find their scenes by this hash, and earlier versions
   read the file that many times. `times` is changed when a change of the code makes another scene from the same
   files: for glTF it was 5 until the gamma of its images was ignored. */
typedef struct reader {
    const char *ending;
    koksma_status (*read)(const unsigned char *bytes, size_t size, koksma__mesh_file *out);
    koksma__check_start *check;
    uint64_t times;
    bool is_packed; /* by gzip */
} reader;

static const reader readers[] = {{".obj", koksma__obj_read, check_start, 3, false},
                                 {".ply", koksma__ply_read, check_start, 3, false},
                                 {".ply.gz", koksma__ply_read, check_gzip, 1, true},
                                 {".gltf", koksma__gltf_read, check_start, 6, false},
                                 {".glb", koksma__gltf_read, check_start, 6, false},
                                 {".serialized", koksma__serialized_read, koksma__serialized_start, 1, false}};

static const reader *find_reader(const char *path)
{
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++) {
        const size_t ending = strlen(readers[i].ending);
        if (length >= ending && !strcmp(path + length - ending, readers[i].ending)) {
            return &readers[i];
        }
    }
    return NULL;
}

bool koksma__is_mesh_file(const char *path)
{
    return find_reader(path) != NULL;
}

/* Replaces the bytes of a gzip file by the decompressed bytes; `out` owns both. */
static koksma_status unpack(const unsigned char **bytes, size_t *size, koksma__mesh_file *out)
{
    unsigned char *unpacked = NULL;
    const koksma_status status =
        koksma__inflate_all(*bytes, *size, (size_t)koksma__file_most(KOKSMA__FILE_MESH), &unpacked, size);
    KOKSMA__TRY(status ? koksma__fail_in(status, out->path) : koksma__file_keep(out, unpacked));
    *bytes = unpacked;
    return *size ? KOKSMA_OK : koksma__fail(KOKSMA_MALFORMED, "%s: empty", out->path);
}

/* Reads the file; out->path and out->sizes must be set. hashed: also computes out->hash, which takes as long as reading
   a binary file; otherwise out->hash is not set. */
static koksma_status read_meshes(koksma__named by, bool hashed, koksma__mesh_file *out)
{
    const char *path = out->path;
    unsigned char *read = NULL;
    size_t size = 0;
    const reader *how = find_reader(path);
    KOKSMA__FAIL_IF(!how, KOKSMA_MALFORMED,
                    "%s: a mesh file's name ends in .obj, .ply, .ply.gz, .gltf, .glb or .serialized", path);
    KOKSMA__TRY(koksma__file_count(out->sizes, path));
    KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_MESH, by, how->check, &read, &size));
    KOKSMA__TRY(koksma__file_keep(out, read));
    const unsigned char *bytes = read;
    KOKSMA__FAIL_IF(!size, KOKSMA_MALFORMED, "%s: empty", path);
    out->hash = hashed ? how->times * koksma__hash(bytes, size) : 0;
    KOKSMA__TRY(how->is_packed ? unpack(&bytes, &size, out) : KOKSMA_OK);
    return how->read(bytes, size, out);
}

koksma_status koksma__mesh_file_read(const char *path, koksma__named by, koksma__mesh_file *out)
{
    *out = (koksma__mesh_file){.path = path};
    return read_meshes(by, true, out);
}

/* ---- One mesh ------------------------------------------------------------------------------- */

/* Appends vertices transformed by matrix, and normals transformed by its inverse transpose; `sign` cancels the sign
   of the determinant. */
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
    if (out->corners) {
        memcpy(out->corners + 2 * out->n_vertices, from->corners, 2 * from->n_vertices * sizeof *from->corners);
    }
}

/* Appends a mesh after the vertices and triangles of out, which has capacity for it. */
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
    bool normals = true, uvs = true, corners = true;
    for (size_t i = 0; i < f->placements.n; i++) {
        const koksma__mesh *mesh = &koksma__file_mesh_at(f, koksma__file_placement_at(f, i)->mesh)->mesh;
        n_vertices += mesh->n_vertices;
        n_triangles += mesh->n_triangles;
        normals &= mesh->normals != NULL;
        uvs &= mesh->uvs != NULL;
        corners &= mesh->corners != NULL;
    }
    KOKSMA__TRY(koksma__mesh_init(n_vertices, n_triangles, normals, uvs, out));
    KOKSMA__TRY(corners ? koksma__mesh_init_corners(out) : KOKSMA_OK);
    out->n_vertices = out->n_triangles = 0;
    for (size_t i = 0; i < f->placements.n; i++) {
        const koksma__file_placement *p = koksma__file_placement_at(f, i);
        append(&koksma__file_mesh_at(f, p->mesh)->mesh, p->matrix, out);
    }
    return KOKSMA_OK;
}

koksma_status koksma__mesh_read(const char *path, koksma__named by, koksma__file_sizes *sizes, koksma__mesh *out)
{
    koksma__mesh_file f = {.path = path, .sizes = sizes};
    koksma_status status = read_meshes(by, false, &f);
    if (!status) {
        const koksma__file_placement *first = f.placements.items;
        if (f.placements.n == 1 && !memcmp(first->matrix, koksma__identity_matrix, sizeof koksma__identity_matrix)) {
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
