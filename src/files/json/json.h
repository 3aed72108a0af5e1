/* SPDX-License-Identifier: Apache-2.0 */
/*
 * JSON files (scenes, plans) with errors that name file, line, field and reason. A node remembers its path from
 * the root ("lights[2].centre"); its line is searched only for an error.
 */
#ifndef KOKSMA_JSON_JSON_H
#define KOKSMA_JSON_JSON_H

#include <koksma/koksma.h>

#include "core/status.h"

typedef struct koksma__json koksma__json;

enum { KOKSMA__JSON_PATH = 128, KOKSMA__JSON_STEPS = 16 };

/* One step from a node to a child: to the member `key` of an object or, if key is NULL, to the item `item` of a
   list. */
typedef struct koksma__json_step {
    const char *key;
    size_t item;
} koksma__json_step;

/* A value in a document. `path` is its position as text, for messages; a long path is truncated. `steps` are the keys
   and indices that lead from the root to the value, at most KOKSMA__JSON_STEPS. */
typedef struct koksma__json_node {
    const koksma__json *document;
    const void *value;
    char path[KOKSMA__JSON_PATH];
    koksma__json_step steps[KOKSMA__JSON_STEPS];
    int n_steps;
} koksma__json_node;

/* Parses a text and copies it. kind and name identify it in error messages: "scene 'box.json': line 3: …". Repeated
   keys are errors. Errors: MALFORMED, MEMORY. */
koksma_status koksma__json_open(const char *kind, const char *name, const char *text, size_t size,
                                koksma__json **out);
void koksma__json_close(koksma__json *document);
koksma__json_node koksma__json_root(const koksma__json *document);

/* Fails with MALFORMED and the text "KIND 'NAME': line N: PATH: reason". */
koksma_status koksma__json_fail(const koksma__json_node *node, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* If the condition is true, makes the calling function return the status of koksma__json_fail. */
#define KOKSMA__JSON_FAIL_IF(condition, ...) KOKSMA__TRY((condition) ? koksma__json_fail(__VA_ARGS__) : KOKSMA_OK)

/* Puts the node's file, line and path before the error text of another function. The status becomes MALFORMED unless
   it is MEMORY or SYSTEM. */
koksma_status koksma__json_fail_in(const koksma__json_node *node, koksma_status status);

/* Fails unless node is an object whose keys are all among `keys`, which ends at NULL. */
koksma_status koksma__json_only(const koksma__json_node *node, const char *const *keys);

/* Finds the next member of an object, and its key: the first one if *at is NULL, which is set. Returns false after the last
   one. The path of the member's node is not written; koksma__json_line_of finds its line. */
bool koksma__json_next(const koksma__json_node *object, void **at, const char **key, koksma__json_node *member);

/* The line of a value in its text, which is read up to it. */
size_t koksma__json_line_of(const koksma__json_node *node);

/* Returns whether an object has a member `key` that is itself an object. */
bool koksma__json_is_object_at(const koksma__json_node *node, const char *key);
bool koksma__json_is_object(const koksma__json_node *node);
bool koksma__json_is_array(const koksma__json_node *node);
bool koksma__json_is_text(const koksma__json_node *node);

/* koksma__json_has: whether an object has the key. koksma__json_member: the member, which must exist.
   koksma__json_item: an item of an array. */
bool koksma__json_has(const koksma__json_node *node, const char *key);
koksma_status koksma__json_member(const koksma__json_node *node, const char *key, koksma__json_node *out);
/* Sets *length to the length of an array, which must be at most `max`. */
koksma_status koksma__json_length(const koksma__json_node *node, size_t max, size_t *length);
koksma__json_node koksma__json_item(const koksma__json_node *node, size_t i);

/* Read the value of a node and check its type and range; after an error *out is as it was. Texts are valid as long as the
   document. */
koksma_status koksma__json_number(const koksma__json_node *node, double min, double max, double *out);
koksma_status koksma__json_whole(const koksma__json_node *node, long long min, long long max, long long *out);
koksma_status koksma__json_flag(const koksma__json_node *node, bool *out);
koksma_status koksma__json_text(const koksma__json_node *node, const char **out);
/* Reads an array of exactly n numbers. */
koksma_status koksma__json_numbers(const koksma__json_node *node, double min, double max, size_t n, double *out);

/* Read the member `key` of an object as the functions above read a node. If it is absent, *out does not change; this
   is an error only if the member is needed. */
koksma_status koksma__json_get_number(const koksma__json_node *node, const char *key, bool needed, double min,
                                      double max, double *out);
koksma_status koksma__json_get_whole(const koksma__json_node *node, const char *key, bool needed, long long min,
                                     long long max, long long *out);
/* Returns the name of a node's document, as given to koksma__json_open. */
const char *koksma__json_document(const koksma__json_node *node);

koksma_status koksma__json_get_flag(const koksma__json_node *node, const char *key, bool needed, bool *out);
koksma_status koksma__json_get_text(const koksma__json_node *node, const char *key, bool needed, const char **out);
koksma_status koksma__json_get_numbers(const koksma__json_node *node, const char *key, bool needed, double min,
                                       double max, size_t n, double *out);

#endif
