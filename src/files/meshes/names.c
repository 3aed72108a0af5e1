/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finding is by a digital search tree (Knuth, The Art of Computer Programming, volume 3, section 6.3): the bits of a
 * name's hash lead from the root down, to the node that has this hash or to where it belongs. Every node at depth d has
 * the first d bits of its hash in common with all nodes below it, so no path is longer than the hash's 64 bits,
 * whatever names a file has; a hash table would take as many steps as there are names whose hashes begin alike, which
 * are easy to craft. Names themselves are not compared: two of a scene's names have the same 64 bits by chance once in
 * 10^7 scenes of a million names, and a file that does it on purpose only confuses its own names.
 *
 * In the list of what the readers of scenes and models do not read, an entry has the file and the line of its first
 * occurrence; equal texts are one entry, which counts them. A list has at most KOKSMA__MOST_UNKNOWN entries, because a file
 * may have any number of unknown names; the last one counts the rest.
 */
#include "meshes/names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/hash.h"

/* The index of the node that has this hash; if there is none, names->n, and *link is where the index of a new node has
   to be written (NULL for the root). */
static size_t node_of(const koksma__names *names, uint64_t hash, size_t **link)
{
    size_t at = 0;
    *link = NULL;
    for (uint64_t bits = hash; at < names->n && names->nodes[at].hash != hash; bits >>= 1) {
        *link = &names->nodes[at].next[bits & 1];
        at = **link ? **link : names->n;
    }
    return at;
}

koksma_status koksma__names_put(koksma__names *names, const char *name, size_t length, size_t index)
{
    const uint64_t hash = koksma__hash(name, length);
    size_t *link;
    KOKSMA__TRY(koksma__reserve(&names->nodes, &names->capacity, names->n + 1, sizeof *names->nodes));
    const size_t at = node_of(names, hash, &link);
    if (at == names->n) {
        names->nodes[names->n++] = (koksma__names_node){.hash = hash};
        if (link) {
            *link = at;
        }
    }
    names->nodes[at].index = index;
    return KOKSMA_OK;
}

bool koksma__names_find(const koksma__names *names, const char *name, size_t length, size_t *index)
{
    size_t *link;
    const size_t at = node_of(names, koksma__hash(name, length), &link);
    *index = at < names->n ? names->nodes[at].index : 0;
    return at < names->n;
}

void koksma__names_fini(koksma__names *names)
{
    free(names->nodes);
    *names = (koksma__names){0};
}

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

koksma_status koksma__unknown_put(koksma__unknown **list, size_t *n, const char *file, unsigned long line,
                                  const char *text)
{
    return koksma__unknown_count(*list, *n, text) ? KOKSMA_OK : koksma__unknown_add(list, n, file, line, text);
}

void koksma__word_list_add(koksma__word_list *to, const char *list, size_t length, const char *separators,
                           const char *ends)
{
    for (size_t from = 0; from < length && to->n < sizeof to->items / sizeof *to->items;) {
        const size_t whole = strcspn(list + from, separators), word = strcspn(list + from, ends);
        const size_t left = length - from, shortest = word < whole ? word : whole;
        snprintf(to->items[to->n++], sizeof *to->items, "%.*s", (int)(shortest < left ? shortest : left),
                 list + from);
        from += whole + 1;
    }
}

static const char *word_at(const void *from, size_t i)
{
    const koksma__word_list *w = from;
    return i < w->n ? w->items[i] : NULL;
}

const char *koksma__word_list_closest(const koksma__word_list *words, const char *word)
{
    return koksma_closest_name(word, word_at, words);
}

const char *koksma__or_meant(const char *name, char text[KOKSMA__OR_MEANT])
{
    *text = '\0';
    if (name) {
        snprintf(text, KOKSMA__OR_MEANT, "; did you mean '%.50s'?", name);
    }
    return text;
}
