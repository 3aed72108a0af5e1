/* SPDX-License-Identifier: Apache-2.0 */
/* Cases in a file, one a line: what is expected, " | ", a text. In the text \n ends a line, and a name in braces stands for
   what many texts share. */
#ifndef KOKSMA_TESTS_TEXTS_H
#define KOKSMA_TESTS_TEXTS_H

#include <string.h>

#include "test.h"

typedef struct shared_text {
    const char *name, *text; /* the last has the name NULL */
} shared_text;

/* Makes the text that stands at `from` in a line. */
static inline void fill_text(const char *from, const shared_text *shared, char *text, size_t size)
{
    size_t used = 0;
    while (*from && *from != '\n') {
        const shared_text *s = shared;
        while (s->name && strncmp(from, s->name, strlen(s->name)) != 0) {
            s++;
        }
        const bool ends = !strncmp(from, "\\n", 2);
        used += (size_t)(s->name ? snprintf(text + used, size - used, "%s", s->text)
                                 : snprintf(text + used, size - used, "%c", ends ? '\n' : *from));
        from += s->name ? strlen(s->name) : ends ? 2 : 1;
        assert_true(used < size);
    }
    text[used] = '\0';
}

/* Calls f for each case of the file, a path below tests/. Returns how many there are. */
static inline size_t each_text(const char *name, const shared_text *shared,
                               void (*f)(const char *expected, const char *text))
{
    char line[2048], text[4096];
    size_t n = 0;
    snprintf(text, sizeof text, "%s/%s", KOKSMA_TESTS, name);
    FILE *file = fopen(text, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        char *bar = *line == '#' ? NULL : strstr(line, " | ");
        if (bar) {
            *bar = '\0';
            fill_text(bar + 3, shared, text, sizeof text);
            f(line, text);
            n++;
        }
    }
    fclose(file);
    return n;
}

#endif
