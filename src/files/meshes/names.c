/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A digital search tree (Knuth, The Art of Computer Programming, volume 3, section 6.3): the bits of a name's hash lead
 * from the root down, to the node that has this hash or to where it belongs. Every node at depth d has the first d bits
 * of its hash in common with all nodes below it, so no path is longer than the hash's 64 bits, whatever names a file
 * has; a hash table would take as many steps as there are names whose hashes begin alike, which are easy to craft.
 * Names themselves are not compared: two of a scene's names have the same 64 bits by chance once in 10^7 scenes of a
 * million names, and a file that does it on purpose only confuses its own names.
 */
#include "meshes/names.h"

#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/hash.h"

/* The index of the node that has this hash; if there is none, names->n, and *link is where the index of a new node has
   to be written (NULL for the root). */
static size_t node_of(const koksma__names *names, uint64_t hash, size_t **link)
{
    size_t at = 0;
    *link = NULL;
    for (uint64_t bits = hash; at < names->n && names->nodes[at].hash != hash; bits >>= 1) {
        *link = &names->nodes[at].next[bits & 1];
        at = **link ? **link : names->n;
    }
    return at;
}

koksma_status koksma__names_put(koksma__names *names, const char *name, size_t length, size_t index)
{
    const uint64_t hash = koksma__hash(name, length);
    size_t *link;
    KOKSMA__TRY(koksma__reserve(&names->nodes, &names->capacity, names->n + 1, sizeof *names->nodes));
    const size_t at = node_of(names, hash, &link);
    if (at == names->n) {
        names->nodes[names->n++] = (koksma__names_node){.hash = hash};
        if (link) {
            *link = at;
        }
    }
    names->nodes[at].index = index;
    return KOKSMA_OK;
}

bool koksma__names_find(const koksma__names *names, const char *name, size_t length, size_t *index)
{
    size_t *link;
    const size_t at = node_of(names, koksma__hash(name, length), &link);
    *index = at < names->n ? names->nodes[at].index : 0;
    return at < names->n;
}

void koksma__names_fini(koksma__names *names)
{
    free(names->nodes);
    *names = (koksma__names){0};
}
