/* SPDX-License-Identifier: Apache-2.0 */
/* The contents of a mesh file as plain data: meshes, materials, their placements by nodes, lights and a camera. The
   readers (mesh_obj.c, mesh_mtl.c, mesh_ply.c, mesh_serialized.c, gltf*.c) fill it in one pass over the file;
   scene/model.c builds a scene from it, koksma__mesh_read() a single mesh. */
#ifndef KOKSMA_MESHES_MESH_FILE_H
#define KOKSMA_MESHES_MESH_FILE_H

#include "core/files.h"
#include "meshes/mesh.h"
#include "meshes/names.h"

enum { KOKSMA__FILE_KEY = 64 }; /* size of the text of koksma__file_key */

/* The length of files on the disk; each counts once, under whatever names. Zeroed at first. */
typedef struct koksma__file_sizes {
    koksma__names known; /* by koksma__file_key; the caller calls koksma__names_fini */
    uint64_t bytes;
} koksma__file_sizes;

/* An array whose capacity doubles when it is full. */
typedef struct koksma__list {
    void *items;
    size_t n, capacity;
} koksma__list;

/* Adds `more` zeroed items at the list's end and returns the first; the pointer is valid until the next call. When
   memory runs out it returns NULL and sets the error's text. */
void *koksma__list_add(koksma__list *list, size_t more, size_t item_size);

/* Reserves capacity for `more` items after the list's end. When memory runs out it returns false and sets the error's
   text. */
bool koksma__list_reserve(koksma__list *list, size_t more, size_t item_size);

/* A texture that a material names: a file beside the model, or, if `within`, bytes inside the model. */
typedef struct koksma__file_texture {
    char *name; /* owned; NULL: there is no texture */
    bool within;
    const unsigned char *bytes; /* NULL if the model stores the image in a way that is not supported */
    size_t size;
    bool moved, nearest; /* moved: the image is looked up at matrix (u, v, 1), with v upwards, in place of (u, v) */
    float matrix[6], scale;
    /* glTF's wrap modes along u and v: 0 or 10497 repeat, 33071 clamp to the edge, 33648 mirrored repeat */
    int wrap[2];
} koksma__file_texture;

/* A material as the file describes it. The texels of colour_map are multiplied by `colour`, those of glow_map by
   `glow`. */
typedef struct koksma__file_material {
    float colour[3], metallic, roughness;
    double glow[3];
    koksma__file_texture colour_map, glow_map;
    bool see_through; /* the material has a transparency that is not supported */
    /* principled: a material of glTF, with metallic and roughness values and further textures */
    /* blends: alpha and the transparency of colour_map apply; tinted: vertex colours apply */
    bool principled, blends, tinted;
    bool two_sided;            /* the back is seen, and emits, like the front */
    double ior, alpha, cutoff; /* cutoff 0: alpha is the fraction of the rays that meet the surface */
    koksma__file_texture surface_map, normal_map;
} koksma__file_material;

/* A mesh in its file's coordinates, not checked yet, and the index of its material. */
typedef struct koksma__file_mesh {
    koksma__mesh mesh;
    size_t material;
} koksma__file_mesh;

/* A placement of mesh number `mesh` by matrix. */
typedef struct koksma__file_placement {
    size_t mesh;
    double matrix[12];
} koksma__file_placement;

/* A light at a node: a point at the node's origin; or, if is_spot, a spot that shines along the node's -z; or, if
   far_away, parallel light along the node's -z. */
typedef struct koksma__file_light {
    bool far_away, is_spot;
    double outer, inner;          /* half-angles of a spot's cone, in radians */
    double colour[3], matrix[12]; /* colour times intensity; the node's world matrix */
} koksma__file_light;

typedef struct koksma__mesh_file {
    const char *path;
    koksma__file_sizes *sizes; /* NULL, or counts the model and its buffers */
    /* sum of the hashes of all files read: the model's as often as mesh_read.c explains, those that it names once, three
       times, five times, ..., so that their order counts */
    uint64_t hash;
    size_t n_named; /* the number of files that it names and that were read */
    koksma__list meshes, materials, placements, lights;
    size_t n_vertices, n_triangles; /* numbers of vertices and of triangles in all meshes together */
    double yfov_rad, camera[12];    /* the camera; yfov_rad 0: there is none */
    koksma__unread unread;
    koksma__unknown *unknown; /* names that the format does not have; the caller may take the list */
    size_t n_unknown;
    koksma__list owned; /* blocks of memory that hold textures' bytes */
} koksma__mesh_file;

/* Adds the bytes of a file that the model names to its hash. */
void koksma__mesh_file_hash(koksma__mesh_file *file, const unsigned char *bytes, size_t size);

/* Frees all that the file owns. */
void koksma__mesh_file_fini(koksma__mesh_file *file);

/* Return the item with index i. */
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

/* Appends a mesh; the file owns it from now on, even after a failure. The limit on the vertices and on the triangles
   of one mesh (mesh.h) is also the limit for all meshes of the file together, so that a small file that names a mesh
   many times can't fill the memory. Errors: MALFORMED (over the limit), MEMORY. */
koksma_status koksma__file_take_mesh(koksma__mesh_file *f, koksma__mesh *mesh, size_t material);

/* Adds a placement. Errors: MALFORMED (over 2^20), MEMORY. */
koksma_status koksma__file_add_placement(koksma__mesh_file *f, size_t mesh, const double *matrix);

/* Adds a Lambert material of this grey. *out is valid until the next call. Errors: MEMORY. */
koksma_status koksma__file_add_material(koksma__mesh_file *f, float grey, koksma__file_material **out);

/* The number in these bytes, 8 at most. */
static inline uint64_t koksma__bits_at(const unsigned char *at, size_t bytes, bool big_endian)
{
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; i++) {
        value |= (uint64_t)at[big_endian ? bytes - 1 - i : i] << 8 * i;
    }
    return value;
}

/* Frees a block of memory with the file, or at once after an error. Errors: MEMORY. */
koksma_status koksma__file_keep(koksma__mesh_file *f, unsigned char *bytes);

/* Whether the path exists and is not a folder; koksma__read_file rejects everything but plain files. */
bool koksma__is_file(const char *path);

/* Writes a text that is the same for all names of a file: its device and inode. It is empty if there is no such file. */
void koksma__file_key(const char *path, char out[KOKSMA__FILE_KEY]);

/* Adds the length of a file, which need not exist, unless it was counted before. sizes may be NULL. Errors: MEMORY. */
koksma_status koksma__file_count(koksma__file_sizes *sizes, const char *path);

/* Finds the file beside the model that a model names: by the exact name, or with %20 and other escapes decoded (names
   in glTF are URIs, see RFC 3986, section 2.1), or with \ replaced by / (OBJ files from Windows). Returns false if
   there is no such file. A folder is found as well, so that opening it says what is wrong. */
bool koksma__find_named(const char *model, const char *name, char out[KOKSMA__MAX_PATH]);

/* ---- Whole files ---- */

/* Whether a file's name has the ending of a mesh file (.obj .ply .ply.gz .gltf .glb .serialized). */
bool koksma__is_mesh_file(const char *path);

/* Reads a mesh file and the files that it names. The caller must call koksma__mesh_file_fini even after an error.
   Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__mesh_file_read(const char *path, koksma__named by, koksma__mesh_file *out);

/* Reads all triangles of a mesh file as one checked mesh. sizes: NULL, or counts the files that were read. out must be
   zeroed except for its name. Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__mesh_read(const char *path, koksma__named by, koksma__file_sizes *sizes, koksma__mesh *out);

#endif
