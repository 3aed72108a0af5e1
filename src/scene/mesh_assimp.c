/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Mesh files by assimp's C interface, in builds that have it. It gets its files from memory through us, so that what
 * it opens is a plain file of bounded size; what comes back is checked (koksma__mesh_check). assimp is C++ of many
 * authors: a file made to harm may still harm it, which is why the program never opens one that it wasn't told to.
 */
#include "scene/model.h"

#include <koksma/render.h>

#include "core/status.h"

#ifndef KOKSMA_ASSIMP

koksma_status koksma__model_read(const char *path, koksma_scene *scene, bool *has_camera)
{
    (void)scene;
    (void)has_camera;
    return koksma__mesh_read(path, NULL);
}

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
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/hash.h"
#include "core/read_file.h"
#include "meshes/mesh_file.h"
#include "scene/model_build.h"

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
    const unsigned char *bytes;
    unsigned char *owned; /* the same, or NULL: they are the model's */
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

/* What assimp took: the model, a sum of the hashes of all files, materials' too, and what was wrong with one of
   these. */
typedef struct taken {
    const char *model;
    const koksma__mesh_source *source;
    uint64_t hash;
    koksma_status status;
} taken;

/* io->UserData: taken. After a file that is there and can't be read no other is opened: without materials, say, it
   would be another scene. */
static struct aiFile *open_proc(struct aiFileIO *io, const char *name, const char *mode)
{
    taken *all = (taken *)(void *)io->UserData;
    char path[KOKSMA__MAX_PATH];
    uint64_t hash = all->source->hash;
    koksma__bytes part = {0};
    const bool own = !strcmp(name, all->model);
    if (all->status || !strchr(mode, 'r') || (!own && !koksma__find_part(all->model, name, path))) {
        return NULL;
    }
    all->status = own ? KOKSMA_OK : koksma__mesh_part_open(path, &part, &hash);
    open_file *f = all->status ? NULL : calloc(1, sizeof *f);
    if (!f) {
        all->status = all->status ? all->status : koksma__fail_memory(sizeof *f);
        free(part.data);
        return NULL;
    }
    all->hash += hash;
    f->owned = part.data;
    f->bytes = own ? all->source->bytes.data : part.data;
    f->size = own ? all->source->bytes.size : part.size;
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
        free(f->owned);
        free(f);
    }
}

/* What assimp makes of a file, which the caller releases; what it doesn't tell of it; and the hash of all bytes that
   it took. */
static koksma_status import(const char *path, koksma__gltf *gltf, const struct aiScene **out, uint64_t *hash)
{
    koksma__mesh_source source;
    taken all = {.model = path, .source = &source};
    struct aiFileIO io = {.OpenProc = open_proc, .CloseProc = close_proc, .UserData = (aiUserData)(void *)&all};
    const koksma_status status = koksma__mesh_file_open(path, &source);
    if (status) {
        return status;
    }
    *gltf = source.gltf;
    *out = aiImportFileEx(path, 0, &io);
    free(source.bytes.data);
    *hash = all.hash;
    if (all.status) { /* its text is still there */
        aiReleaseImport(*out);
        *out = NULL;
        return all.status;
    }
    if (!*out) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: %s", path, aiGetErrorString());
    }
    return KOKSMA_OK;
}

/* ---- Meshes ------------------------------------------------------------------------------------------------- */

static void node_matrix(const struct aiNode *node, const double parent[12], double out[12])
{
    const struct aiMatrix4x4 *m = &node->mTransformation;
    const double own[12] = {(double)m->a1, (double)m->a2, (double)m->a3, (double)m->a4, (double)m->b1, (double)m->b2,
                            (double)m->b3, (double)m->b4, (double)m->c1, (double)m->c2, (double)m->c3, (double)m->c4};
    koksma__matrix_multiply(parent, own, out);
}

static const unsigned *face(const void *faces, size_t i, size_t *n_corners)
{
    const struct aiFace *f = (const struct aiFace *)faces + i;
    *n_corners = f->mNumIndices;
    return f->mIndices;
}

