/* SPDX-License-Identifier: Apache-2.0 */
/* Writes results to the store. Results are gathered into rows in one buffer while the rows of a second buffer are
   written, KOKSMA__ROWS_AT_ONCE with one statement where possible. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/status.h"
#include "study/store/store_internal.h"

enum { MOST_GATHERED = 1 << 14 };

koksma_status koksma__store_rows_init(koksma__store *store)
{
    const size_t bytes = MOST_GATHERED * sizeof *store->gathered.at;
    pthread_mutex_init(&store->gather_lock, NULL);
    store->gathered.at = malloc(bytes);
    store->spare.at = malloc(bytes);
    return store->gathered.at && store->spare.at ? KOKSMA_OK : koksma__fail_memory(2 * bytes);
}

void koksma__store_rows_fini(koksma__store *store)
{
    pthread_mutex_destroy(&store->gather_lock);
    free(store->gathered.at);
    free(store->spare.at);
}

/* Binds row number k of a statement. */
static void bind_row(koksma__statement *s, int k, const koksma__row *from)
{
    _Static_assert(KOKSMA__RESULT_VALUES == 4, "as the statement has it");
    koksma__bind(s, 1 + 6 * k, "wwnnnn", from->id, (long long)from->seed, from->values[0], from->values[1],
                 from->values[2], from->values[3]);
}

static koksma_status find_row(koksma__store *store, koksma__row *row, bool *found)
{
    koksma__statement *s = store->queries[KOKSMA__GET_ROW];
    koksma_status status = KOKSMA_OK;
    koksma__bind(s, 1, "w", row->id);
    *found = koksma__next_row(store->database, s, &status);
    if (*found) {
        status = koksma__store_read_row(store, s, 0, row);
    }
    koksma__statement_reset(s);
    return status;
}

/* Writes one row. If the row exists, its values are kept, and only missing values are taken from `from`. */
static koksma_status put_one(koksma__store *store, const koksma__row *from)
{
    koksma__row row = {.id = from->id};
    bool found;
    KOKSMA__TRY(find_row(store, &row, &found));
    row = found ? row : *from;
    for (int k = 0; k < KOKSMA__RESULT_VALUES; k++) {
        row.values[k] = isnan(row.values[k]) ? from->values[k] : row.values[k];
    }
    bind_row(store->queries[KOKSMA__PUT_ROW], 0, &row);
    return koksma__statement_run(store->database, store->queries[KOKSMA__PUT_ROW]);
}

/* Writes up to ROWS_AT_ONCE rows; *done is their number. The statement stops at a row that exists already, which is
   rare: put_one merges this row, because it may lack values of other series in its group. */
static koksma_status put_many(koksma__store *store, const koksma__row *from, size_t *done)
{
    koksma__statement *s = store->queries[KOKSMA__PUT_ROWS];
    for (int k = 0; k < KOKSMA__ROWS_AT_ONCE; k++) {
        bind_row(s, k, &from[k]);
    }
    koksma_status status = koksma__statement_run(store->database, s);
    const bool conflict = status && koksma__database_had_conflict(store->database);
    if (status && !conflict) {
        return status;
    }
    *done = (size_t)koksma__database_changes(store->database);
    return conflict ? put_one(store, &from[(*done)++]) : KOKSMA_OK;
}

/* The caller holds the store's lock, so that no other thread uses the spare buffer. */
koksma_status koksma__store_write_rows(koksma__store *store)
{
    pthread_mutex_lock(&store->gather_lock);
    const koksma__rows taken = store->gathered;
    store->gathered = (koksma__rows){0, store->spare.at};
    store->spare.at = taken.at;
    store->written_s = koksma__now_s();
    pthread_mutex_unlock(&store->gather_lock);
    if (taken.n) { /* what was read about series earlier is now out of date */
        koksma__store_forget(store);
    }
    koksma_status status = taken.n || store->in_transaction ? koksma__store_begin(store) : KOKSMA_OK;
    for (size_t i = 0, done = 1; !status && i < taken.n; i += done, done = 1) {
        status =
            taken.n - i >= KOKSMA__ROWS_AT_ONCE ? put_many(store, &taken.at[i], &done) : put_one(store, &taken.at[i]);
        koksma__store_wrote(store, status);
    }
    return status ? status : koksma__store_end(store);
}

static long long row_id(long long series, long long trial)
{
    return (long long)((unsigned long long)trial << 32 | (unsigned long long)koksma__group_of(series));
}

/* Adds a result to the last gathered row, or to a new one; the buffer must have a free row. */
static void gather(koksma__rows *to, long long series, const koksma__result *result)
{
    const long long id = row_id(series, result->trial);
    const int place = (int)(series - koksma__group_of(series));
    if (to->n == 0 || to->at[to->n - 1].id != id) {
        to->at[to->n++] = (koksma__row){id, result->seed, {NAN, NAN, NAN, NAN}};
    }
    koksma__row *r = &to->at[to->n - 1];
    for (int k = 0; place + k < KOKSMA__RESULT_VALUES; k++) {
        r->values[place + k] = isnan(r->values[place + k]) ? result->values[k] : r->values[place + k];
    }
}

koksma_status koksma__store_put(koksma__store *store, const long long *series, const koksma__result *results,
                                size_t n)
{
    for (size_t i = 0; i < n;) {
        pthread_mutex_lock(&store->gather_lock);
        koksma__rows *to = &store->gathered;
        for (; i < n && to->n < MOST_GATHERED; i++) {
            gather(to, series[i], &results[i]);
        }
        const bool write = i < n || koksma__now_s() - store->written_s > KOKSMA__WRITE_AFTER_S;
        pthread_mutex_unlock(&store->gather_lock);
        if (write) {
            koksma__store_enter(store);
            KOKSMA__TRY(koksma__store_leave(store, koksma__store_write_rows(store)));
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__store_row(koksma__store *store, long long group, long long trial, uint64_t *seed,
                                double values[KOKSMA__RESULT_VALUES], bool *found)
{
    koksma__row row = {.id = row_id(group, trial)};
    koksma__store_enter(store);
    const koksma_status status = find_row(store, &row, found);
    *seed = row.seed;
    memcpy(values, row.values, sizeof row.values);
    return koksma__store_leave(store, status);
}

koksma_status koksma__store_commit(koksma__store *store)
{
    koksma__store_enter(store);
    return koksma__store_leave(store, koksma__store_write_rows(store));
}
