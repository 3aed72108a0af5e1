/* SPDX-License-Identifier: Apache-2.0 */
/* Writes results to the store. Results are gathered into rows in one buffer while the rows of a second buffer are
   written, KOKSMA__ROWS_AT_ONCE with one statement where possible. */
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

koksma_status koksma__store_read_row(koksma__store *store, koksma__statement *s, koksma__row *row)
{
    long long seed;
    const bool right = koksma__read(s, 0, "wwnnnn", &row->id, &seed, &row->values[0], &row->values[1],
                                    &row->values[2], &row->values[3]);
    row->seed = (uint64_t)seed;
    KOKSMA__FAIL_IF(!right || row->id < 0 || row->id >> 32 >= KOKSMA__MOST_TRIALS, KOKSMA_MALFORMED,
                    "%s: row %lld of table result has a value that is infinite, of the wrong type or out of range; "
                    "move it away to begin anew",
                    koksma__database_path(store->database), row->id);
    return KOKSMA_OK;
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
    store->sorted = store->sorted && !taken.n;
    koksma_status status = taken.n || store->in_transaction ? koksma__store_begin(store) : KOKSMA_OK;
    for (size_t i = 0, n; !status && i < taken.n; i += n) {
        n = taken.n - i >= KOKSMA__ROWS_AT_ONCE ? KOKSMA__ROWS_AT_ONCE : 1;
        koksma__statement *s = store->queries[n > 1 ? KOKSMA__PUT_ROWS : KOKSMA__PUT_ROW];
        for (size_t k = 0; k < n; k++) {
            bind_row(s, (int)k, &taken.at[i + k]);
        }
        status = koksma__store_wrote(store, koksma__statement_run(store->database, s));
    }
    return status ? status : koksma__store_end(store);
}

static long long row_id(long long series, long long trial)
{
    return (long long)((unsigned long long)trial << 32 | (unsigned long long)series);
}

koksma_status koksma__store_put(koksma__store *store, const long long *series, const koksma__result *results,
                                size_t n)
{
    for (size_t i = 0; i < n;) {
        pthread_mutex_lock(&store->gather_lock);
        koksma__rows *to = &store->gathered;
        for (; i < n && to->n < MOST_GATHERED; i++) {
            koksma__row *row = &to->at[to->n++];
            *row = (koksma__row){.id = row_id(series[i], results[i].trial), .seed = results[i].seed};
            memcpy(row->values, results[i].values, sizeof row->values);
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

koksma_status koksma__store_row(koksma__store *store, long long series, koksma__result *result, bool *found)
{
    koksma__statement *s = store->queries[KOKSMA__GET_ROW];
    koksma_status status = KOKSMA_OK;
    koksma__row row = {0};
    koksma__store_enter(store);
    koksma__bind(s, 1, "w", row_id(series, result->trial));
    *found = koksma__next_row(store->database, s, &status);
    if (*found) {
        status = koksma__store_read_row(store, s, &row);
    }
    koksma__statement_reset(s);
    result->seed = row.seed;
    memcpy(result->values, row.values, sizeof row.values);
    return koksma__store_leave(store, status);
}

koksma_status koksma__store_commit(koksma__store *store)
{
    koksma__store_enter(store);
    return koksma__store_leave(store, koksma__store_write_rows(store));
}
