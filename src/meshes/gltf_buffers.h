/* SPDX-License-Identifier: Apache-2.0 */
/* Buffers, views and accessors of a glTF file. */
#ifndef KOKSMA_MESHES_GLTF_BUFFERS_H
#define KOKSMA_MESHES_GLTF_BUFFERS_H

#include "meshes/gltf.h"

/* Where the elements of an accessor are. */
typedef struct koksma__gltf_elements {
    const unsigned char *first;
    size_t n, stride;
    int component; /* its type: 5120 and so on */
    int width;     /* components of an element */
    bool normalised;
} koksma__gltf_elements;

/* Loads all buffers that are there. Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__gltf_load_buffers(koksma__gltf *g);

/* The bytes of a data URI in base64, owned by the file; f is for errors. Errors: MALFORMED, MEMORY. */
koksma_status koksma__gltf_decode(koksma__gltf *g, const koksma__json_node *f, const char *uri,
                                  koksma__gltf_bytes *out);

/* The bytes of a buffer view. Errors: MALFORMED (its buffer is not there). */
koksma_status koksma__gltf_view(const koksma__gltf *g, size_t view, koksma__gltf_bytes *out, size_t *stride);

/* The accessor that a member of the object names. Errors: MALFORMED. */
koksma_status koksma__gltf_elements_at(const koksma__gltf *g, const koksma__json_node *object, const char *key,
                                       koksma__gltf_elements *out, long long *number);

/* Component k of element i: an integer; or a number, of integers between -1 and 1 if the accessor is normalised. */
size_t koksma__gltf_whole(const koksma__gltf_elements *e, size_t i);
float koksma__gltf_real(const koksma__gltf_elements *e, size_t i, int k);

#endif
