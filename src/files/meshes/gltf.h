/* SPDX-License-Identifier: Apache-2.0 */
/* The reader of glTF 2.0 in four files: gltf_read.c opens a file; gltf.c reads its buffers and accessors; gltf_schema.c
   checks that the parts fit together; gltf_scene.c reads what the scene shows. This header declares what they share. */
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

/* A part of a buffer. */
typedef struct koksma__gltf_view {
    size_t buffer, offset, size, stride;
} koksma__gltf_view;

/* The elements of an accessor. */
typedef struct koksma__gltf_elements {
    const unsigned char *first; /* set by koksma__gltf_elements_at */
    size_t n, stride;
    int component; /* glTF's number of the component type, 5120 to 5126 */
    int width;     /* number of components of an element; 0: it is a matrix */
    bool normalised;
    size_t view, offset; /* view: 1 + its index; 0: it has none */
    size_t beyond;       /* of indices: 1 + the largest; 0: not computed yet */
} koksma__gltf_elements;

/* The state of reading one file. An array that belongs to a list of the file has the same indices as that list. */
typedef struct koksma__gltf {
    koksma__mesh_file *out;
    koksma__json_node root, lists[KOKSMA__GLTF_LISTS];
    size_t n[KOKSMA__GLTF_LISTS];
    koksma__gltf_bytes binary;   /* the binary chunk of a GLB file */
    koksma__gltf_bytes *buffers; /* contents of the file's buffers */
    koksma__gltf_bytes *images;  /* images within the file, each loaded when first needed */
    koksma__gltf_view *views;
    koksma__gltf_elements *accessors;
    koksma__list shown; /* placements of the file's meshes */
    bool *has_parent;   /* of nodes */
    bool *mesh_shown;
    /* whether a mesh that is shown, or one with vertex colours, uses the material; the last entry stands for primitives
       without a material */
    bool *material_used, *material_tinted;
    koksma__names listed; /* the extensions that the file says it uses */
    size_t text_size;     /* of the JSON */
    size_t index_bytes;   /* of the accessors of indices whose `beyond` is computed */
} koksma__gltf;

/* The list `key` of an object; if the object lacks it, *n is 0. */
koksma_status koksma__gltf_list(const koksma__json_node *object, const char *key, koksma__json_node *list, size_t *n);

/* Item i of the list `which` of the root object; i must be in range. */
koksma__json_node koksma__gltf_item(const koksma__gltf *g, int which, size_t i);

/* The index that the member `key` of an object is, which gltf_schema.c has checked; `otherwise` where there is none. */
size_t koksma__gltf_index(const koksma__json_node *object, const char *key, size_t otherwise);

/* Follows a path of keys, "extensions/KHR_materials_ior", into nested objects. Returns false if a key is missing. */
bool koksma__gltf_find(const koksma__json_node *from, const char *path, koksma__json_node *out);

/* Loads all buffers whose data exist. Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__gltf_load_buffers(koksma__gltf *g);

/* Decodes a data URI in base64 into bytes that the koksma__mesh_file owns; errors name the field f. Errors:
   MALFORMED, MEMORY. */
koksma_status koksma__gltf_decode(koksma__gltf *g, const koksma__json_node *f, const char *uri,
                                  koksma__gltf_bytes *out);

/* The bytes of a buffer view. Errors: MALFORMED (its buffer is missing). */
koksma_status koksma__gltf_view_bytes(const koksma__gltf *g, size_t view, koksma__gltf_bytes *out);

/* The accessor whose index, *number, is the member `key` of the object. Errors: MALFORMED. */
koksma_status koksma__gltf_elements_at(const koksma__gltf *g, const koksma__json_node *object, const char *key,
                                       koksma__gltf_elements *out, size_t *number);

/* Size of a component in bytes; 0: there is no such type. */
size_t koksma__gltf_component_size(int component);

/* Returns element i of an accessor of integers with one component, such as indices. */
size_t koksma__gltf_whole(const koksma__gltf_elements *e, size_t i);

/* Returns component k of element i. For integers of a normalised accessor it lies between -1 and 1. */
float koksma__gltf_real(const koksma__gltf_elements *e, size_t i, int k);

/* gltf_schema.c. Names something of the file that isn't read as it stands there, in g->out->unknown. Error: MEMORY. */
koksma_status koksma__gltf_name(koksma__gltf *g, const koksma__json_node *at, const char *text);

/* gltf_schema.c. Names each member of the file's objects that glTF 2.0 does not have, in g->out->unknown. Error: MEMORY. */
koksma_status koksma__gltf_name_unknown(koksma__gltf *g);

/* Finds the lists of the root object, makes the arrays, and checks that every index of another item is in range, every
   buffer view and accessor lies within its buffer or view, and nodes form trees. Errors: MALFORMED, MEMORY. */
koksma_status koksma__gltf_check(koksma__gltf *g);

/* Whether the reader supports the extension of this name. */
bool koksma__gltf_reads(const char *extension);

/* Reads the meshes that the scene shows, placed, with their materials, the lights and the camera. Errors: MALFORMED,
   MEMORY. */
koksma_status koksma__gltf_read_scene(koksma__gltf *g);

#endif
