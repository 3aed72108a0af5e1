/* SPDX-License-Identifier: Apache-2.0 */
/* Mesh files by their names. */
#ifndef KOKSMA_MESHES_MESH_READ_H
#define KOKSMA_MESHES_MESH_READ_H

#include "meshes/mesh_file.h"

/* Whether a file of this name (.obj .ply .off .gltf .glb) is a mesh's. */
bool koksma__is_mesh_file(const char *path);

/* Reads a mesh file and the files that it names. Whatever comes of it, the caller calls koksma__mesh_file_fini.
   Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__mesh_file_read(const char *path, koksma__named by, koksma__mesh_file *out);

/* All triangles of a file that a file names as one mesh, checked. out is zeroed but for its name. Errors: MISSING, MALFORMED, MEMORY.
 */
koksma_status koksma__mesh_read(const char *path, koksma__mesh *out);

#endif
