/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Mesh files by assimp's C interface, in builds that have it. It gets its files from memory through us, so that what
 * it opens is a plain file of bounded size; what comes back is checked (koksma__mesh_check). assimp is C++ of many
 * authors: a file made to harm may still harm it, which is why the program never opens one that it wasn't told to.
 */
#include "scene/mesh.h"

#include <string.h>

#include <koksma/render.h>

#include "core/status.h"

static const char *const endings[] = {".obj", ".ply", ".off", ".gltf", ".glb", NULL};

bool koksma__is_mesh_file(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (int i = 0; dot && endings[i]; i++) {
        if (!strcmp(dot, endings[i])) {
            return true;
        }
    }
    return false;
}

#ifndef KOKSMA_ASSIMP

const char *koksma_mesh_reader(void)
{
    return NULL;
}

koksma_status koksma__mesh_read(const char *path, koksma__mesh *out)
{
    (void)out;
    return koksma__fail(KOKSMA_UNSUPPORTED, "%s: this build reads no mesh files: it was made without assimp", path);
}

#else

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "core/read_file.h"

enum { MAX_DEPTH = 512 /* of nodes */ };

const char *koksma_mesh_reader(void)
{
    static _Thread_local char text[48];
    snprintf(text, sizeof text, "assimp %u.%u.%u", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch());
    return text;
}

/* ---- Files from memory ------------------------------------------------------------------------------------- */

typedef struct open_file {
    struct aiFile file;
    unsigned char *bytes;
    size_t size, at;
} open_file;

static size_t file_read(struct aiFile *file, char *to, size_t size, size_t count)
{
    open_file *f = (open_file *)(void *)file->UserData;
    const size_t left = (f->size - f->at) / (size ? size : 1), n = count < left ? count : left;
    memcpy(to, f->bytes + f->at, size * n);
    f->at += size * n;
    return n;
}

static size_t file_write(struct aiFile *file, const char *from, size_t size, size_t count)
{
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t file_tell(struct aiFile *file)
{
    return ((open_file *)(void *)file->UserData)->at;
}

static size_t file_size(struct aiFile *file)
{
    return ((open_file *)(void *)file->UserData)->size;
}

static void file_flush(struct aiFile *file)
{
    (void)file;
}

static enum aiReturn file_seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    open_file *f = (open_file *)(void *)file->UserData;
    const size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? f->at : f->size;
    if (offset > f->size || from + offset > f->size) { /* from the end: by 0 only */
        return aiReturn_FAILURE;
    }
    f->at = from + offset;
    return aiReturn_SUCCESS;
}

static bool is_plain(const char *path)
{
    struct stat about;
    return !stat(path, &about) && S_ISREG(about.st_mode);
}

static struct aiFile *open_proc(struct aiFileIO *io, const char *path, const char *mode)
{
    (void)io;
    open_file *f = strchr(mode, 'r') && is_plain(path) ? calloc(1, sizeof *f) : NULL;
    if (f && koksma__read_file(path, KOKSMA__MAX_MESH_FILE, &f->bytes, &f->size)) {
        free(f);
        f = NULL;
    }
    if (!f) {
        return NULL;
    }
    f->file = (struct aiFile){.ReadProc = file_read,
                              .WriteProc = file_write,
                              .TellProc = file_tell,
                              .FileSizeProc = file_size,
                              .SeekProc = file_seek,
                              .FlushProc = file_flush,
                              .UserData = (aiUserData)(void *)f};
    return &f->file;
}

static void close_proc(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    if (file) {
        open_file *f = (open_file *)(void *)file->UserData;
        free(f->bytes);
        free(f);
    }
}

/* What assimp makes of a file; the caller releases it. */
static koksma_status import(const char *path, const struct aiScene **out)
{
    struct aiFileIO io = {.OpenProc = open_proc, .CloseProc = close_proc};
    if (!koksma__is_mesh_file(path)) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: a mesh file's name ends in .obj, .ply, .off, .gltf or .glb", path);
    }
    if (!is_plain(path)) {
        unsigned char *bytes = NULL; /* says why not */
        size_t size;
        const koksma_status status = koksma__read_file(path, 1, &bytes, &size);
        free(bytes);
        return status ? status : koksma__fail(KOKSMA_MALFORMED, "%s: no plain file", path);
    }
    *out = aiImportFileEx(path, aiProcess_Triangulate, &io);
    if (!*out) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: %s", path, aiGetErrorString());
    }
    return KOKSMA_OK;
}

/* ---- Meshes ------------------------------------------------------------------------------------------------- */

/* out = a b, rows of four over (0 0 0 1). */
static void multiply(const double a[12], const double b[12], double out[12])
{
    for (int i = 0; i < 12; i++) {
        const double *row = a + 4 * (i / 4);
        const int j = i % 4;
        out[i] = row[0] * b[j] + row[1] * b[4 + j] + row[2] * b[8 + j] + (j == 3 ? row[3] : 0);
    }
}

