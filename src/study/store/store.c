/* SPDX-License-Identifier: Apache-2.0 */
/* The store's lock and transactions; texts, references and runs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/processor_clock.h"
#include "core/status.h"
#include "study/store/store_internal.h"

void koksma__store_enter(koksma__store *store)
{
    pthread_mutex_lock(&store->lock);
    store->entered_s = koksma__thread_s();
}

koksma_status koksma__store_leave(koksma__store *store, koksma_status status)
{
    store->seconds += koksma__thread_s() - store->entered_s;
    pthread_mutex_unlock(&store->lock);
    return status;
}

double koksma__store_seconds(koksma__store *store)
{
    pthread_mutex_lock(&store->lock);
    const double seconds = store->seconds;
    pthread_mutex_unlock(&store->lock);
    return seconds;
}

/* ---- Transactions -------------------------------------------------------------------------------------- */

koksma_status koksma__store_begin(koksma__store *store)
{
    if (store->in_transaction) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__database_execute(store->database, "BEGIN IMMEDIATE");
    store->in_transaction = !status;
    store->began_s = koksma__now_s();
    return status;
}

koksma_status koksma__store_end(koksma__store *store)
{
    if (!store->in_transaction) {
        return KOKSMA_OK;
    }
    store->in_transaction = false;
    return koksma__database_execute(store->database, "COMMIT");
}

koksma_status koksma__store_write(koksma__store *store, koksma__query query)
{
    koksma_status status = koksma__store_begin(store);
    status = status ? status : koksma__statement_run(store->database, store->queries[query]);
    if (!status && koksma__now_s() - store->began_s > KOKSMA__WRITE_AFTER_S) {
        status = koksma__store_end(store);
    }
    return status;
}

/* ---- Texts --------------------------------------------------------------------------------------------- */

koksma_status koksma__store_put_text(koksma__store *store, const char *key, const char *value)
{
    koksma__statement *s = store->queries[KOKSMA__PUT_TEXT];
    int column = 1;
    koksma__bind_text(s, &column, key);
    koksma__bind_text(s, &column, value);
    return koksma__store_write(store, KOKSMA__PUT_TEXT);
}

koksma_status koksma__store_find_text(koksma__store *store, const char *key, char **value)
{
    koksma__statement *s = store->queries[KOKSMA__GET_TEXT];
    koksma_status status = KOKSMA_OK;
    int column = 1;
    koksma__bind_text(s, &column, key);
    const bool found = koksma__next_row(store->database, s, &status);
    *value = found ? strdup(koksma__column_text(s, 0)) : NULL;
    if (found && !*value) {
        status = koksma__fail_memory(1);
    }
    koksma__statement_reset(s);
    return status;
}

koksma_status koksma__store_set_text(koksma__store *store, const char *key, const char *value)
{
    koksma__store_enter(store);
    return koksma__store_leave(store, koksma__store_put_text(store, key, value));
}

koksma_status koksma__store_get_text(koksma__store *store, const char *key, char **value)
{
    koksma__store_enter(store);
    return koksma__store_leave(store, koksma__store_find_text(store, key, value));
}

/* ---- References and runs ------------------------------------------------------------------------------- */

void koksma__store_bind_hash(koksma__store *store, koksma__statement *s, int *column, const koksma__series *series,
                             const char *spec)
{
    koksma__hash_with_points(&store->files, series->scene_hash, spec, store->hash);
    koksma__bind_text(s, column, store->hash);
}

static void bind_reference(koksma__store *store, koksma__statement *s, int *column, const koksma__series *series)
{
    koksma__bind_text(s, column, series->scene);
    koksma__store_bind_hash(store, s, column, series, series->what);
    koksma__bind_text(s, column, series->options);
    koksma__bind_whole(s, column, series->width);
    koksma__bind_whole(s, column, series->height);
    koksma__bind_text(s, column, series->what);
}

koksma_status koksma__store_put_reference(koksma__store *store, const koksma__series *series, double standard_error)
{
    koksma__statement *s = store->queries[KOKSMA__PUT_REFERENCE];
    int column = 1;
    koksma__store_enter(store);
    bind_reference(store, s, &column, series);
    koksma__bind_number(s, &column, standard_error);
    return koksma__store_leave(store, koksma__store_write(store, KOKSMA__PUT_REFERENCE));
}

koksma_status koksma__store_reference(koksma__store *store, const koksma__series *series, double *standard_error)
{
    koksma__statement *s = store->queries[KOKSMA__GET_REFERENCE];
    koksma_status status = KOKSMA_OK;
    int column = 1;
    koksma__store_enter(store);
    bind_reference(store, s, &column, series);
    *standard_error = koksma__next_row(store->database, s, &status) ? koksma__column_number(s, 0) : (double)NAN;
    koksma__statement_reset(s);
    return koksma__store_leave(store, status);
}

koksma_status koksma__store_put_run(koksma__store *store, const koksma__run_record *record)
{
    koksma__statement *s = store->queries[KOKSMA__PUT_RUN];
    int column = 1;
    koksma__store_enter(store);
    koksma__bind_text(s, &column, record->started);
    koksma__bind_text(s, &column, record->machine);
    koksma__bind_text(s, &column, record->version);
    koksma__bind_whole(s, &column, record->workers);
    koksma__bind_whole(s, &column, record->jobs);
    koksma__bind_number(s, &column, record->seconds);
    koksma__bind_number(s, &column, record->idle_seconds);
    koksma__bind_number(s, &column, record->processor_seconds);
    koksma__bind_number(s, &column, record->store_seconds);
    return koksma__store_leave(store, koksma__store_write(store, KOKSMA__PUT_RUN));
}

koksma_status koksma__store_run(koksma__store *store, long long i, koksma__run_record *record, bool *found)
{
    koksma__statement *s = store->queries[KOKSMA__GET_RUN];
    koksma_status status = KOKSMA_OK;
    int column = 1;
    koksma__store_enter(store);
    koksma__bind_whole(s, &column, i);
    *found = koksma__next_row(store->database, s, &status);
    if (*found) {
        snprintf(record->started, sizeof record->started, "%s", koksma__column_text(s, 0));
        snprintf(record->machine, sizeof record->machine, "%s", koksma__column_text(s, 1));
        snprintf(record->version, sizeof record->version, "%s", koksma__column_text(s, 2));
        record->workers = koksma__column_whole(s, 3);
        record->jobs = koksma__column_whole(s, 4);
        record->seconds = koksma__column_number(s, 5);
        record->idle_seconds = koksma__column_number(s, 6);
        record->processor_seconds = koksma__column_number(s, 7);
        record->store_seconds = koksma__column_number(s, 8);
    }
    koksma__statement_reset(s);
    return koksma__store_leave(store, status);
}
