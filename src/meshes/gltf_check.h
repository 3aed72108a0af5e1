/* SPDX-License-Identifier: Apache-2.0 */
/* Whether the parts of a glTF file fit together. */
#ifndef KOKSMA_MESHES_GLTF_CHECK_H
#define KOKSMA_MESHES_GLTF_CHECK_H

#include "meshes/gltf.h"

/* Finds the lists of the root, and whether every number that names another thing is in range, every piece lies
   within what holds it, and nodes are trees. Errors: MALFORMED, MEMORY. */
koksma_status koksma__gltf_check(koksma__gltf *g);

/* Whether the extension of this name is read. */
bool koksma__gltf_reads(const char *extension);

#endif
