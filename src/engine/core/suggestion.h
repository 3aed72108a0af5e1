/* SPDX-License-Identifier: Apache-2.0 */
/* Suggests the name that a misspelt word probably means, for messages: koksma_closest_name() of koksma.h. */
#ifndef KOKSMA_CORE_SUGGESTION_H
#define KOKSMA_CORE_SUGGESTION_H

#include "core/status.h"

enum { KOKSMA__MEANT = 96 };

/* Writes "did you mean 'NAME'? " with the nearest name of a table (koksma_closest_name()), or "" if none is near.
   Returns text. */
KOKSMA__LAB const char *koksma__meant(const char *word, koksma_name_at *name, const void *table,
                                      char text[KOKSMA__MEANT]);

/* Fails with KOKSMA_UNKNOWN and "no WHAT 'WORD'; did you mean 'NAME'? WHERE", where WHERE says how to list the known
   names. `name` and `table` are those of koksma_closest_name(). */
KOKSMA__LAB koksma_status koksma__fail_unknown(const char *what, const char *word, koksma_name_at *name,
                                               const void *table, const char *where);

#endif
