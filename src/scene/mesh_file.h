/* SPDX-License-Identifier: Apache-2.0 */
/* Mesh files before assimp sees them. */
#ifndef KOKSMA_SCENE_MESH_FILE_H
#define KOKSMA_SCENE_MESH_FILE_H

#include "scene/mesh.h"

/* Whether there is a file that is no folder, device or the like. */
bool koksma__is_plain_file(const char *path);

/* Whether a file's name is a mesh's, it is a plain file, and its parts fit together; of a glTF file also what it
   says, of others what holds where nothing is said. Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__mesh_file_check(const char *path, koksma__gltf *gltf);

/* The same for a file that a mesh file names, in memory: false where it is no material file that may be read. */
bool koksma__mesh_part_check(const char *path, const unsigned char *file, size_t size);

#endif
