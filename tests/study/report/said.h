/* SPDX-License-Identifier: Apache-2.0 */
/* What a document says: the words of its paragraphs, with the texts of their numbers. */
#ifndef KOKSMA_TEST_SAID_H
#define KOKSMA_TEST_SAID_H

#include <string.h>

#include "study/report/document.h"

/* Reads a text without escapes; returns what follows its closing quote. */
static const char *read_said(const char *at, char *out, size_t size)
{
    const size_t n = strcspn(at, "\"");
    snprintf(out, size, "%.*s", (int)n, at);
    return at + n + 1;
}

/* Into `words`: the texts that stand in arrays, and the members "text". */
static const char *said(const koksma__document *d, char *words, size_t size)
{
    char key[64] = "", text[2048];
    size_t used = 0;
    words[0] = '\0';
    for (const char *at = d->json.text; *at;) {
        if (*at == '"') {
            at = read_said(at + 1, text, sizeof text);
            if (*at == ':') {
                snprintf(key, sizeof key, "%.60s", text);
                at++;
                continue;
            }
            if (!key[0] || !strcmp(key, "text")) {
                used += (size_t)snprintf(words + used, size - used, "%s", text);
            }
            key[0] = '\0';
        } else {
            if (strchr("[{}]", *at)) {
                key[0] = '\0';
            }
            at++;
        }
    }
    return words;
}

#endif
