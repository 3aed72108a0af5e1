/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds the name that a misspelt word probably means: the name that the fewest edits turn the word into. An edit
 * inserts, deletes or replaces a character or swaps two neighbours (Damerau 1964). No edit is made inside a swapped
 * pair (the "optimal string alignment" distance); the dynamic programme stores three rows of its table. A word that
 * is the beginning of a name counts as one edit away, so that `jitter` means jittered. Among equally close names the
 * one with the longer common beginning wins, and among these the first in the table.
 */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "core/lookup.h"

enum { MAX_WORD = 64 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static size_t common_beginning(const char *a, const char *b)
{
    size_t i = 0;
    while (a[i] && a[i] == b[i]) {
        i++;
    }
    return i;
}

static bool equal(char a, char b)
{
    return tolower((unsigned char)a) == tolower((unsigned char)b);
}

static size_t edits(const char *a, size_t n, const char *b, size_t m)
{
    /* rows[i % 3][j]: distance between the first i characters of a and the first j of b */
    size_t rows[3][MAX_WORD + 1] = {{0}};
    for (size_t j = 0; j <= m; j++) {
        rows[0][j] = j;
    }
    for (size_t i = 1; i <= n; i++) {
        size_t *row = rows[i % 3];
        const size_t *last = rows[(i + 2) % 3], *before = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= m; j++) {
            row[j] = least(least(last[j], row[j - 1]) + 1, last[j - 1] + !equal(a[i - 1], b[j - 1]));
            if (i > 1 && j > 1 && equal(a[i - 1], b[j - 2]) && equal(a[i - 2], b[j - 1])) {
                row[j] = least(row[j], before[j - 2] + 1);
            }
        }
    }
    return rows[n % 3][m];
}

const char *koksma_closest_name(const char *word, koksma_name_at *name, const void *table)
{
    KOKSMA__REQUIRE_OR(NULL, word, name);
    const size_t length = strlen(word);
    if (length == 0 || length > MAX_WORD) {
        return NULL;
    }
    const char *closest = NULL, *candidate;
    size_t fewest = 1 + (length + 1) / 3; /* largest number of edits between a word and a name that resembles it */
    for (size_t i = 0; (candidate = name(table, i)) != NULL; i++) {
        const size_t beginning = common_beginning(word, candidate), size = strlen(candidate);
        if (size > MAX_WORD) {
            continue;
        }
        const size_t distance = length >= 3 && beginning == length ? 1 : edits(word, length, candidate, size);
        if (distance < fewest || (distance == fewest && closest && beginning > common_beginning(word, closest))) {
            fewest = distance;
            closest = candidate;
        }
    }
    return closest;
}

const char *koksma__meant(const char *word, koksma_name_at *name, const void *table, char text[KOKSMA__MEANT])
{
    const char *closest = koksma_closest_name(word, name, table);
    snprintf(text, KOKSMA__MEANT, closest ? "did you mean '%s'? " : "%.0s", closest ? closest : "");
    return text;
}

koksma_status koksma__fail_unknown(const char *what, const char *word, koksma_name_at *name, const void *table,
                                   const char *where)
{
    char meant[KOKSMA__MEANT];
    return koksma__fail(KOKSMA_UNKNOWN, "no %s '%s'; %s%s", what, word, koksma__meant(word, name, table, meant),
                        where);
}
