/* SPDX-License-Identifier: Apache-2.0 */
/* The reader of glTF 2.0, JSON and buffers, in several files: gltf_check.c checks that the parts fit together;
   gltf_read.c opens the file; gltf_materials.c reads its materials and gltf_buffers.c its buffers and accessors;
   gltf_meshes.c makes meshes from primitives; gltf_nodes.c places them and reads the lights and the camera. This
   header declares what these files share. */
#ifndef KOKSMA_MESHES_GLTF_H
#define KOKSMA_MESHES_GLTF_H

#include "meshes/mesh_file.h"
#include "json/json.h"

enum { KOKSMA__GLTF_ITEMS = 1 << 20 }; /* of a list */

/* The lists of the root object; koksma__gltf.n has their lengths. */
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
    const unsigned char *bytes; /* NULL if the file that has the bytes is missing */
    size_t size;
} koksma__gltf_bytes;

/* The state of reading one file. An array that belongs to a list of the file has the same indices as that list. */
typedef struct koksma__gltf {
    koksma__mesh_file *out;
    koksma__json_node root, lists[KOKSMA__GLTF_LISTS];
    size_t n[KOKSMA__GLTF_LISTS];
    koksma__gltf_bytes binary;   /* the binary chunk of a GLB file */
    koksma__gltf_bytes *buffers; /* contents of the file's buffers */
    koksma__gltf_bytes *images;  /* images within the file, each loaded when first needed */
    koksma__list shown;          /* placements of the file's meshes */
    bool *mesh_shown;
    /* whether a mesh that is shown uses the material; the last entry stands for primitives without a material */
    bool *material_used;
    bool *material_tinted; /* whether a mesh that is shown and has vertex colours uses the material; indexed like
                              material_used */
    size_t *beyond;        /* 1 + the largest index in an accessor of indices; 0: not computed yet */
    koksma__names listed;  /* the extensions that the file says it uses */
    size_t text_size;      /* of the JSON */
    size_t index_bytes;    /* of the accessors of indices whose `beyond` is computed */
} koksma__gltf;

/* The list `key` of an object; if the object lacks it, *n is 0. */
koksma_status koksma__gltf_list(const koksma__json_node *object, const char *key, koksma__json_node *list, size_t *n);

/* Item i of the list `which` of the root object; i must be in range. */
koksma__json_node koksma__gltf_item(const koksma__gltf *g, int which, size_t i);

/* Follows the path `keys` into nested objects; returns false if a key is missing. */
bool koksma__gltf_find(const koksma__json_node *from, const char *const keys[], koksma__json_node *out);

#endif