_Static_assert(sizeof(struct aiVector3D) == 3 * sizeof(float), "vectors are three floats");

static koksma__file_mesh view(const struct aiScene *scene, unsigned i)
{
    const struct aiMesh *m = scene->mMeshes[i];
    return (koksma__file_mesh){
        .number = i,
        .material = m->mMaterialIndex,
        .n_vertices = m->mNumVertices,
        .positions = (const float *)m->mVertices,
        .normals = (const float *)m->mNormals,
        .uvs = (const float *)m->mTextureCoords[0],
        .n_faces = m->mNumFaces,
        .faces = m->mFaces,
        .face = face,
    };
}

/* Visits every mesh of every node; false when nodes are nested too deeply or name no mesh. */
static bool walk(const struct aiScene *scene, const struct aiNode *node, const double parent[12], int depth,
                 koksma__file_visitor visit, void *context)
{
    double matrix[12];
    node_matrix(node, parent, matrix);
    bool good = depth < MAX_DEPTH;
    for (unsigned i = 0; good && i < node->mNumMeshes; i++) {
        good = node->mMeshes[i] < scene->mNumMeshes;
        if (good) {
            const koksma__file_mesh mesh = view(scene, node->mMeshes[i]);
            visit(context, &mesh, matrix);
        }
    }
    for (unsigned i = 0; good && i < node->mNumChildren; i++) {
        good = walk(scene, node->mChildren[i], matrix, depth + 1, visit, context);
    }
    return good;
}

static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

static koksma_status gather(const struct aiScene *scene, koksma__mesh *out)
{
    koksma__gatherer g = {.out = out, .normals = true, .uvs = true};
    if (!scene->mRootNode || !walk(scene, scene->mRootNode, identity, 0, koksma__gather_count, &g)) {
        return koksma__fail(KOKSMA_MALFORMED, "nodes are nested too deeply, or name a mesh that is not there");
    }
    koksma_status status = koksma__mesh_init(g.vertices, g.triangles, g.normals, g.uvs, out);
    if (!status) {
        g.vertices = g.triangles = 0;
        walk(scene, scene->mRootNode, identity, 0, koksma__gather_append, &g);
        status = koksma__mesh_check(out);
    }
    return status;
}

koksma_status koksma__mesh_read(const char *path, koksma__mesh *out)
{
    const struct aiScene *scene = NULL;
    koksma__gltf idle;
    uint64_t hash;
    koksma_status status = import(path, &idle, &scene, &hash);
    if (!status) {
        status = gather(scene, out);
        aiReleaseImport(scene);
        status = status ? koksma__fail_in(status, path) : KOKSMA_OK;
    }
    return status;
}

/* ---- Whole files as scenes ------------------------------------------------------------------------------- */

typedef struct reader {
    koksma__build build;
    const struct aiScene *from;
} reader;

/* The texture that the file holds under this name ("*3": by its number), or NULL. */
static const struct aiTexture *embedded(const struct aiScene *from, const char *name)
{
    for (unsigned i = 0; i < from->mNumTextures; i++) {
        char number[16];
        snprintf(number, sizeof number, "*%u", i);
        if (!strcmp(name, number) || !strcmp(name, from->mTextures[i]->mFilename.data)) {
            return from->mTextures[i];
        }
    }
    return NULL;
}

static void read_texture(const reader *r, const struct aiMaterial *from, enum aiTextureType type,
                         struct aiString *name, koksma__file_texture *out)
{
    if (aiGetMaterialTexture(from, type, 0, name, NULL, NULL, NULL, NULL, NULL, NULL)) {
        return;
    }
    const struct aiTexture *own = embedded(r->from, name->data);
    out->name = name->data;
    out->within = own != NULL;
    if (own && !own->mHeight) { /* an image file; else its texels */
        out->bytes = (const unsigned char *)own->pcData;
        out->size = own->mWidth;
    }
}

