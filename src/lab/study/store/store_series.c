/* SPDX-License-Identifier: Apache-2.0 */
/* Finds and creates the ids of series, and records which series have rows of their own (images, coherences and
   metrics) and which share rows with up to three other series. */
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"
#include "study/store/store_internal.h"

/* The maximum number of series: more would not fit into memory, which must also hold a plan's tasks. */
static const long long MOST_SERIES = 1 << 26;

/* Binds the part of the key that all series of a group share: all columns up to the height, and the revisions of the
   points. */
static void bind_group(koksma__statement *s, const koksma__series *key)
{
    koksma__bind(s, 1, "tttttwwwwt", key->kind, key->scene, key->scene_hash, key->options, key->pattern, key->n,
                 key->dim, key->width, key->height, key->made_by);
}

static void bind_series(koksma__statement *s, const koksma__series *key)
{
    bind_group(s, key);
    koksma__bind(s, 11, "ttt", key->what, key->metric, key->measured_by);
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

/* Finds the id for a new series: the next in its group, or the first of a new group. */
static koksma_status next_series(koksma__store *store, const koksma__series *key, long long *id)
{
    koksma__statement *s = store->queries[KOKSMA__NEXT_SERIES];
    koksma_status status = KOKSMA_OK;
    long long last = 0, last_of_all = 0;
    bind_group(s, key);
    if (koksma__next_row(store->database, s, &status)) {
        koksma__read(s, 0, "ww", &last, &last_of_all);
    }
    koksma__statement_reset(s);
    status = status ? status : check_number(store, last);
    status = status ? status : check_number(store, last_of_all);
    if (!status) {
        *id = (last + 1) % KOKSMA__GROUP && last ? last + 1 : koksma__group_of(last_of_all) + KOKSMA__GROUP;
    }
    return status;
}

static koksma_status add_series(koksma__store *store, const koksma__series *key, long long *id)
{
    koksma__statement *s = store->queries[KOKSMA__ADD_SERIES];
    KOKSMA__TRY(next_series(store, key, id));
    bind_series(s, key);
    koksma__bind(s, 14, "w", *id);
    const koksma_status status = koksma__store_write(store, KOKSMA__ADD_SERIES);
    koksma__store_forget(store);
    return status;
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

koksma_status koksma__store_know_series(koksma__store *store)
{
    koksma__statement *s = store->queries[KOKSMA__GET_SERIES];
    long long last;
    if (store->known) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(last_series(store, &last));
    koksma_status status = KOKSMA_OK;
    store->n_known = (size_t)last + 1;
    store->known = calloc(store->n_known, sizeof *store->known);
    KOKSMA__REQUIRE_MEMORY(store->known, store->n_known * sizeof *store->known);
    while (koksma__next_row(store->database, s, &status)) {
        koksma__series key;
        long long id;
        status = koksma__store_read_series(store, s, &key, &id);
        if (!status && id >= 0 && (size_t)id < store->n_known) {
            store->known[id].alone = strcmp(key.kind, "discrepancy") != 0;
        }
    }
    koksma__statement_reset(s);
    return status;
}

void koksma__store_forget(koksma__store *store)
{
    KOKSMA__FREE(store->known, store->kept.rows.at, store->kept.order, store->kept.first);
    store->kept = (koksma__kept_rows){.all = false};
    store->known = NULL;
    store->n_known = 0;
    store->knows_ends = false;
}
