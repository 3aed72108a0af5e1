/* SPDX-License-Identifier: Apache-2.0 */
/* Buffers, views and accessors of a glTF file. */
#ifndef KOKSMA_MESHES_GLTF_BUFFERS_H
#define KOKSMA_MESHES_GLTF_BUFFERS_H

#include "meshes/gltf.h"

/* The position and type of an accessor's elements. */
typedef struct koksma__gltf_elements {
    const unsigned char *first;
    size_t n, stride;
    int component; /* glTF's number of the component type, 5120 to 5126 */
    int width;     /* number of components of an element */
    bool normalised;
} koksma__gltf_elements;

/* Loads all buffers whose data exist. Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__gltf_load_buffers(koksma__gltf *g);

/* Decodes a data URI in base64 into bytes that the koksma__mesh_file owns; errors name the field f. Errors:
   MALFORMED, MEMORY. */
koksma_status koksma__gltf_decode(koksma__gltf *g, const koksma__json_node *f, const char *uri,
                                  koksma__gltf_bytes *out);

/* The bytes of a buffer view. Errors: MALFORMED (its buffer is missing). */
koksma_status koksma__gltf_view(const koksma__gltf *g, size_t view, koksma__gltf_bytes *out, size_t *stride);

/* The accessor whose index is the member `key` of the object. Errors: MALFORMED. */
koksma_status koksma__gltf_elements_at(const koksma__gltf *g, const koksma__json_node *object, const char *key,
                                       koksma__gltf_elements *out, long long *number);

/* Returns element i of an accessor of integers with one component, such as indices. */
size_t koksma__gltf_whole(const koksma__gltf_elements *e, size_t i);

/* Returns component k of element i. For integers of a normalised accessor it lies between -1 and 1. */
float koksma__gltf_real(const koksma__gltf_elements *e, size_t i, int k);

#endif
