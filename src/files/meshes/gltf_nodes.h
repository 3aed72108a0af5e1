/* SPDX-License-Identifier: Apache-2.0 */
/* The nodes of a glTF file. */
#ifndef KOKSMA_MESHES_GLTF_NODES_H
#define KOKSMA_MESHES_GLTF_NODES_H

#include "meshes/gltf.h"

/* Adds the placements of meshes to g->shown, and the lights and the camera to the mesh file. Errors: MALFORMED,
   MEMORY. */
koksma_status koksma__gltf_read_nodes(koksma__gltf *g);

#endif
