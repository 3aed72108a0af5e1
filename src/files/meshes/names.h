/* SPDX-License-Identifier: Apache-2.0 */
/* Finds things of a scene or mesh file by their names, of which there may be a million. */
#ifndef KOKSMA_MESHES_NAMES_H
#define KOKSMA_MESHES_NAMES_H

#include <koksma/koksma.h>

/* A name in the tree. */
typedef struct koksma__names_node {
    uint64_t hash;
    size_t index;
    size_t next[2]; /* the nodes in which names go on whose next bit is 0 or 1; 0: none */
} koksma__names_node;

/* A tree of names, which are kept as hashes of 64 bits; zeroed at first. nodes[0] is the root. */
typedef struct koksma__names {
    koksma__names_node *nodes;
    size_t n, capacity;
} koksma__names;

/* Gives the name of `length` bytes to the thing with this index, in place of an earlier thing of the same name. Error:
   MEMORY. */
koksma_status koksma__names_put(koksma__names *names, const char *name, size_t length, size_t index);

/* Finds the index; returns false if there is none. */
bool koksma__names_find(const koksma__names *names, const char *name, size_t length, size_t *index);

void koksma__names_fini(koksma__names *names);

#endif
