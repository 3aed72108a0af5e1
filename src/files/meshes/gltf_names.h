/* SPDX-License-Identifier: Apache-2.0 */
/* The names that objects of a glTF file may have. */
#ifndef KOKSMA_MESHES_GLTF_NAMES_H
#define KOKSMA_MESHES_GLTF_NAMES_H

#include "meshes/gltf.h"

/* Names each member of the file's objects that glTF 2.0 does not have, in g->out->unknown. Error: MEMORY. */
koksma_status koksma__gltf_name_unknown(koksma__gltf *g);

#endif
