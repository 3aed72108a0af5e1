/* SPDX-License-Identifier: Apache-2.0 */
/* Lists of what the readers of scenes and models do not read, with file and line. */
#ifndef KOKSMA_MESHES_UNKNOWN_H
#define KOKSMA_MESHES_UNKNOWN_H

#include "core/status.h"

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

/* Returns `status`; if it is MALFORMED, the last text of the list, which may be its cause, is put behind the error's. */
koksma_status koksma__unknown_explain(koksma_status status, const koksma__unknown *list, size_t n);

/* Adds a text that is new. Error: MEMORY. */
koksma_status koksma__unknown_add(koksma__unknown **list, size_t *n, const char *file, unsigned long line,
                                  const char *text);

#endif
