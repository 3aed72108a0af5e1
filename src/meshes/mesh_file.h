/* SPDX-License-Identifier: Apache-2.0 */
/* Mesh files before assimp sees them. */
#ifndef KOKSMA_MESHES_MESH_FILE_H
#define KOKSMA_MESHES_MESH_FILE_H

#include "core/read_file.h"
#include "image/formats.h"
#include "meshes/mesh.h"
#include "json/json.h"

/* Whether there is a file that is no folder, device or the like. */
bool koksma__is_plain_file(const char *path);

/* The plain file beside the model that a model names: as it stands there, or with its %20 and the like decoded (names
   in glTF are URIs: RFC 3986, section 2.1), or with \ taken for / (OBJ files of Windows). false: there is none. */
bool koksma__find_named(const char *model, const char *name, char out[KOKSMA__MAX_PATH]);

/* The same, where the model's folder has been put before the name. */
bool koksma__find_part(const char *model, const char *path, char out[KOKSMA__MAX_PATH]);

/* A file as assimp is to have it, and what it doesn't tell. */
typedef struct koksma__mesh_source {
    koksma__bytes bytes;
    uint64_t hash; /* of the file as it is */
    koksma__gltf gltf;
} koksma__mesh_source;

/* Whether a file's name is a mesh's, it is a plain file, and its parts fit together; of a glTF file also what it
   says, of others what holds where nothing is said. The caller frees the bytes. Errors: MISSING, MALFORMED, MEMORY.
 */
koksma_status koksma__mesh_file_open(const char *path, koksma__mesh_source *out);

/* A file that a mesh file names: as it is, but for a material file. The caller frees the bytes. Errors: MISSING,
   MALFORMED, MEMORY. */
koksma_status koksma__mesh_part_open(const char *path, koksma__bytes *out, uint64_t *hash);

/* Whether a file has what it says; into out, which may be left empty where the file will do, goes what assimp reads
   rightly. Errors: MALFORMED, MEMORY. */
koksma_status koksma__off_clean(const char *path, const unsigned char *file, size_t size, koksma__bytes *out);
koksma_status koksma__ply_clean(const char *path, const unsigned char *file, size_t size, koksma__bytes *out);
koksma_status koksma__obj_clean(const char *path, const unsigned char *file, size_t size, koksma__unread *unread,
                                koksma__bytes *out);
koksma_status koksma__mtl_clean(const char *path, const unsigned char *file, size_t size, koksma__bytes *out);

/* The bytes of UTF-8's mark at the beginning: 0 or 3. */
size_t koksma__byte_order_mark(const unsigned char *file, size_t size);

#endif
