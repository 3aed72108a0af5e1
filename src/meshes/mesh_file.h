/* SPDX-License-Identifier: Apache-2.0 */
/* What a mesh file holds, as plain data: meshes, materials, where nodes place the meshes, lights and a camera. The
   readers (mesh_obj.c, mesh_mtl.c, mesh_off.c, mesh_ply.c, gltf_*.c) fill it in one pass over the file;
   scene/model_build.c makes a scene of it, koksma__mesh_read() one mesh. */
#ifndef KOKSMA_MESHES_MESH_FILE_H
#define KOKSMA_MESHES_MESH_FILE_H

#include "core/read_file.h"
#include "meshes/mesh.h"

/* An array that grows to twice its capacity. */
typedef struct koksma__list {
    void *items;
    size_t n, capacity;
} koksma__list;

/* The first of `more` new items at the list's end, zeroed, until the next call; NULL when memory runs out, which is
   the error's text then. */
void *koksma__list_add(koksma__list *list, size_t more, size_t item_size);

/* Makes room for `more` items behind the list's end; false when memory runs out, which is the error's text then. */
bool koksma__list_reserve(koksma__list *list, size_t more, size_t item_size);

/* A texture that a material names: a file beside the model, or, `within`, bytes that the model holds. */
typedef struct koksma__file_texture {
    char *name; /* owned; NULL: there is no texture */
    bool within;
    const unsigned char *bytes; /* NULL: the model holds it in a way that is not read */
    size_t size;
    bool moved, nearest; /* of texture coordinates with v upwards: at matrix (u, v, 1) */
    float matrix[6], scale;
    int wrap[2]; /* of glTF: 10497 repeated, 33071 held at the edge, 33648 mirrored; 0: repeated */
} koksma__file_texture;

/* Textures are multiplied by colour and glow. */
typedef struct koksma__file_material {
    float colour[3], metallic, roughness;
    double glow[3];
    koksma__file_texture colour_map, glow_map;
    bool see_through; /* it has a transparency that is not read */
    /* of glTF: metal and roughness mix, and there are more textures */
    bool principled, blends, tinted; /* blends: by alpha and the transparency of colour_map; tinted: by vertices */
    double ior, alpha, cutoff;       /* cutoff 0: a share of the rays */
    koksma__file_texture surface_map, normal_map;
} koksma__file_material;

/* A mesh in its file's coordinates, not yet checked, and the number of its material. */
typedef struct koksma__file_mesh {
    koksma__mesh mesh;
    size_t material;
} koksma__file_mesh;

/* Mesh number `mesh` at matrix. */
typedef struct koksma__file_placement {
    size_t mesh;
    double matrix[12];
} koksma__file_placement;

/* A light at a node: a point at its origin, or a spot, which shines down its -z; or, far_away, parallel light down its -z. */
typedef struct koksma__file_light {
    bool far_away, is_spot;
    double outer, inner;          /* angles of a spot's cone, in radians */
    double colour[3], matrix[12]; /* colour times intensity; the node's matrix */
} koksma__file_light;

typedef struct koksma__mesh_file {
    const char *path;
    uint64_t hash; /* the sum of the hashes of all files that were read, as often as stored studies count them */
    koksma__list meshes, materials, placements, lights;
    size_t n_vertices, n_triangles; /* of all meshes */
    double yfov_rad, camera[12];    /* of the camera; yfov_rad 0: there is none */
    koksma__unread unread;
    koksma__list owned; /* blocks of memory that textures' bytes lie in */
} koksma__mesh_file;

/* Frees all that the file owns. */
void koksma__mesh_file_fini(koksma__mesh_file *file);

/* Items by number. */
static inline koksma__file_mesh *koksma__file_mesh_at(const koksma__mesh_file *f, size_t i)
{
    return (koksma__file_mesh *)f->meshes.items + i;
}
static inline koksma__file_material *koksma__file_material_at(const koksma__mesh_file *f, size_t i)
{
    return (koksma__file_material *)f->materials.items + i;
}
static inline koksma__file_placement *koksma__file_placement_at(const koksma__mesh_file *f, size_t i)
{
    return (koksma__file_placement *)f->placements.items + i;
}

/* Appends a mesh; the file owns it from now on, even after a failure. The vertices and triangles of a file's meshes
   together are at most as many as a mesh may have, so that a small file that names one mesh many times can't fill
   the memory. Errors: MALFORMED, MEMORY. */
koksma_status koksma__file_take_mesh(koksma__mesh_file *f, koksma__mesh *mesh, size_t material);

/* One more placement; matrix: NULL for the identity. Errors: MALFORMED (over 2^20), MEMORY. */
koksma_status koksma__file_add_placement(koksma__mesh_file *f, size_t mesh, const double *matrix);

/* One more material: Lambert of this grey. *out holds until the next call. Errors: MEMORY. */
koksma_status koksma__file_add_material(koksma__mesh_file *f, float grey, koksma__file_material **out);

/* Adds a fan of triangles around the polygon's first corner to a list of 3 indices a triangle: exact for convex
   polygons; of a concave one some triangles may reach outside of it or overlap. Errors, which name path: MALFORMED
   (too many triangles), MEMORY. */
koksma_status koksma__fan_add(const char *path, koksma__list *indices, const uint32_t *corners, size_t n);

/* Hands the list's indices over to a mesh without triangles. */
void koksma__fan_finish(koksma__list *indices, koksma__mesh *mesh);

/* Whether there is something that is no folder; koksma__read_file refuses what is no plain file. */
bool koksma__is_file(const char *path);

/* The file beside the model that a model names: as it stands there, or with its %20 and the like decoded (names
   in glTF are URIs: RFC 3986, section 2.1), or with \ taken for / (OBJ files of Windows). false: there is none. */
bool koksma__find_named(const char *model, const char *name, char out[KOKSMA__MAX_PATH]);

#endif
