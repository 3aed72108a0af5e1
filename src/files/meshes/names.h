/* SPDX-License-Identifier: Apache-2.0 */
/* Names in a scene or mesh file: finds things by their names, of which there may be a million, and lists what the readers
   do not read. */
#ifndef KOKSMA_MESHES_NAMES_H
#define KOKSMA_MESHES_NAMES_H

#include "core/status.h"

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

/* ---- What is not read, with file and line ---- */

/* A feature of another renderer's scene that is not supported, and its replacement, or a name in a model's file that its
   format does not have. */
typedef struct koksma__unknown {
    char file[64], text[256];
    unsigned long line; /* line of the first occurrence in `file`; there are n occurrences */
    size_t n;
} koksma__unknown;

/* A list of them, of which those with equal texts are one. */
enum { KOKSMA__MOST_UNKNOWN = 256 };

/* Counts an occurrence of a text, also in the last entry if the list is full; returns false if the text is new and the list
   has room for it. */
bool koksma__unknown_count(koksma__unknown *list, size_t n, const char *text);

/* Counts an occurrence of a text, which is added if it is new. Error: MEMORY. */
koksma_status koksma__unknown_put(koksma__unknown **list, size_t *n, const char *file, unsigned long line,
                                  const char *text);

/* Returns `status`; if it is MALFORMED, the last text of the list, which may be its cause, is put behind the error's. */
koksma_status koksma__unknown_explain(koksma_status status, const koksma__unknown *list, size_t n);

/* Adds a text that is new. Error: MEMORY. */
koksma_status koksma__unknown_add(koksma__unknown **list, size_t *n, const char *file, unsigned long line,
                                  const char *text);

/* ---- The name that a misspelt one may mean ---- */

/* Words of lists, each cut after 39 bytes. */
typedef struct koksma__word_list {
    char items[96][40];
    size_t n;
} koksma__word_list;

/* Adds the words of a list of `length` bytes, which end at a separator; of each word what is before one of `ends`. */
void koksma__word_list_add(koksma__word_list *to, const char *list, size_t length, const char *separators,
                           const char *ends);

/* The nearest one, as koksma_closest_name(); NULL if none is near. */
const char *koksma__word_list_closest(const koksma__word_list *words, const char *word);

/* "; did you mean 'NAME'?" in `text`, or "" for NULL; returns text. */
enum { KOKSMA__OR_MEANT = 80 };
const char *koksma__or_meant(const char *name, char text[KOKSMA__OR_MEANT]);

#endif
