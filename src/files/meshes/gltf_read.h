/* SPDX-License-Identifier: Apache-2.0 */
/* The reader of glTF files. */
#ifndef KOKSMA_MESHES_GLTF_READ_H
#define KOKSMA_MESHES_GLTF_READ_H

#include "meshes/mesh_file.h"

/* Adds the contents of the file out->path, JSON or binary, and of its buffers to out. Errors: MISSING, MALFORMED,
   MEMORY. */
koksma_status koksma__gltf_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out);

#endif
