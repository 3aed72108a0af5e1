/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lists of what the readers of scenes and models do not read. An entry has the file and the line of its first occurrence;
 * equal texts are one entry, which counts them. A list has at most KOKSMA__MOST_UNKNOWN entries, because a file may have
 * any number of unknown names; the last one counts the rest.
 */
#include "meshes/unknown.h"

#include <stdio.h>
#include <string.h>

#include "core/capacity.h"

bool koksma__unknown_count(koksma__unknown *list, size_t n, const char *text)
{
    size_t i = 0;
    while (i < n && strcmp(list[i].text, text) != 0) {
        i++;
    }
    if (i == n && n < KOKSMA__MOST_UNKNOWN) {
        return false;
    }
    list[i < n ? i : n - 1].n++;
    return true;
}

koksma_status koksma__unknown_explain(koksma_status status, const koksma__unknown *list, size_t n)
{
    char text[1024];
    if (status != KOKSMA_MALFORMED || !n || koksma__is_refused()) {
        return status;
    }
    snprintf(text, sizeof text, "%s", koksma_error_text());
    return koksma__fail(status, "%s (%s:%lu: %s)", text, list[n - 1].file, list[n - 1].line, list[n - 1].text);
}

koksma_status koksma__unknown_add(koksma__unknown **list, size_t *n, const char *file, unsigned long line,
                                  const char *text)
{
    const char *slash = strrchr(file, '/');
    koksma__unknown *to = koksma__add_one(list, n, sizeof *to);
    KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
    *to = (koksma__unknown){.line = line, .n = 1};
    snprintf(to->file, sizeof to->file, "%s", slash ? slash + 1 : file);
    snprintf(to->text, sizeof to->text, "%s", text);
    return KOKSMA_OK;
}
