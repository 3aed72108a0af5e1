/* SPDX-License-Identifier: Apache-2.0 */
/* A mesh file as lines of text, with their numbers. */
#ifndef KOKSMA_MESHES_MESH_LINES_H
#define KOKSMA_MESHES_MESH_LINES_H

#include <string.h>

#include "core/status.h"

enum { KOKSMA__MESH_LINE = 4096 };

typedef struct koksma__lines {
    const char *path;
    const unsigned char *at, *end;
    size_t number; /* of the line that was read last */
    char line[KOKSMA__MESH_LINE];
} koksma__lines;

static inline koksma_status koksma__line_wrong(const koksma__lines *l, const char *reason)
{
    return koksma__fail(KOKSMA_MALFORMED, "%s: line %zu: %s", l->path, l->number, reason);
}

/* The next line as it lies in the file, without its end. Errors: MALFORMED (there is none). */
static inline koksma_status koksma__line_span(koksma__lines *l, const unsigned char **at, size_t *length)
{
    l->number++;
    if (l->at == l->end) {
        return koksma__line_wrong(l, "the file ends before what it claims");
    }
    const unsigned char *stop = memchr(l->at, '\n', (size_t)(l->end - l->at));
    *at = l->at;
    *length = (size_t)((stop ? stop : l->end) - l->at);
    l->at = stop ? stop + 1 : l->end;
    return KOKSMA_OK;
}

/* The next line into l->line. Errors: MALFORMED (there is none, or it is too long or has a zero byte). */
static inline koksma_status koksma__line_next(koksma__lines *l)
{
    const unsigned char *at = l->at;
    size_t length = 0;
    const koksma_status status = koksma__line_span(l, &at, &length);
    if (status) {
        return status;
    }
    if (length >= KOKSMA__MESH_LINE || memchr(at, '\0', length)) {
        return koksma__line_wrong(l, length >= KOKSMA__MESH_LINE ? "longer than 4095 characters"
                                                                 : "not text (a zero byte)");
    }
    memcpy(l->line, at, length);
    length -= length && l->line[length - 1] == '\r';
    l->line[length] = '\0';
    return KOKSMA_OK;
}

#endif
