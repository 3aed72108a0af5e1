/* SPDX-License-Identifier: Apache-2.0 */
/* What a document says: the words of its paragraphs, with the texts of their numbers. */
#ifndef KOKSMA_TEST_SAID_H
#define KOKSMA_TEST_SAID_H

#include <string.h>

#include "study/report/document.h"

/* Into `words`: the texts that stand in arrays, and the members "text"; none has escapes. */
static const char *said(const koksma__document *d, char *words, size_t size)
{
    size_t used = 0;
    words[0] = '\0';
    for (const char *at = d->json.text, *end; (at = strchr(at, '"')); at = end) {
        const size_t n = strcspn(at + 1, "\"");
        end = at + n + 2;
        if (*end != ':' && (at[-1] != ':' || !strncmp(at - 7, "\"text\":", 7))) {
            used += (size_t)snprintf(words + used, size - used, "%.*s", (int)n, at + 1);
        }
    }
    return words;
}

#endif
