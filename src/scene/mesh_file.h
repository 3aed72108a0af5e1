/* SPDX-License-Identifier: Apache-2.0 */
/* Mesh files before assimp sees them. */
#ifndef KOKSMA_SCENE_MESH_FILE_H
#define KOKSMA_SCENE_MESH_FILE_H

#include "scene/mesh.h"
#include "scene/parse.h"

/* Whether there is a file that is no folder, device or the like. */
bool koksma__is_plain_file(const char *path);

/* The plain file beside the model that a model names: as it stands there, or with its %20 and the like decoded (names
   in glTF are URIs: RFC 3986, section 2.1), or with \ taken for / (OBJ files of Windows). false: there is none. */
bool koksma__find_named(const char *model, const char *name, char out[KOKSMA__MAX_PATH]);

/* Whether a file's name is a mesh's, it is a plain file, and its parts fit together; of a glTF file also what it
   says, of others what holds where nothing is said. Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__mesh_file_check(const char *path, koksma__gltf *gltf);

/* The same for a file that a mesh file names, in memory: false where it is no material file that may be read. */
bool koksma__mesh_part_check(const char *path, const unsigned char *file, size_t size);

#endif
