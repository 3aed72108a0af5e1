/* SPDX-License-Identifier: Apache-2.0 */
/* Reads mesh files by their names. */
#ifndef KOKSMA_MESHES_MESH_READ_H
#define KOKSMA_MESHES_MESH_READ_H

#include "meshes/mesh_file.h"

/* Whether a file's name has the ending of a mesh file (.obj .ply .ply.gz .off .gltf .glb .serialized). */
bool koksma__is_mesh_file(const char *path);

/* Reads a mesh file and the files that it names. The caller must call koksma__mesh_file_fini even after an error.
   Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__mesh_file_read(const char *path, koksma__named by, koksma__mesh_file *out);

/* Reads all triangles of a mesh file as one checked mesh. sizes: NULL, or counts the files that were read. out must be
   zeroed except for its name. Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__mesh_read(const char *path, koksma__named by, koksma__file_sizes *sizes, koksma__mesh *out);

#endif
