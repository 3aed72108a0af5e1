/* SPDX-License-Identifier: Apache-2.0 */
/* Access to lists and members of a glTF file's JSON, for the other gltf_*.c files. A missing list counts as empty. */
#include "meshes/gltf.h"

typedef koksma__json_node field;

koksma_status koksma__gltf_list(const field *object, const char *key, field *list, size_t *n)
{
    *n = 0;
    if (!koksma__json_has(object, key)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__json_member(object, key, list);
    return status ? status : koksma__json_length(list, KOKSMA__GLTF_ITEMS, n);
}

/* Follows the path `keys` into nested objects; returns false if a key is missing. */
bool koksma__gltf_find(const field *from, const char *const keys[], field *out)
{
    field at = *from;
    for (; *keys; keys++) {
        const field object = at;
        if (!koksma__json_has(&object, *keys) || koksma__json_member(&object, *keys, &at)) {
            return false;
        }
    }
    *out = at;
    return true;
}

koksma__json_node koksma__gltf_item(const koksma__gltf *g, int which, size_t i)
{
    return koksma__json_item(&g->lists[which], i);
}
