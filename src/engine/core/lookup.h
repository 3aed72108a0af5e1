/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The lookup functions of a table of named things: by index and by name. Used in the file that defines `table`, an
 * array of pointers to structs with a member `name`:
 *
 *     KOKSMA__LOOKUP(koksma_pattern, table)
 *
 * defines koksma_pattern_at(i), NULL past the end, and koksma_pattern_find(name), NULL if unknown.
 *
 *     KOKSMA__NAME_AT(koksma_pattern)
 *
 * defines koksma_pattern_name_at(NULL, i) for koksma__fail_unknown() below.
 */
#ifndef KOKSMA_CORE_LOOKUP_H
#define KOKSMA_CORE_LOOKUP_H

#include <stddef.h>
#include <string.h>

#include "core/status.h"

#define KOKSMA__LOOKUP(type, table)                                                                                  \
    const type *type##_at(size_t i)                                                                                  \
    {                                                                                                                \
        return i < sizeof(table) / sizeof *(table) ? (table)[i] : NULL;                                              \
    }                                                                                                                \
    const type *type##_find(const char *name)                                                                        \
    {                                                                                                                \
        KOKSMA__REQUIRE_OR(NULL, name);                                                                              \
        for (size_t i = 0; i < sizeof(table) / sizeof *(table); i++) {                                               \
            if (!strcmp((table)[i]->name, name)) {                                                                   \
                return (table)[i];                                                                                   \
            }                                                                                                        \
        }                                                                                                            \
        return NULL;                                                                                                 \
    }

#define KOKSMA__NAME_AT(type)                                                                                        \
    static const char *type##_name_at(const void *unused, size_t i)                                                  \
    {                                                                                                                \
        (void)unused;                                                                                                \
        return type##_at(i) ? type##_at(i)->name : NULL;                                                             \
    }

/* ---- The name that a misspelt word probably means, for messages: koksma_closest_name() of koksma.h ---- */

enum { KOKSMA__MEANT = 96 };

/* Writes "did you mean 'NAME'? " with the nearest name of a table (koksma_closest_name()), or "" if none is near.
   Returns text. */
KOKSMA__LAB const char *koksma__meant(const char *word, koksma_name_at *name, const void *table,
                                      char text[KOKSMA__MEANT]);

/* Fails with KOKSMA_UNKNOWN and "no WHAT 'WORD'; did you mean 'NAME'? WHERE", where WHERE says how to list the known
   names. Names of other programs, a table in suggestion.c, get their counterpart here in its place. `name` and
   `table` are those of koksma_closest_name(). */
KOKSMA__LAB koksma_status koksma__fail_unknown(const char *what, const char *word, koksma_name_at *name,
                                               const void *table, const char *where);

#endif
