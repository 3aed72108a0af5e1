/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Mutations of JSON texts for libFuzzer. Most changes of single bytes break the syntax, so that the code after the JSON
 * parser would hardly ever run. Here values are moved, copied, removed and replaced within a text, or come from another
 * input, and keys are exchanged. One input in eight, and those that are no JSON, are mutated by bytes.
 */
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "mutate.h"

enum { MAX_NODES = 4096, MAX_TEXT = 256 };

/* A value below the root: a member of an object (key) or an item of an array. */
typedef struct node {
    json_t *parent;
    const char *key;
    size_t item;
} node;

typedef struct nodes {
    node at[MAX_NODES];
    size_t count;
} nodes;

static json_t *value_of(const node *n)
{
    return n->key ? json_object_get(n->parent, n->key) : json_array_get(n->parent, n->item);
}

static void collect(json_t *parent, nodes *all)
{
    const char *key;
    json_t *value;
    json_object_foreach(parent, key, value)
    {
        if (all->count < MAX_NODES) {
            all->at[all->count++] = (node){.parent = parent, .key = key};
            collect(value, all);
        }
    }
    for (size_t i = 0; i < json_array_size(parent) && all->count < MAX_NODES; i++) {
        all->at[all->count++] = (node){.parent = parent, .item = i};
        collect(json_array_get(parent, i), all);
    }
}

static json_t *some_number(void)
{
    static const double reals[] = {0.5, -0.5, 1e-300, 1e300, -1e300, 1e10, 0.1, 5e-324, 1e-9};
    static const json_int_t wholes[] = {0,     1,         -1,        2,          3,         16,       255,
                                        65536, INT32_MAX, INT32_MIN, UINT32_MAX, INT64_MAX, INT64_MIN};
    if (below(2)) {
        return json_real(reals[below(sizeof reals / sizeof *reals)]);
    }
    return json_integer(wholes[below(sizeof wholes / sizeof *wholes)]);
}

/* A text with its bytes mutated; NULL: the result is not UTF-8. */
static json_t *other_text(const json_t *text)
{
    uint8_t bytes[MAX_TEXT];
    const size_t length = json_string_length(text);
    const size_t size = length < MAX_TEXT ? length : MAX_TEXT;
    memcpy(bytes, json_string_value(text), size);
    return json_stringn((const char *)bytes, LLVMFuzzerMutate(bytes, size, MAX_TEXT));
}

/* A value of another kind, or nearly the same. */
static json_t *other_value(const json_t *value)
{
    const size_t kind = below(12);
    if (kind == 0) {
        return json_null();
    } else if (kind == 1) {
        return json_boolean(below(2));
    } else if (kind == 2) {
        return json_array();
    } else if (kind == 3) {
        return json_object();
    } else if (kind == 4) {
        return json_string("");
    } else if (kind == 5) {
        return json_pack("[O]", value);
    } else if (json_is_string(value)) {
        return other_text(value);
    } else if (json_is_integer(value)) {
        return below(2) ? some_number() : json_integer(json_integer_value(value) / 2 + (json_int_t)below(5) - 2);
    } else if (json_is_real(value)) {
        return below(2) ? some_number() : json_real(json_real_value(value) * ((double)below(9) - 4) / 2);
    }
    return some_number();
}

static void put(const node *at, json_t *value)
{
    if (!value) {
        return;
    }
    if (at->key) {
        json_object_set_new(at->parent, at->key, value);
    } else {
        json_array_set_new(at->parent, at->item, value);
    }
}

/* Adds value to the container that holds `at`: as an item, or as a member whose key is that of `like`. */
static void add(const node *at, const node *like, json_t *value)
{
    if (json_is_array(at->parent)) {
        json_array_insert_new(at->parent, at->item, value);
    } else if (like->key) {
        char key[MAX_TEXT] = "";
        strncpy(key, like->key, sizeof key - 1);
        json_object_set_new(at->parent, key, value);
    } else {
        json_decref(value);
    }
}

static void rename_member(const node *at, const node *like)
{
    if (at->key && like->key) {
        char key[MAX_TEXT] = "";
        strncpy(key, like->key, sizeof key - 1);
        json_t *value = json_incref(value_of(at));
        json_object_del(at->parent, at->key);
        json_object_set_new(at->parent, key, value);
    }
}

/* Changes one value of root. `others` are the values to copy from: those of root, or of another input. */
static void change(json_t *root, const nodes *others)
{
    static nodes all;
    all.count = 0;
    collect(root, &all);
    if (all.count == 0) {
        return;
    }
    const node at = all.at[below(all.count)];
    const nodes *from = others ? others : &all;
    if (from->count == 0) {
        return;
    }
    const node like = from->at[below(from->count)];
    switch (below(6)) {
    case 0:
        if (at.key) {
            json_object_del(at.parent, at.key);
        } else {
            json_array_remove(at.parent, at.item);
        }
        break;
    case 1:
        put(&at, json_deep_copy(value_of(&like)));
        break;
    case 2:
        add(&at, &like, json_deep_copy(value_of(&like)));
        break;
    case 3:
        rename_member(&at, &like);
        break;
    default:
        put(&at, other_value(value_of(&at)));
        break;
    }
}

/* Writes root to bytes. 0: it is too long. */
static size_t write_to(json_t *root, uint8_t *bytes, size_t max_size)
{
    const size_t size = json_dumpb(root, (char *)bytes, max_size, JSON_COMPACT);
    return size <= max_size ? size : 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size, size_t max_size, unsigned seed)
{
    *mutate_state() = seed;
    json_t *root = below(8) ? json_loadb((const char *)bytes, size, 0, NULL) : NULL;
    size_t length = 0;
    if (root) {
        for (size_t i = below(3) + 1; i > 0; i--) {
            change(root, NULL);
        }
        uint8_t *text = malloc(max_size);
        length = text ? write_to(root, text, max_size) : 0;
        memcpy(bytes, text, length);
        free(text);
        json_decref(root);
    }
    return length ? length : LLVMFuzzerMutate(bytes, size, max_size);
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *first, size_t first_size, const uint8_t *second, size_t second_size,
                                 uint8_t *out, size_t max_size, unsigned seed)
{
    static nodes others;
    *mutate_state() = seed;
    others.count = 0;
    json_t *root = json_loadb((const char *)first, first_size, 0, NULL);
    json_t *other = json_loadb((const char *)second, second_size, 0, NULL);
    size_t length = 0;
    if (root && other) {
        collect(other, &others);
        for (size_t i = below(3) + 1; i > 0; i--) {
            change(root, &others);
        }
        length = write_to(root, out, max_size);
    }
    json_decref(root);
    json_decref(other);
    return length;
}
