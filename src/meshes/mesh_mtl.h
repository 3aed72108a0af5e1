/* SPDX-License-Identifier: Apache-2.0 */
/* The reader of OBJ's material files, and the materials of an OBJ file by their names. */
#ifndef KOKSMA_MESHES_MESH_MTL_H
#define KOKSMA_MESHES_MESH_MTL_H

#include "meshes/mesh_file.h"

typedef struct koksma__mtl_name {
    char *name;      /* owned */
    size_t material; /* its number in the mesh file */
    bool made;       /* by a material file; else only used */
} koksma__mtl_name;

/* An open hash table of the names: 1 + a name's number, or 0; at most half of the slots are taken. */
typedef struct koksma__mtl_names {
    koksma__list names;
    uint32_t *slots;
    size_t n_slots;
} koksma__mtl_names;

/* The name, added with a grey material if it is new; NULL when memory runs out. It holds until the next call. */
koksma__mtl_name *koksma__mtl_find(koksma__mtl_names *names, koksma__mesh_file *f, const char *name, size_t length);
void koksma__mtl_names_fini(koksma__mtl_names *names);

/* Reads the material file at `path` into materials of f, and adds its hash to the file's. Errors: MISSING, MALFORMED,
   MEMORY. */
koksma_status koksma__mtl_read(const char *path, koksma__mtl_names *names, koksma__mesh_file *f);

#endif
