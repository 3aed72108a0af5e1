/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A hash table with open addressing, at most half full: a name that is taken by hash moves on to the next free slot.
 * Names themselves are not compared: two of a scene's names have the same 64 bits by chance once in 10^7 scenes of a
 * million names, and a file that does it on purpose only confuses its own names.
 */
#include "scene/names.h"

#include <stdlib.h>
#include <string.h>

#include "core/hash.h"
#include "core/status.h"

struct koksma__names_slot {
    uint64_t hash; /* 0: free */
    size_t index;
};

static uint64_t hash_of(const char *name)
{
    return koksma__hash(name, strlen(name)) | 1;
}

/* The slot of a hash, or the free one where it belongs. */
static struct koksma__names_slot *slot_of(const koksma__names *names, uint64_t hash)
{
    size_t at = (size_t)(hash >> 1) & (names->capacity - 1);
    while (names->slots[at].hash && names->slots[at].hash != hash) {
        at = (at + 1) & (names->capacity - 1);
    }
    return &names->slots[at];
}

koksma_status koksma__names_put(koksma__names *names, const char *name, size_t index)
{
    if (2 * names->n >= names->capacity) {
        koksma__names more = {.n = names->n, .capacity = names->capacity ? 2 * names->capacity : 64};
        more.slots = calloc(more.capacity, sizeof *more.slots);
        KOKSMA__REQUIRE_MEMORY(more.slots, more.capacity * sizeof *more.slots);
        for (size_t i = 0; i < names->capacity; i++) {
            if (names->slots[i].hash) {
                *slot_of(&more, names->slots[i].hash) = names->slots[i];
            }
        }
        free(names->slots);
        *names = more;
    }
    struct koksma__names_slot *slot = slot_of(names, hash_of(name));
    names->n += !slot->hash;
    *slot = (struct koksma__names_slot){hash_of(name), index};
    return KOKSMA_OK;
}

bool koksma__names_find(const koksma__names *names, const char *name, size_t *index)
{
    const struct koksma__names_slot *slot = names->capacity ? slot_of(names, hash_of(name)) : NULL;
    *index = slot ? slot->index : 0;
    return slot && slot->hash;
}

void koksma__names_fini(koksma__names *names)
{
    free(names->slots);
    *names = (koksma__names){0};
}
