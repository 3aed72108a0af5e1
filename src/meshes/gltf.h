/* SPDX-License-Identifier: Apache-2.0 */
/* glTF as JSON: gltf_check.c looks whether the parts fit together, gltf_indices.c whether vertices that are named are
   there, gltf_facts.c reads what assimp does not tell. */
#ifndef KOKSMA_MESHES_GLTF_H
#define KOKSMA_MESHES_GLTF_H

#include "meshes/mesh.h"
#include "json/json.h"

enum { KOKSMA__GLTF_ITEMS = 1 << 20 };

/* The list `key` of an object, which may have none: then *n is 0. */
koksma_status koksma__gltf_list(const koksma__json_node *object, const char *key, koksma__json_node *list, size_t *n);

/* Whether the vertices that triangles name are there, in a checked file; bin: the binary piece of the file, or NULL.
   Errors: MALFORMED, MISSING, MEMORY. */
koksma_status koksma__gltf_check_indices(const char *path, const koksma__json_node *root, const unsigned char *bin,
                                         size_t bin_size);

/* What a checked file says. Errors: MALFORMED, MEMORY. */
koksma_status koksma__gltf_facts(const koksma__json_node *root, koksma__gltf *out);

#endif
