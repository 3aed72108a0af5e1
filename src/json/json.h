/* SPDX-License-Identifier: Apache-2.0 */
/*
 * JSON files (scenes, plans) with errors that name file, line, field and reason. A node remembers its path from the
 * root ("lights[2].centre"); its line is looked up only when something is wrong with it.
 */
#ifndef KOKSMA_JSON_JSON_H
#define KOKSMA_JSON_JSON_H

#include <koksma/koksma.h>

#include "core/status.h"

typedef struct koksma__json koksma__json;

enum { KOKSMA__JSON_PATH = 128, KOKSMA__JSON_STEPS = 16 };

/* From a node to one below: to the member of that key, or, where it is NULL, to the item of that number. */
typedef struct koksma__json_step {
    const char *key;
    size_t item;
} koksma__json_step;

/* The path is for readers, and may be cut; steps are the way itself, as far as there is room. */
typedef struct koksma__json_node {
    const koksma__json *document;
    const void *value;
    char path[KOKSMA__JSON_PATH];
    koksma__json_step steps[KOKSMA__JSON_STEPS];
    int n_steps;
} koksma__json_node;

/* Parses text; kind and name are what errors call it: "scene 'box.json': line 3: …". Keeps its own copy of text.
   Repeated keys are errors. Errors: MALFORMED, MEMORY. */
koksma_status koksma__json_open(const char *kind, const char *name, const char *text, size_t size,
                                koksma__json **out);
void koksma__json_close(koksma__json *document);
koksma__json_node koksma__json_root(const koksma__json *document);

/* "KIND 'NAME': line N: PATH: reason", status MALFORMED. */
koksma_status koksma__json_fail(const koksma__json_node *node, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Ends the function with it. */
#define KOKSMA__JSON_FAIL_IF(condition, ...) KOKSMA__TRY((condition) ? koksma__json_fail(__VA_ARGS__) : KOKSMA_OK)

/* Puts the place of the node before the text of an error that another function returned. The status becomes MALFORMED, except
   MEMORY and SYSTEM, which stay. */
koksma_status koksma__json_fail_in(const koksma__json_node *node, koksma_status status);

/* Fails unless node is an object whose keys are all among `keys`, which ends at NULL. */
koksma_status koksma__json_only(const koksma__json_node *node, const char *const *keys);

/* Whether the object has the key with an object. */
bool koksma__json_is_object_at(const koksma__json_node *node, const char *key);
bool koksma__json_is_array(const koksma__json_node *node);
bool koksma__json_is_text(const koksma__json_node *node);

/* Whether the object has the key; a member of an object, which must be there; an item of an array. */
bool koksma__json_has(const koksma__json_node *node, const char *key);
koksma_status koksma__json_member(const koksma__json_node *node, const char *key, koksma__json_node *out);
koksma_status koksma__json_length(const koksma__json_node *node, size_t max, size_t *length); /* of an array */
koksma__json_node koksma__json_item(const koksma__json_node *node, size_t i);

/* The node's own value, checked. Texts live as long as the document. */
koksma_status koksma__json_number(const koksma__json_node *node, double min, double max, double *out);
koksma_status koksma__json_whole(const koksma__json_node *node, long long min, long long max, long long *out);
koksma_status koksma__json_flag(const koksma__json_node *node, bool *out);
koksma_status koksma__json_text(const koksma__json_node *node, const char **out);
/* An array of exactly n numbers. */
koksma_status koksma__json_numbers(const koksma__json_node *node, double min, double max, size_t n, double *out);

/* Read the member `key` of an object as the functions above read a node. Without it *out keeps its value; where the
   member is needed, that is an error. */
koksma_status koksma__json_get_number(const koksma__json_node *node, const char *key, bool needed, double min,
                                      double max, double *out);
koksma_status koksma__json_get_whole(const koksma__json_node *node, const char *key, bool needed, long long min,
                                     long long max, long long *out);
/* What the document of a node is called: that of koksma__json_open. */
const char *koksma__json_document(const koksma__json_node *node);

koksma_status koksma__json_get_flag(const koksma__json_node *node, const char *key, bool needed, bool *out);
koksma_status koksma__json_get_text(const koksma__json_node *node, const char *key, bool needed, const char **out);
koksma_status koksma__json_get_numbers(const koksma__json_node *node, const char *key, bool needed, double min,
                                       double max, size_t n, double *out);

#endif
