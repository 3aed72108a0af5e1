/* SPDX-License-Identifier: Apache-2.0 */
/* The materials of a glTF file. */
#ifndef KOKSMA_MESHES_GLTF_MATERIALS_H
#define KOKSMA_MESHES_GLTF_MATERIALS_H

#include "meshes/gltf.h"

/* Reads the materials that g->material_used marks; they keep the file's indices. Errors: MALFORMED, MEMORY. */
koksma_status koksma__gltf_read_materials(koksma__gltf *g);

/* The set of texture coordinates, 0 or 1, for meshes of a material: that of the material's first texture. */
int koksma__gltf_uv_set(const koksma__gltf *g, size_t material);

#endif
