/* SPDX-License-Identifier: Apache-2.0 */
/* glTF 2.0 as JSON and buffers. gltf_check.c sees that the parts fit together; gltf_read.c opens the file,
   gltf_materials.c reads its materials, gltf_buffers.c its buffers and accessors, gltf_meshes.c makes meshes of primitives, gltf_nodes.c places
   them, and finds lights and the camera. Here is what these share. */
#ifndef KOKSMA_MESHES_GLTF_H
#define KOKSMA_MESHES_GLTF_H

#include "meshes/mesh_file.h"
#include "json/json.h"

enum { KOKSMA__GLTF_ITEMS = 1 << 20 }; /* of a list */

/* The lists of the root, and their lengths. */
enum {
    KOKSMA__GLTF_BUFFERS,
    KOKSMA__GLTF_VIEWS,
    KOKSMA__GLTF_ACCESSORS,
    KOKSMA__GLTF_MATERIALS,
    KOKSMA__GLTF_CAMERAS,
    KOKSMA__GLTF_SAMPLERS,
    KOKSMA__GLTF_SKINS,
    KOKSMA__GLTF_SCENES,
    KOKSMA__GLTF_IMAGES,
    KOKSMA__GLTF_TEXTURES,
    KOKSMA__GLTF_MESHES,
    KOKSMA__GLTF_NODES,
    KOKSMA__GLTF_LISTS
};

typedef struct koksma__gltf_bytes {
    const unsigned char *bytes; /* NULL: not there */
    size_t size;
} koksma__gltf_bytes;

/* A file on its way. Arrays are by the numbers of the file. */
typedef struct koksma__gltf {
    koksma__mesh_file *out;
    koksma__json_node root, lists[KOKSMA__GLTF_LISTS];
    size_t n[KOKSMA__GLTF_LISTS];
    koksma__gltf_bytes binary;   /* the binary piece of a GLB file */
    koksma__gltf_bytes *buffers; /* what is in them */
    koksma__gltf_bytes *images;  /* those that the file holds, once they were needed */
    koksma__list shown;          /* placements of the file's meshes */
    bool *mesh_shown;
    bool *material_used;   /* by a mesh that is shown; the last is for primitives that name none */
    bool *material_tinted; /* likewise, by one with colours of vertices */
    size_t *beyond;        /* of an accessor of indices: 1 + the largest; 0: not looked at yet */
} koksma__gltf;

/* The list `key` of an object, which may have none: then *n is 0. */
koksma_status koksma__gltf_list(const koksma__json_node *object, const char *key, koksma__json_node *list, size_t *n);

/* Item i of list `which` of the root; i is in range. */
koksma__json_node koksma__gltf_item(const koksma__gltf *g, int which, size_t i);

/* Follows keys into objects; false: one is not there. */
bool koksma__gltf_find(const koksma__json_node *from, const char *const keys[], koksma__json_node *out);

#endif
