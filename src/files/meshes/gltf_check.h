/* SPDX-License-Identifier: Apache-2.0 */
/* Checks that the parts of a glTF file fit together. */
#ifndef KOKSMA_MESHES_GLTF_CHECK_H
#define KOKSMA_MESHES_GLTF_CHECK_H

#include "meshes/gltf.h"

/* Finds the lists of the root object, and checks that every index of another item is in range, every buffer view and
   accessor lies within its buffer or view, and nodes form trees. Errors: MALFORMED, MEMORY. */
koksma_status koksma__gltf_check(koksma__gltf *g);

/* Whether the reader supports the extension of this name. */
bool koksma__gltf_reads(const char *extension);

#endif
