/* SPDX-License-Identifier: Apache-2.0 */
/* Finds and creates the ids of series, and reads their keys. */
#include "core/status.h"
#include "study/store/store_internal.h"

/* The maximum number of series: more would not fit into memory, which must also hold a plan's tasks. */
static const long long MOST_SERIES = 1 << 26;

static void bind_series(koksma__statement *s, const koksma__series *key)
{
    koksma__bind(s, 1, "tttttwwwwtttt", key->kind, key->scene, key->scene_hash, key->options, key->pattern, key->n,
                 key->dim, key->width, key->height, key->made_by, key->what, key->metric, key->measured_by);
}

/* Checks the number of a series; a number out of range is a sign of damage. */
static koksma_status check_number(const koksma__store *store, long long number)
{
    return number >= 0 && number <= MOST_SERIES
               ? KOKSMA_OK
               : koksma__fail(KOKSMA_MALFORMED,
                              "%s: a series has the invalid number %lld; move it away to begin anew",
                              koksma__database_path(store->database), number);
}

static koksma_status last_series(koksma__store *store, long long *last)
{
    koksma__statement *s = store->queries[KOKSMA__LAST_SERIES];
    koksma_status status = KOKSMA_OK;
    *last = 0;
    if (koksma__next_row(store->database, s, &status)) {
        koksma__read(s, 0, "w", last);
    }
    koksma__statement_reset(s);
    return status ? status : check_number(store, *last);
}

static koksma_status add_series(koksma__store *store, const koksma__series *key, long long *id)
{
    koksma__statement *s = store->queries[KOKSMA__ADD_SERIES];
    KOKSMA__TRY(last_series(store, id));
    bind_series(s, key);
    koksma__bind(s, 14, "w", ++*id);
    return koksma__store_write(store, KOKSMA__ADD_SERIES);
}

koksma_status koksma__store_series(koksma__store *store, const koksma__series *series, bool add, long long *id)
{
    koksma__statement *s = store->queries[KOKSMA__FIND_SERIES];
    koksma_status status = KOKSMA_OK;
    koksma__series key;
    koksma__store_enter(store);
    koksma__store_bind_key(store, series, &key);
    bind_series(s, &key);
    *id = 0;
    const bool found = koksma__next_row(store->database, s, &status);
    if (found) {
        koksma__read(s, 0, "w", id);
    }
    koksma__statement_reset(s);
    status = status ? status : check_number(store, *id);
    if (!status && !found && add) {
        status = add_series(store, &key, id);
    }
    return koksma__store_leave(store, status);
}

koksma_status koksma__store_read_series(koksma__store *store, koksma__statement *s, koksma__series *key,
                                        long long *id)
{
    *key = (koksma__series){0};
    const bool right = koksma__read(s, 0, "tttttwwwwttttw", &key->kind, &key->scene, &key->scene_hash, &key->options,
                                    &key->pattern, &key->n, &key->dim, &key->width, &key->height, &key->what,
                                    &key->metric, &key->made_by, &key->measured_by, id);
    key->id = *id;
    KOKSMA__FAIL_IF(!right, KOKSMA_MALFORMED,
                    "%s: row %lld of table series has a value that is infinite, of the wrong type or out of range; "
                    "move it away to begin anew",
                    koksma__database_path(store->database), *id);
    return KOKSMA_OK;
}
