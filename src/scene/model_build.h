/* SPDX-License-Identifier: Apache-2.0 */
/* A mesh file on its way into a scene, or into one mesh. mesh_assimp.c, the only one that knows assimp, tells what is
   in the file as plain data; mesh_gather.c makes triangles of it, model_build.c materials, placements, a camera and
   lights. */
#ifndef KOKSMA_SCENE_MODEL_BUILD_H
#define KOKSMA_SCENE_MODEL_BUILD_H

#include "scene/scene.h"

/* Vertices have three numbers, also texture coordinates; NULL: none. */
typedef struct koksma__file_mesh {
    unsigned number, material;
    size_t n_vertices, n_faces;
    const float *positions, *normals, *uvs;
    const void *faces;
    const unsigned *(*face)(const void *faces, size_t i, size_t *n_corners);
} koksma__file_mesh;

/* A mesh where a node places it. */
typedef void (*koksma__file_visitor)(void *context, const koksma__file_mesh *mesh, const double matrix[12]);

/* `name` is that of a file beside the model, or, `within`, of one that the model holds: in so many bytes, or in a way
   that we don't read (bytes is NULL). */
typedef struct koksma__file_texture {
    const char *name; /* NULL: there is none */
    bool within;
    const unsigned char *bytes;
    size_t size;
} koksma__file_texture;

/* Textures are to be multiplied with the numbers before them. */
typedef struct koksma__file_material {
    float colour[3], glow[3], metallic, roughness;
    koksma__file_texture colour_map, glow_map;
    bool see_through;
} koksma__file_material;

/* ---- mesh_gather.c ------------------------------------------------------------------------------------------ */

/* Two passes over all that becomes one mesh: the first counts, the second fills `out` from vertex and triangle 0 on.
 */
typedef struct koksma__gatherer {
    koksma__mesh *out;
    size_t vertices, triangles;
    bool normals, uvs; /* all have them; true before the first pass */
    bool mirrored;     /* turned inside out beside what the matrices do */
} koksma__gatherer;

void koksma__gather_count(void *gatherer, const koksma__file_mesh *mesh, const double matrix[12]);
void koksma__gather_append(void *gatherer, const koksma__file_mesh *mesh, const double matrix[12]);

size_t koksma__file_triangles(const koksma__file_mesh *mesh);

/* Whether it swaps left and right: then it turns counterclockwise triangles into clockwise ones. */
bool koksma__matrix_mirrors(const double matrix[12]);

/* That mesh alone, as it stands in the file, checked; mirrored: for placements that mirror it, so with two corners of
   each triangle swapped and normals turned round. Errors: MALFORMED, MEMORY. */
koksma_status koksma__file_mesh_take(const koksma__file_mesh *mesh, bool mirrored, koksma__mesh *out);

/* ---- model_build.c ------------------------------------------------------------------------------------------ */

typedef struct koksma__build {
    koksma_scene *scene;
    const char *path;
    koksma__gltf gltf;
    int (*meshes)[2];     /* the scene's, by the file's numbers, and mirrored; -1: not yet */
    double (*glows)[3];   /* by material */
    koksma_status status; /* of the materials and placements so far */
} koksma__build;

/* Room for so many; fini also after a failure. Errors: MALFORMED (too many), MEMORY. */
koksma_status koksma__build_init(koksma__build *build, size_t n_materials, size_t n_meshes);
void koksma__build_fini(koksma__build *build);

/* The next material. */
void koksma__build_material(koksma__build *build, const koksma__file_material *from);

/* One grey material, for a file that has none. */
void koksma__build_grey(koksma__build *build);

/* Does nothing after one that failed. Errors, in build->status: MALFORMED, MEMORY. */
void koksma__build_placement(void *build, const koksma__file_mesh *mesh, const double matrix[12]);

/* The file's camera; false: there is none, or it sees nothing. */
bool koksma__build_camera(koksma__build *build);

/* Errors: MALFORMED, MEMORY. */
koksma_status koksma__build_lights(koksma__build *build);

#endif
