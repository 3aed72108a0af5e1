/* SPDX-License-Identifier: Apache-2.0 */
/* The rows of a store: finds and creates the ids of their series, writes results and reads them. Results are gathered into
   rows in one buffer while the rows of a second buffer are written, KOKSMA__ROWS_AT_ONCE with one statement where possible.
   They are in the order in which runs make them; to read the results of one series after another, SQLite first sorts them
   into the temporary table `sorted`. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/clock.h"
#include "core/status.h"
#include "study/store/store_internal.h"

/* The maximum number of series: more would not fit into memory, which must also hold a plan's tasks. */
static const long long MOST_SERIES = 1 << 26;

/* ---- Series ---------------------------------------------------------------------------------------------------- */

static void bind_series(koksma__statement *s, const koksma__series *key)
{
    koksma__bind(s, 1, "tttttwwwwtttt", key->kind, key->scene, key->scene_hash, key->options, key->pattern, key->n,
                 key->dim, key->width, key->height, key->made_by, key->what, key->metric, key->measured_by);
}

/* Reads the id that the statement returns, if it returns one. A number out of range is a sign of damage. */
static koksma_status read_id(koksma__store *store, koksma__query query, long long *id)
{
    koksma__statement *s = store->queries[query];
    koksma_status status = KOKSMA_OK;
    *id = 0;
    if (koksma__next_row(store->database, s, &status)) {
        koksma__read(s, 0, "w", id);
    }
    koksma__statement_reset(s);
    KOKSMA__FAIL_IF(!status && (*id < 0 || *id > MOST_SERIES), KOKSMA_MALFORMED,
                    "%s: a series has the invalid number %lld; move it away to begin anew",
                    koksma__database_path(store->database), *id);
    return status;
}

koksma_status koksma__store_series(koksma__store *store, const koksma__series *series, bool add, long long *id)
{
    koksma__series key;
    koksma__store_enter(store);
    koksma__store_bind_key(store, series, &key);
    bind_series(store->queries[KOKSMA__FIND_SERIES], &key);
    koksma_status status = read_id(store, KOKSMA__FIND_SERIES, id);
    if (!status && !*id && add) {
        bind_series(store->queries[KOKSMA__ADD_SERIES], &key);
        status = koksma__store_begin(store);
        status = status ? status : koksma__store_wrote(store, read_id(store, KOKSMA__ADD_SERIES, id));
        status = status ? status : koksma__store_tick(store);
    }
    return koksma__store_leave(store, status);
}

/* Reads the current row of the statement GET_SERIES. Fails if a column has not the type that the schema gives it, because
   a damaged file may hold anything. */
static koksma_status read_series(koksma__store *store, koksma__statement *s, koksma__series *key, long long *id)
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

/* ---- Writing --------------------------------------------------------------------------------------------------- */

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

/* Reads and checks the current row of a statement that returns rows of table result. */
static koksma_status read_row(koksma__store *store, koksma__statement *s, koksma__row *row)
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
        status = read_row(store, s, &row);
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

/* ---- Reading --------------------------------------------------------------------------------------------------- */

koksma_status koksma__store_scan(koksma__store *store, bool every,
                                 void (*see)(void *context, long long series, long long trial), void *context)
{
    koksma__statement *s = store->queries[KOKSMA__GET_ROWS];
    koksma__row row;
    koksma__store_enter(store);
    koksma_status status = koksma__store_write_rows(store);
    while (koksma__next_row(store->database, s, &status)) {
        status = read_row(store, s, &row);
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
        status = read_row(store, s, &row);
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
        status = read_series(store, s, &series, &id);
        status = status ? status : each_result(store, id, INT64_MAX, &series, visit, context);
    }
    koksma__statement_reset(s);
    return koksma__store_leave(store, status);
}
