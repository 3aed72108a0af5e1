/* SPDX-License-Identifier: Apache-2.0 */
/* The materials that an OBJ file uses and those that its material files make: assimp takes a grey one for a name that
   nobody makes, and says nothing. */
#ifndef KOKSMA_MESHES_MESH_OBJ_NAMES_H
#define KOKSMA_MESHES_MESH_OBJ_NAMES_H

#include "meshes/mesh_file.h"

enum { KOKSMA__OBJ_NAMES = 4096, KOKSMA__OBJ_LIBRARIES = 64 };

/* Names by their hashes; of more than half the room for them the rest is not looked at. */
typedef struct koksma__obj_set {
    size_t n;
    uint64_t hashes[KOKSMA__OBJ_NAMES]; /* 0: free */
} koksma__obj_set;

typedef struct koksma__obj_names {
    koksma__obj_set used, made;
    size_t n_libraries;
    uint64_t libraries[KOKSMA__OBJ_LIBRARIES]; /* that were named */
} koksma__obj_names;

/* Whether it is a new one, and there was room for it. */
bool koksma__obj_set_add(koksma__obj_set *set, const char *name, size_t length);
bool koksma__obj_set_has(const koksma__obj_set *set, const char *name, size_t length);

/* A line of a word, with a blank at its end, and a name. Errors: MEMORY. */
koksma_status koksma__obj_put_name(const char *word, const char *name, size_t length, koksma__bytes *out);

/* What follows mtllib: one name with blanks, or several, which get a line each in out; those that are not there are
   noted. Errors: MALFORMED (more than 64), MEMORY. */
koksma_status koksma__obj_take_libraries(const char *path, const char *rest, koksma__obj_names *names,
                                         koksma__unread *unread, koksma__bytes *out);

#endif
