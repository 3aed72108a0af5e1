/* SPDX-License-Identifier: Apache-2.0 */
/* Reads results from the store. The rows of table result are in the order in which runs make them; to read the results of
   one series after another, SQLite first sorts them into the temporary table `sorted`. */
#include <math.h>

#include "core/capacity.h"
#include "core/status.h"
#include "study/store/store_internal.h"

koksma_status koksma__store_scan(koksma__store *store, bool every,
                                 void (*see)(void *context, long long series, long long trial), void *context)
{
    koksma__statement *s = store->queries[KOKSMA__GET_ROWS];
    koksma__row row;
    koksma__store_enter(store);
    koksma_status status = koksma__store_write_rows(store);
    while (koksma__next_row(store->database, s, &status)) {
        status = koksma__store_read_row(store, s, &row);
        if (!status && (every || !isnan(row.values[0]))) {
            see(context, row.id & 0xffffffff, row.id >> 32);
        }
    }
    koksma__statement_reset(s);
    return koksma__store_leave(store, status);
}

static koksma_status sort_rows(koksma__store *store)
{
    KOKSMA__TRY(koksma__store_write_rows(store));
    const koksma_status status =
        store->sorted ? KOKSMA_OK
                      : koksma__database_execute(store->database,
                                                 "DELETE FROM sorted; INSERT INTO sorted SELECT id & 4294967295, "
                                                 "id >> 32, seed, v0, v1, v2, v3 FROM result ORDER BY 1, 2");
    store->sorted = !status;
    return status;
}

/* Calls `visit` for the results of a series with trials below `trials`, in their order. A row without a value is none. */
static koksma_status each_result(koksma__store *store, long long id, long long trials, const koksma__series *series,
                                 koksma__row_visitor visit, void *context)
{
    koksma__statement *s = store->queries[KOKSMA__GET_RESULTS];
    koksma_status status = KOKSMA_OK;
    koksma__row row;
    koksma__bind(s, 1, "ww", id, trials);
    while (koksma__next_row(store->database, s, &status)) {
        status = koksma__store_read_row(store, s, &row);
        if (!status && !isnan(row.values[0])) {
            const double *v = row.values;
            status = visit(context, series, &(koksma__result){row.id >> 32, row.seed, {v[0], v[1], v[2], v[3]}});
        }
    }
    koksma__statement_reset(s);
    return status;
}

typedef struct results {
    koksma__result *at;
    size_t n, capacity;
} results;

static koksma_status keep_result(void *context, const koksma__series *series, const koksma__result *result)
{
    results *to = context;
    (void)series;
    KOKSMA__TRY(koksma__reserve(&to->at, &to->capacity, to->n + 1, sizeof *to->at));
    to->at[to->n++] = *result;
    return KOKSMA_OK;
}

koksma_status koksma__store_results(koksma__store *store, long long series, long long trials, koksma__result **out,
                                    size_t *n)
{
    results to = {0};
    koksma__store_enter(store);
    koksma_status status = sort_rows(store);
    status = status ? status : each_result(store, series, trials, NULL, keep_result, &to);
    *out = to.at;
    *n = to.n;
    return koksma__store_leave(store, status);
}

koksma_status koksma__store_visit(koksma__store *store, koksma__row_visitor visit, void *context)
{
    koksma__statement *s = store->queries[KOKSMA__GET_SERIES];
    koksma__store_enter(store);
    koksma_status status = sort_rows(store);
    while (koksma__next_row(store->database, s, &status)) {
        koksma__series series;
        long long id;
        status = koksma__store_read_series(store, s, &series, &id);
        status = status ? status : each_result(store, id, INT64_MAX, &series, visit, context);
    }
    koksma__statement_reset(s);
    return koksma__store_leave(store, status);
}
