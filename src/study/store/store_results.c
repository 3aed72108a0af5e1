/* SPDX-License-Identifier: Apache-2.0 */
/* Reads results from the store. A scan reads all rows, compares them with the seal, and finds the number of
   trials of each series; results of a series are then looked up trial by trial, or filtered from all rows where
   that is faster. */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "study/store/store_internal.h"

/* Reads all rows in the order of their ids, calls `see` for each result, and compares the rows with the store's
   seal. */
static koksma_status scan(koksma__store *store, void (*see)(void *context, long long series, long long trial),
                          void *context)
{
    koksma__statement *s = store->queries[KOKSMA__GET_IDS];
    koksma__seal found = {0};
    koksma_status status = koksma__store_write_rows(store);
    status = status ? status : koksma__store_know_series(store);
    while (koksma__next_row(store->database, s, &status)) {
        koksma__row row = {.id = koksma__column_whole(s, 0)};
        const long long first = row.id & 0xffffffff;
        status = koksma__store_read_row(store, s, 1, &row);
        koksma__seal_add(&found, 1, koksma__checksum_of_row(&row));
        for (int k = 0; !status && row.id >= 0 && k < KOKSMA__GROUP && (size_t)(first + k) < store->n_known; k++) {
            if (!isnan(row.values[k]) && (k == 0 || !store->known[first].alone)) {
                see(context, first + k, row.id >> 32);
            }
        }
    }
    koksma__statement_reset(s);
    status = status ? status : koksma__seal_rest(store, &found);
    store->found = found;
    return status || store->for_audit || koksma__store_is_sealed(store) ? status : koksma__seal_fail(store);
}

koksma_status koksma__store_scan(koksma__store *store, void (*see)(void *context, long long series, long long trial),
                                 void *context)
{
    koksma__store_enter(store);
    return koksma__store_leave(store, scan(store, see, context));
}

static void see_end(void *context, long long series, long long trial)
{
    koksma__store *store = context;
    koksma__known_series *k = &store->known[series];
    k->end = trial >= k->end ? trial + 1 : k->end;
    k->count++;
}

/* Trials are made in order, except for jobs that were running when a run ended. A trial number far above the
   number of trials is therefore damage; looking up all trials below it would take hours. */
static const long long MOST_HOLES = 100000;

/* Finds the highest trial of every series. */
static koksma_status find_ends(koksma__store *store)
{
    koksma_status status = koksma__store_write_rows(store);
    if (!status && !store->knows_ends) {
        status = scan(store, see_end, store);
        for (size_t i = 0; !status && i < store->n_known; i++) {
            const koksma__known_series *k = &store->known[i];
            if (k->end > MOST_HOLES + MOST_HOLES * k->count) {
                status = koksma__fail(KOKSMA_MALFORMED,
                                      "%s: series %zu has a trial %lld of %lld; move it away to begin anew",
                                      koksma__database_path(store->database), i, k->end - 1, k->count);
            }
        }
        store->knows_ends = !status;
    }
    return status;
}

static long long end_of(const koksma__store *store, long long series)
{
    return series >= 0 && (size_t)series < store->n_known ? store->known[series].end : 0;
}

/* Reads a series' result from a row; false if the row only has results of other series of its group. */
static bool read_result(koksma__statement *s, const koksma__store *store, long long series, koksma__result *result)
{
    const int place = (int)(series - koksma__group_of(series));
    result->trial = koksma__column_whole(s, 0);
    result->seed = (uint64_t)koksma__column_whole(s, 1);
    result->values[0] = koksma__column_number(s, 2 + place);
    for (int k = 1; k < KOKSMA__RESULT_VALUES; k++) {
        result->values[k] = store->known[series].alone ? koksma__column_number(s, 2 + k) : (double)NAN;
    }
    return !isnan(result->values[0]);
}

/* Looking up one row by its id takes about as long as reading this many rows in sequence. */
static const long long ROWS_A_LOOKUP = 8;

/* Calls `visit` for a series' results with trials below `end`, in order; looks trials up one by one, or filters
   all rows where that is faster. */
static koksma_status each_result(koksma__store *store, long long series, long long end, const koksma__series *key,
                                 koksma__row_visitor visit, void *context)
{
    const bool filter = end > 0 && store->found.rows / ROWS_A_LOOKUP <= store->known[series].count;
    koksma__statement *s = store->queries[filter ? KOKSMA__FILTER_RESULTS : KOKSMA__GET_RESULTS];
    koksma_status status = KOKSMA_OK;
    int column = 1;
    koksma__bind_whole(s, &column, koksma__group_of(series));
    koksma__bind_whole(s, &column, end);
    while (end > 0 && koksma__next_row(store->database, s, &status)) {
        koksma__result result;
        if (read_result(s, store, series, &result)) {
            status = visit(context, key, &result);
        }
    }
    koksma__statement_reset(s);
    return status;
}

typedef struct results {
    koksma__result *at;
    size_t n;
} results;

static koksma_status keep_result(void *context, const koksma__series *series, const koksma__result *result)
{
    results *to = context;
    (void)series;
    to->at[to->n++] = *result;
    return KOKSMA_OK;
}

koksma_status koksma__store_results(koksma__store *store, long long series, long long trials, koksma__result **out,
                                    size_t *n)
{
    results to = {0};
    koksma__store_enter(store);
    koksma_status status = find_ends(store);
    const long long all = status ? 0 : end_of(store, series), end = all < trials ? all : trials;
    if (end > 0 && !(to.at = calloc((size_t)end, sizeof *to.at))) {
        status = koksma__fail_memory((size_t)end * sizeof *to.at);
    }
    status = status ? status : each_result(store, series, end, NULL, keep_result, &to);
    *out = to.at;
    *n = to.n;
    return koksma__store_leave(store, status);
}

koksma_status koksma__store_visit(koksma__store *store, koksma__row_visitor visit, void *context)
{
    koksma__statement *s = store->queries[KOKSMA__GET_SERIES];
    koksma__store_enter(store);
    koksma_status status = find_ends(store);
    while (koksma__next_row(store->database, s, &status)) {
        koksma__series series;
        long long id;
        status = koksma__store_read_series(store, s, &series, &id);
        status = status ? status : each_result(store, id, end_of(store, id), &series, visit, context);
    }
    koksma__statement_reset(s);
    return koksma__store_leave(store, status);
}

bool koksma__store_is_sealed(const koksma__store *store)
{
    return store->found.rows == store->seal.rows && store->found.sum == store->seal.sum;
}