static void node_matrix(const struct aiNode *node, const double parent[12], double out[12])
{
    const struct aiMatrix4x4 *m = &node->mTransformation;
    const double own[12] = {(double)m->a1, (double)m->a2, (double)m->a3, (double)m->a4, (double)m->b1, (double)m->b2,
                            (double)m->b3, (double)m->b4, (double)m->c1, (double)m->c2, (double)m->c3, (double)m->c4};
    multiply(parent, own, out);
}

static size_t count_triangles(const struct aiMesh *m)
{
    size_t n = 0;
    for (unsigned i = 0; i < m->mNumFaces; i++) {
        n += m->mFaces[i].mNumIndices == 3;
    }
    return n;
}

typedef void visit(void *context, const struct aiMesh *mesh, const double matrix[12]);

/* Calls f for every mesh of every node; false when nodes are nested too deeply or name no mesh. */
static bool walk(const struct aiScene *scene, const struct aiNode *node, const double parent[12], int depth, visit *f,
                 void *context)
{
    double matrix[12];
    node_matrix(node, parent, matrix);
    bool good = depth < MAX_DEPTH;
    for (unsigned i = 0; good && i < node->mNumMeshes; i++) {
        good = node->mMeshes[i] < scene->mNumMeshes;
        if (good) {
            f(context, scene->mMeshes[node->mMeshes[i]], matrix);
        }
    }
    for (unsigned i = 0; good && i < node->mNumChildren; i++) {
        good = walk(scene, node->mChildren[i], matrix, depth + 1, f, context);
    }
    return good;
}

/* What one mesh of a file adds to ours; first a pass that counts (out->vertices is NULL). */
typedef struct gatherer {
    koksma__mesh *out;
    size_t vertices, triangles;
    bool normals, uvs;
} gatherer;

static void count(void *context, const struct aiMesh *m, const double matrix[12])
{
    gatherer *g = context;
    (void)matrix;
    const size_t triangles = count_triangles(m);
    if (triangles) {
        g->vertices += m->mNumVertices;
        g->triangles += triangles;
        g->normals &= m->mNormals != NULL;
        g->uvs &= m->mTextureCoords[0] != NULL;
    }
}

/* The normal's matrix is the inverse transposed; times the determinant it is the cofactors. */
static void turn_normal(const double m[12], const struct aiVector3D *v, float out[3])
{
    for (int r = 0; r < 3; r++) {
        double sum = 0;
        for (int c = 0; c < 3; c++) {
            const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            const double cofactor = m[4 * r1 + c1] * m[4 * r2 + c2] - m[4 * r1 + c2] * m[4 * r2 + c1];
            sum += cofactor * (double)(c == 0 ? v->x : c == 1 ? v->y : v->z);
        }
        out[r] = (float)sum;
    }
}

static void append(void *context, const struct aiMesh *m, const double matrix[12])
{
    gatherer *g = context;
    koksma__mesh *out = g->out;
    if (!count_triangles(m)) {
        return;
    }
    const size_t base = g->vertices;
    for (size_t i = 0; i < m->mNumVertices; i++) {
        const struct aiVector3D *v = &m->mVertices[i];
        for (size_t k = 0; k < 3; k++) {
            const double *row = matrix + 4 * k;
            out->vertices[3 * (base + i) + k] =
                (float)(row[0] * (double)v->x + row[1] * (double)v->y + row[2] * (double)v->z + row[3]);
        }
        if (out->normals) {
            turn_normal(matrix, &m->mNormals[i], out->normals + 3 * (base + i));
        }
        if (out->uvs) {
            out->uvs[2 * (base + i)] = m->mTextureCoords[0][i].x;
            out->uvs[2 * (base + i) + 1] = m->mTextureCoords[0][i].y;
        }
    }
    for (unsigned i = 0; i < m->mNumFaces; i++) {
        const struct aiFace *face = &m->mFaces[i];
        if (face->mNumIndices == 3) {
            for (size_t k = 0; k < 3; k++) {
                const size_t index = face->mIndices[k]; /* beyond its mesh: beyond ours, too, which check() says */
                out->indices[3 * g->triangles + k] = (uint32_t)(index < m->mNumVertices ? base + index : UINT32_MAX);
            }
            g->triangles++;
        }
    }
    g->vertices += m->mNumVertices;
}

static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

static koksma_status gather(const struct aiScene *scene, koksma__mesh *out)
{
    gatherer g = {.out = out, .normals = true, .uvs = true};
    if (!scene->mRootNode || !walk(scene, scene->mRootNode, identity, 0, count, &g)) {
        return koksma__fail(KOKSMA_MALFORMED, "nodes are nested too deeply, or name a mesh that is not there");
    }
    koksma_status status = koksma__mesh_init(g.vertices, g.triangles, g.normals, g.uvs, out);
    if (!status) {
        g.vertices = g.triangles = 0;
        walk(scene, scene->mRootNode, identity, 0, append, &g);
        status = koksma__mesh_check(out);
    }
    return status;
}

koksma_status koksma__mesh_read(const char *path, koksma__mesh *out)
{
    const struct aiScene *scene = NULL;
    koksma_status status = import(path, &scene);
    if (!status) {
        status = gather(scene, out);
        aiReleaseImport(scene);
        status = status ? koksma__fail_in(status, path) : KOKSMA_OK;
    }
    return status;
}

#endif
