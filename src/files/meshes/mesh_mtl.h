/* SPDX-License-Identifier: Apache-2.0 */
/* The reader of OBJ's material files, and the materials of an OBJ file by their names. */
#ifndef KOKSMA_MESHES_MESH_MTL_H
#define KOKSMA_MESHES_MESH_MTL_H

#include "meshes/mesh_file.h"
#include "meshes/names.h"

typedef struct koksma__mtl_name {
    char *name;      /* owned */
    size_t material; /* index of the material in the mesh file */
    bool made;       /* whether a material file defines the material; otherwise only usemtl lines name it */
} koksma__mtl_name;

typedef struct koksma__mtl_names {
    koksma__list names;   /* in the order of the file */
    koksma__names places; /* the index of each in that list */
} koksma__mtl_names;

/* The entry of the name; a new name gets an entry with a grey material. NULL when memory runs out. The pointer is
   valid until the next call. */
koksma__mtl_name *koksma__mtl_find(koksma__mtl_names *names, koksma__mesh_file *f, const char *name, size_t length);
void koksma__mtl_names_fini(koksma__mtl_names *names);

/* Reads the material file at `path` into the materials of f, and adds its hash to f's hash. Errors: MISSING,
   MALFORMED, MEMORY. */
koksma_status koksma__mtl_read(const char *path, koksma__mtl_names *names, koksma__mesh_file *f);

#endif
