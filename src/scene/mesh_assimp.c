/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Long because only one file may include assimp, and this is meshes, materials, cameras and lights.
 *
 * Mesh files by assimp's C interface, in builds that have it. It gets its files from memory through us, so that what
 * it opens is a plain file of bounded size; what comes back is checked (koksma__mesh_check). assimp is C++ of many
 * authors: a file made to harm may still harm it, which is why the program never opens one that it wasn't told to.
 */
#include "scene/model.h"

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
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "core/hash.h"
#include "core/read_file.h"
#include "image/formats.h"
#include "scene/parse.h"
#include "scene/vector.h"

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

/* What assimp took: a sum of the hashes of all files, materials' too, and what was wrong with one of these. */
typedef struct taken {
    uint64_t hash;
    koksma_status status;
} taken;

static bool ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), end = strlen(ending);
    return length >= end && !strcmp(path + length - end, ending);
}

/* io->UserData: taken. */
static struct aiFile *open_proc(struct aiFileIO *io, const char *path, const char *mode)
{
    taken *all = (taken *)(void *)io->UserData;
    open_file *f = strchr(mode, 'r') && is_plain(path) ? calloc(1, sizeof *f) : NULL;
    if (f && koksma__read_file(path, KOKSMA__MAX_MESH_FILE, &f->bytes, &f->size)) {
        free(f);
        f = NULL;
    }
    if (f && ends_in(path, ".mtl") && koksma__mtl_check(path, f->bytes, f->size)) {
        all->status = KOKSMA_MALFORMED;
        free(f->bytes);
        free(f);
        f = NULL;
    }
    if (!f) {
        return NULL;
    }
    all->hash += koksma__hash(f->bytes, f->size);
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

/* What must be known of a file before assimp reads it. */
static koksma_status look_first(const char *path, koksma__gltf *gltf)
{
    unsigned char *bytes;
    size_t size;
    koksma_status status = koksma__read_file(path, KOKSMA__MAX_MESH_FILE, &bytes, &size);
    if (status) {
        return status;
    }
    if (!size) {
        status = koksma__fail(KOKSMA_MALFORMED, "%s: empty", path);
    } else if (strstr(strrchr(path, '.'), ".gl")) {
        status = koksma__gltf_read(path, bytes, size, gltf);
    } else if (ends_in(path, ".obj")) {
        status = koksma__obj_check(path, bytes, size);
    } else if (ends_in(path, ".off")) {
        status = koksma__off_check(path, bytes, size);
    } else if (ends_in(path, ".ply")) {
        status = koksma__ply_check(path, bytes, size);
    }
    free(bytes);
    return status;
}

/* What assimp makes of a file, which the caller releases; of a glTF file also the rest; and the hash of all bytes
   that it took. */
static koksma_status import(const char *path, koksma__gltf *gltf, const struct aiScene **out, uint64_t *hash)
{
    taken all = {0};
    struct aiFileIO io = {.OpenProc = open_proc, .CloseProc = close_proc, .UserData = (aiUserData)(void *)&all};
    gltf->yfov_rad = 0;
    gltf->n_animations = gltf->n_skins = 0;
    for (int i = 0; i < KOKSMA__GLTF_MATERIALS; i++) {
        gltf->strengths[i] = 1;
    }
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
    const koksma_status status = look_first(path, gltf);
    if (status) {
        return status;
    }
    *out = aiImportFileEx(path, 0, &io);
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

/* Polygons are fans around their first corner: right for convex ones. assimp would cut others well, too, but ends
   the program when a mesh has nothing to cut. */
static size_t count_triangles(const struct aiMesh *m)
{
    size_t n = 0;
    for (unsigned i = 0; i < m->mNumFaces; i++) {
        n += m->mFaces[i].mNumIndices >= 3 ? m->mFaces[i].mNumIndices - 2 : 0;
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
        for (unsigned c = 2; c < face->mNumIndices; c++) {
            const size_t corners[3] = {face->mIndices[0], face->mIndices[c - 1], face->mIndices[c]};
            for (size_t k = 0; k < 3; k++) { /* beyond its mesh: beyond ours, too, which check() says */
                out->indices[3 * g->triangles + k] =
                    corners[k] < m->mNumVertices ? (uint32_t)(base + corners[k]) : UINT32_MAX;
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

typedef struct builder {
    koksma_scene *scene;
    const struct aiScene *from;
    const char *path;
    koksma__gltf gltf;
    int *meshes;        /* of ours, by theirs; -1: not yet */
    double (*glows)[3]; /* by material */
    koksma_status status;
} builder;

static double clamp01(float x)
{
    return x > 0 ? fmin((double)x, 1) : 0;
}

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

/* An image of the file's own (glb), or a file beside it; what we can't read is left out, and the colour is taken. */
static koksma_image *read_texture(const builder *b, const char *name)
{
    char full[KOKSMA__MAX_PATH];
    koksma_image *image = calloc(1, sizeof *image);
    koksma_status status = KOKSMA_MALFORMED;
    const struct aiTexture *own = embedded(b->from, name);
    if (image && own && !own->mHeight) {
        status = koksma__image_read_bytes((const unsigned char *)own->pcData, own->mWidth, image);
    } else if (image && !own && koksma__path_beside(b->path, name, full) && is_plain(full)) {
        status = koksma_image_read(full, image);
    }
    if (status) {
        koksma_image_fini(image);
        free(image);
        return NULL;
    }
    return image;
}

static void read_material(builder *b, unsigned i)
{
    const struct aiMaterial *from = b->from->mMaterials[i];
    koksma__material *m = &b->scene->materials[b->scene->n_materials++];
    struct aiColor4D colour = {0.8f, 0.8f, 0.8f, 1}, glow = {0, 0, 0, 1};
    float metallic = 0, roughness = 1;
    const double strength = i < KOKSMA__GLTF_MATERIALS ? b->gltf.strengths[i] : 1;
    struct aiString file;
    unsigned one = 1;
    if (aiGetMaterialColor(from, AI_MATKEY_BASE_COLOR, &colour)) {
        aiGetMaterialColor(from, AI_MATKEY_COLOR_DIFFUSE, &colour);
    }
    aiGetMaterialColor(from, AI_MATKEY_COLOR_EMISSIVE, &glow);
    aiGetMaterialFloatArray(from, AI_MATKEY_METALLIC_FACTOR, &metallic, &one);
    aiGetMaterialFloatArray(from, AI_MATKEY_ROUGHNESS_FACTOR, &roughness, &one);
    snprintf(m->name, sizeof m->name, "%u", i);
    m->kind = metallic > 0.5f ? KOKSMA__MATERIAL_GGX : KOKSMA__MATERIAL_LAMBERT;
    m->roughness = fmin(fmax((double)roughness, 0.03), 1);
    double *to = m->kind == KOKSMA__MATERIAL_GGX ? m->reflectance : m->albedo[0];
    to[0] = clamp01(colour.r);
    to[1] = clamp01(colour.g);
    to[2] = clamp01(colour.b);
    memcpy(m->albedo[1], m->albedo[0], sizeof m->albedo[0]);
    b->glows[i][0] = (double)glow.r * strength;
    b->glows[i][1] = (double)glow.g * strength;
    b->glows[i][2] = (double)glow.b * strength;
    for (int k = 0; k < 3; k++) {
        b->glows[i][k] = b->glows[i][k] > 0 ? fmin(b->glows[i][k], 1e6) : 0;
    }
    if (m->kind == KOKSMA__MATERIAL_LAMBERT &&
        (!aiGetMaterialTexture(from, aiTextureType_BASE_COLOR, 0, &file, NULL, NULL, NULL, NULL, NULL, NULL) ||
         !aiGetMaterialTexture(from, aiTextureType_DIFFUSE, 0, &file, NULL, NULL, NULL, NULL, NULL, NULL))) {
        m->image = read_texture(b, file.data);
    }
    if (m->image) {
        koksma__material_mean(m);
    }
}

/* One placement of a mesh; the mesh itself at its first. */
static void place_mesh(void *context, const struct aiMesh *mesh, const double matrix[12])
{
    builder *b = context;
    unsigned which = 0;
    koksma__placement *p = NULL;
    if (b->status || !count_triangles(mesh)) {
        return;
    }
    while (b->from->mMeshes[which] != mesh) {
        which++;
    }
    if (b->meshes[which] < 0) {
        koksma__mesh *to = NULL;
        gatherer g = {.normals = mesh->mNormals, .uvs = mesh->mTextureCoords[0]};
        b->status = koksma__scene_add_mesh(b->scene, &to);
        b->status = b->status ? b->status
                              : koksma__mesh_init(mesh->mNumVertices, count_triangles(mesh), g.normals, g.uvs, to);
        if (!b->status) {
            g.out = to;
            append(&g, mesh, identity);
            b->status = koksma__mesh_check(to);
        }
        b->meshes[which] = (int)b->scene->n_meshes - 1;
    }
    b->status = b->status ? b->status : koksma__scene_add_placement(b->scene, &p);
    if (b->status) {
        return;
    }
    const unsigned material = mesh->mMaterialIndex < b->scene->n_materials ? mesh->mMaterialIndex : 0;
    p->mesh = b->meshes[which];
    p->material = (int)material;
    p->smooth = mesh->mNormals != NULL;
    memcpy(p->matrix, matrix, sizeof p->matrix);
    koksma__placement_box(&b->scene->meshes[p->mesh], p);
    for (int k = 0; k < 3; k++) {
        if (!(p->low[k] >= -1e6 && p->high[k] <= 1e6)) {
            b->status = koksma__fail(KOKSMA_MALFORMED, "a node places a mesh beyond 1e6");
        }
    }
    const double *glow = b->glows[material];
    if (!b->status && (glow[0] > 0 || glow[1] > 0 || glow[2] > 0)) {
        p->smooth = false;
        b->status = koksma__scene_add_glow(b->scene, p, glow);
    }
    if (!b->status && b->scene->materials[material].image && !b->scene->meshes[p->mesh].uvs) {
        b->status = koksma__fail(KOKSMA_MALFORMED, "a mesh with a texture has no texture coordinates");
    }
}

/* The matrix of the node of this name; false: there is none. */
static bool find_node(const struct aiNode *node, const char *name, const double parent[12], int depth, double out[12])
{
    double matrix[12];
    node_matrix(node, parent, matrix);
    if (!strcmp(node->mName.data, name)) {
        memcpy(out, matrix, sizeof matrix);
        return true;
    }
    for (unsigned i = 0; depth < MAX_DEPTH && i < node->mNumChildren; i++) {
        if (find_node(node->mChildren[i], name, matrix, depth + 1, out)) {
            return true;
        }
    }
    return false;
}

static void transform(const double m[12], const struct aiVector3D *v, double w, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] =
            m[4 * k] * (double)v->x + m[4 * k + 1] * (double)v->y + m[4 * k + 2] * (double)v->z + w * m[4 * k + 3];
    }
}

static bool within(const double v[3], double bound)
{
    return fabs(v[0]) <= bound && fabs(v[1]) <= bound && fabs(v[2]) <= bound;
}

/* Only glTF has cameras: at the origin of their node, looking down its -z. What assimp says besides differs by
   version: 5.2 adds the node's translation once more, and has other angles. */
static bool read_camera(const builder *b)
{
    static const struct aiVector3D origin = {0, 0, 0}, ahead = {0, 0, -1}, over = {0, 1, 0};
    const struct aiCamera *c = b->from->mNumCameras ? b->from->mCameras[0] : NULL;
    double matrix[12], eye[3], forward[3], up[3];
    if (!c || !find_node(b->from->mRootNode, c->mName.data, identity, 0, matrix)) {
        return false;
    }
    transform(matrix, &origin, 1, eye);
    transform(matrix, &ahead, 0, forward);
    transform(matrix, &over, 0, up);
    const double fov = b->gltf.yfov_rad;
    return within(eye, 1e6) && within(forward, 1e6) && within(up, 1e6) && fov > 2e-4 && fov < 3.1 &&
           koksma__camera_aim(eye, forward, up, fov, &b->scene->camera);
}

static koksma_status read_light(const builder *b, const struct aiLight *from)
{
    double matrix[12];
    koksma__light *to = NULL;
    const float colour[3] = {from->mColorDiffuse.r, from->mColorDiffuse.g, from->mColorDiffuse.b};
    const bool far_away = from->mType == aiLightSource_DIRECTIONAL;
    if ((!far_away && from->mType != aiLightSource_POINT && from->mType != aiLightSource_SPOT) ||
        !find_node(b->from->mRootNode, from->mName.data, identity, 0, matrix)) {
        return KOKSMA_OK; /* of a kind that we have none of */
    }
    const koksma_status status = koksma__scene_add_light(b->scene, &to);
    if (status) {
        return status;
    }
    to->kind = far_away ? KOKSMA__LIGHT_DIRECTIONAL : KOKSMA__LIGHT_POINT;
    transform(matrix, &from->mPosition, 1, to->centre);
    transform(matrix, &from->mDirection, 0, to->normal);
    for (int k = 0; k < 3; k++) {
        to->radiance[k] = colour[k] > 0 ? fmin((double)colour[k], 1e6) : 0;
    }
    if (!within(to->centre, 1e6) || (far_away && !koksma__normalise(to->normal))) {
        return koksma__fail(KOKSMA_MALFORMED, "light '%s' is beyond 1e6 or leads nowhere", from->mName.data);
    }
    return KOKSMA_OK;
}

static koksma_status build(builder *b, bool *has_camera)
{
    const struct aiScene *from = b->from;
    if (from->mNumMaterials > KOKSMA__MAX_MATERIALS - 1) {
        return koksma__fail(KOKSMA_MALFORMED, "more than %d materials", KOKSMA__MAX_MATERIALS - 1);
    }
    b->meshes = malloc((from->mNumMeshes + 1) * sizeof *b->meshes);
    b->glows = calloc(from->mNumMaterials + 1, sizeof *b->glows);
    if (!b->meshes || !b->glows) {
        return koksma__fail_memory((from->mNumMeshes + 1) * sizeof *b->meshes);
    }
    for (unsigned i = 0; i < from->mNumMeshes; i++) {
        b->meshes[i] = -1;
    }
    for (unsigned i = 0; i < from->mNumMaterials; i++) {
        read_material(b, i);
    }
    if (!from->mNumMaterials) {
        b->scene->n_materials = 1; /* grey */
        for (int i = 0; i < 6; i++) {
            b->scene->materials[0].albedo[i / 3][i % 3] = 0.8;
        }
    }
    if (!from->mRootNode || !walk(from, from->mRootNode, identity, 0, place_mesh, b)) {
        return koksma__fail(KOKSMA_MALFORMED, "nodes are nested too deeply, or name a mesh that is not there");
    }
    if (!b->status && !b->scene->n_placements) {
        return koksma__fail(KOKSMA_MALFORMED, "no triangles");
    }
    *has_camera = read_camera(b);
    for (unsigned i = 0; !b->status && i < from->mNumLights; i++) {
        b->status = read_light(b, from->mLights[i]);
    }
    return b->status;
}

koksma_status koksma__model_read(const char *path, koksma_scene *scene, bool *has_camera)
{
    builder b = {.scene = scene, .path = path};
    koksma_status status = import(path, &b.gltf, &b.from, &scene->hash);
    if (!status) {
        scene->n_animations = b.gltf.n_animations;
        scene->n_skins = b.gltf.n_skins;
        status = build(&b, has_camera);
        free(b.meshes);
        free(b.glows);
        aiReleaseImport(b.from);
        status = status ? koksma__fail_in(status, path) : KOKSMA_OK;
    }
    return status;
}

#endif
