/* SPDX-License-Identifier: Apache-2.0 */
/* The meshes of a glTF file. */
#ifndef KOKSMA_MESHES_GLTF_MESHES_H
#define KOKSMA_MESHES_GLTF_MESHES_H

#include "meshes/gltf.h"

/* Checks all meshes, and reads those that the scene shows, with their placements. Errors: MALFORMED, MEMORY. */
koksma_status koksma__gltf_read_meshes(koksma__gltf *g);

#endif
