/* SPDX-License-Identifier: Apache-2.0 */
/* Reads rows of the store's tables and checks that every column has the type that the schema gives it, because a
   damaged file may hold anything. */
#include <stdio.h>

#include "core/status.h"
#include "study/store/store_internal.h"

static koksma_status fail_row(const koksma__store *store, const char *table, long long id)
{
    return koksma__fail(KOKSMA_MALFORMED,
                        "%s: row %lld of table %s has a value that is infinite, of the wrong type or out of range; "
                        "move it away to begin anew",
                        koksma__database_path(store->database), id, table);
}

koksma_status koksma__store_read_row(koksma__store *store, koksma__statement *s, int column, koksma__row *row)
{
    long long seed;
    const bool right =
        koksma__read(s, column, "wnnnn", &seed, &row->values[0], &row->values[1], &row->values[2], &row->values[3]);
    row->seed = (uint64_t)seed;
    return right && row->id >> 32 < KOKSMA__MOST_TRIALS ? KOKSMA_OK : fail_row(store, "result", row->id);
}

/* Reads the columns of GET_SERIES. */
koksma_status koksma__store_read_series(koksma__store *store, koksma__statement *s, koksma__series *key,
                                        long long *id)
{
    *key = (koksma__series){0};
    const bool right = koksma__read(s, 0, "tttttwwwwttttw", &key->kind, &key->scene, &key->scene_hash, &key->options,
                                    &key->pattern, &key->n, &key->dim, &key->width, &key->height, &key->what,
                                    &key->metric, &key->made_by, &key->measured_by, id);
    key->id = *id;
    return right ? KOKSMA_OK : fail_row(store, "series", *id);
}