/* By glTF's alphaMode, whose alpha means nothing where it is OPAQUE; else by the opacity. */
static bool is_see_through(const struct aiMaterial *from)
{
    struct aiString mode;
    float opacity = 1;
    unsigned one = 1;
    if (!aiGetMaterialString(from, "$mat.gltf.alphaMode", 0, 0, &mode)) {
        return strcmp(mode.data, "OPAQUE") != 0;
    }
    return !aiGetMaterialFloatArray(from, AI_MATKEY_OPACITY, &opacity, &one) && opacity < 1;
}

static void read_material(reader *r, const struct aiMaterial *from)
{
    koksma__file_material m = {.roughness = 1, .see_through = is_see_through(from)};
    struct aiColor4D colour = {0.8f, 0.8f, 0.8f, 1}, glow = {0, 0, 0, 1};
    struct aiString colour_map, glow_map;
    unsigned one = 1;
    if (aiGetMaterialColor(from, AI_MATKEY_BASE_COLOR, &colour)) {
        aiGetMaterialColor(from, AI_MATKEY_COLOR_DIFFUSE, &colour);
    }
    aiGetMaterialColor(from, AI_MATKEY_COLOR_EMISSIVE, &glow);
    aiGetMaterialFloatArray(from, AI_MATKEY_METALLIC_FACTOR, &m.metallic, &one);
    aiGetMaterialFloatArray(from, AI_MATKEY_ROUGHNESS_FACTOR, &m.roughness, &one);
    memcpy(m.colour, &colour, sizeof m.colour);
    memcpy(m.glow, &glow, sizeof m.glow);
    read_texture(r, from, aiTextureType_BASE_COLOR, &colour_map, &m.colour_map);
    if (!m.colour_map.name) {
        read_texture(r, from, aiTextureType_DIFFUSE, &colour_map, &m.colour_map);
    }
    read_texture(r, from, aiTextureType_EMISSIVE, &glow_map, &m.glow_map);
    koksma__build_material(&r->build, &m);
}

/* Whether the mesh has colours other than white, which changes nothing. */
static bool is_coloured(const struct aiMesh *mesh)
{
    for (unsigned i = 0; mesh->mColors[0] && i < mesh->mNumVertices; i++) {
        const struct aiColor4D c = mesh->mColors[0][i];
        if (c.r != 1 || c.g != 1 || c.b != 1) {
            return true;
        }
    }
    return false;
}

static koksma_status read_all(reader *r, bool *has_camera)
{
    const struct aiScene *from = r->from;
    koksma_status status = koksma__build_init(&r->build, from->mNumMaterials, from->mNumMeshes);
    if (status) {
        return status;
    }
    for (unsigned i = 0; !r->build.status && i < from->mNumMaterials; i++) {
        read_material(r, from->mMaterials[i]);
    }
    if (r->build.status) {
        return r->build.status;
    }
    if (!from->mNumMaterials) {
        koksma__build_grey(&r->build);
    }
    if (!from->mRootNode || !walk(from, from->mRootNode, identity, 0, koksma__build_placement, &r->build)) {
        return koksma__fail(KOKSMA_MALFORMED, "nodes are nested too deeply, or name a mesh that is not there");
    }
    if (!r->build.status && !r->build.scene->n_placements) {
        return koksma__fail(KOKSMA_MALFORMED, "no triangles");
    }
    for (unsigned i = 0; i < from->mNumMeshes; i++) {
        r->build.scene->unread.vertex_colours += is_coloured(from->mMeshes[i]);
    }
    *has_camera = koksma__build_camera(&r->build);
    return r->build.status ? r->build.status : koksma__build_lights(&r->build);
}

koksma_status koksma__model_read(const char *path, koksma_scene *scene, bool *has_camera)
{
    reader r = {.build = {.scene = scene, .path = path}};
    koksma_status status = import(path, &r.build.gltf, &r.from, &scene->hash);
    if (!status) {
        scene->unread = r.build.gltf.unread;
        status = read_all(&r, has_camera);
        koksma__build_fini(&r.build);
        aiReleaseImport(r.from);
        status = status ? koksma__fail_in(status, path) : KOKSMA_OK;
    }
    return status;
}

#endif
