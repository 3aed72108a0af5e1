/* SPDX-License-Identifier: Apache-2.0 */
/* Reads results from the store. A scan reads all rows, compares them with the seal, finds the number of trials of
   each series, and keeps up to MOST_KEPT rows in memory. Results of a series are then looked up trial by trial, or
   filtered from all rows where that is faster, in memory or, for larger stores, in the database. */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "study/store/store_internal.h"

/* 24 MiB */
enum { MOST_KEPT = 1 << 19 };

/* Keeps a row in memory; returns false if there are too many rows, or no memory is left. */
static bool keep(koksma__kept_rows *kept, const koksma__row *row)
{
    if (kept->rows.n == kept->capacity) {
        const size_t capacity = kept->capacity ? 2 * kept->capacity : 1024;
        koksma__row *at = capacity <= MOST_KEPT ? realloc(kept->rows.at, capacity * sizeof *at) : NULL;
        if (!at) {
            return false;
        }
        kept->rows.at = at;
        kept->capacity = capacity;
    }
    kept->rows.at[kept->rows.n++] = *row;
    return true;
}

/* What a scan calls; `every`: also for rows without a value. */
typedef struct visitor {
    void (*see)(void *context, long long series, long long trial);
    void *context;
    bool every;
} visitor;

static void see_row(const koksma__store *store, const koksma__row *row, const visitor *v)
{
    const long long first = row->id & 0xffffffff;
    bool any = false;
    for (int k = 0; row->id >= 0 && k < KOKSMA__GROUP && (size_t)(first + k) < store->n_known; k++) {
        if (!isnan(row->values[k]) && (k == 0 || !store->known[first].alone)) {
            v->see(v->context, first + k, row->id >> 32);
            any = true;
        }
    }
    if (v->every && !any && row->id >= 0) {
        v->see(v->context, first, row->id >> 32);
    }
}

/* Reads all rows from the database, in the order of their ids. */
static koksma_status read_rows(koksma__store *store, const visitor *v, koksma__seal *found)
{
    koksma__statement *s = store->queries[KOKSMA__GET_IDS];
    koksma_status status = KOKSMA_OK;
    koksma__kept_rows kept = {.all = true};
    while (koksma__next_row(store->database, s, &status)) {
        koksma__row row = {.id = koksma__column_whole(s, 0)};
        status = koksma__store_read_row(store, s, 1, &row);
        koksma__seal_add(found, 1, koksma__checksum_of_row(&row));
        kept.all = kept.all && keep(&kept, &row);
        if (!status) {
            see_row(store, &row, v);
        }
    }
    koksma__statement_reset(s);
    kept.seal = *found;
    if (!kept.all || status) {
        free(kept.rows.at);
        kept = (koksma__kept_rows){.all = false};
    }
    store->kept = kept;
    return status;
}

/* Calls v->see for each result in the order of the rows' ids, and compares the rows with the store's seal. */
static koksma_status scan(koksma__store *store, const visitor *v)
{
    koksma__seal found = {0};
    koksma_status status = koksma__store_write_rows(store);
    status = status ? status : koksma__store_know_series(store);
    if (!status && store->kept.all) {
        found = store->kept.seal;
        for (size_t i = 0; i < store->kept.rows.n; i++) {
            see_row(store, &store->kept.rows.at[i], v);
        }
    } else if (!status) {
        status = read_rows(store, v, &found);
    }
    status = status ? status : koksma__seal_rest(store, &found);
    store->found = found;
    return status || store->for_audit || koksma__store_is_sealed(store) ? status : koksma__seal_fail(store);
}

koksma_status koksma__store_scan(koksma__store *store, void (*see)(void *context, long long series, long long trial),
                                 void *context)
{
    koksma__store_enter(store);
    return koksma__store_leave(store, scan(store, &(visitor){see, context, false}));
}

koksma_status koksma__store_scan_rows(koksma__store *store,
                                      void (*see)(void *context, long long series, long long trial), void *context)
{
    koksma__store_enter(store);
    return koksma__store_leave(store, scan(store, &(visitor){see, context, true}));
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
        status = scan(store, &(visitor){see_end, store, false});
        for (size_t i = 0; !status && i < store->n_known; i++) {
            const koksma__known_series *k = &store->known[i];
            if (k->end > MOST_HOLES + MOST_HOLES * k->count) {
                status = koksma__fail(
                    KOKSMA_MALFORMED,
                    "%s: series %zu has the trial number %lld, but only %lld trials; move it away to begin anew",
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

/* The results that each_result is to find: those of a series with trials below `end`. */
typedef struct wanted {
    long long series, end;
    const koksma__series *key;
    koksma__row_visitor visit;
    void *context;
} wanted;

/* Passes on the result that a row has for the series, unless the row only has results of other series of its
   group. */
static koksma_status pass_result(const koksma__store *store, const wanted *w, const koksma__row *row)
{
    koksma__result result = {row->id >> 32, row->seed, {row->values[w->series % KOKSMA__GROUP], NAN, NAN, NAN}};
    for (int k = 1; k < KOKSMA__RESULT_VALUES && store->known[w->series].alone; k++) {
        result.values[k] = row->values[k];
    }
    return isnan(result.values[0]) ? KOKSMA_OK : w->visit(w->context, w->key, &result);
}

static koksma_status each_in_database(koksma__store *store, const wanted *w, bool filter)
{
    koksma__statement *s = store->queries[filter ? KOKSMA__FILTER_RESULTS : KOKSMA__GET_RESULTS];
    koksma_status status = KOKSMA_OK;
    int column = 1;
    koksma__bind_whole(s, &column, koksma__group_of(w->series));
    koksma__bind_whole(s, &column, w->end);
    while (koksma__next_row(store->database, s, &status)) {
        koksma__row row = {.id = koksma__column_whole(s, 0) << 32};
        status = koksma__store_read_row(store, s, 1, &row);
        status = status ? status : pass_result(store, w, &row);
    }
    koksma__statement_reset(s);
    return status;
}

/* The index of the first row, from `low` on, with an id of at least `id`. */
static size_t find_kept(const koksma__rows *rows, size_t low, long long id)
{
    for (size_t high = rows->n; low < high;) {
        const size_t middle = low + (high - low) / 2;
        if (rows->at[middle].id < id) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static koksma_status each_in_memory(const koksma__store *store, const wanted *w, bool filter)
{
    const koksma__rows *rows = &store->kept.rows;
    const long long group = koksma__group_of(w->series);
    const size_t past = find_kept(rows, 0, w->end << 32);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; filter && i < past && !status; i++) {
        if ((rows->at[i].id & 0xffffffff) == group) {
            status = pass_result(store, w, &rows->at[i]);
        }
    }
    for (size_t i = 0, trial = 0; !filter && trial < (size_t)w->end && !status; trial++) {
        const long long id = (long long)trial << 32 | group;
        i = find_kept(rows, i, id);
        if (i < rows->n && rows->at[i].id == id) {
            status = pass_result(store, w, &rows->at[i]);
        }
    }
    return status;
}

/* Looking up one row by its id takes as long as reading about this many rows in sequence. */
static const long long ROWS_A_LOOKUP = 8;

/* Calls `visit` for the results in the order of trials. Trials are looked up one by one, or filtered from all rows if
   that is faster. */
static koksma_status each_result(koksma__store *store, const wanted *w)
{
    if (w->end <= 0) {
        return KOKSMA_OK;
    }
    const bool filter = store->found.rows / ROWS_A_LOOKUP <= store->known[w->series].count;
    return store->kept.all ? each_in_memory(store, w, filter) : each_in_database(store, w, filter);
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
    status = status ? status : each_result(store, &(wanted){series, end, NULL, keep_result, &to});
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
        status = status ? status : each_result(store, &(wanted){id, end_of(store, id), &series, visit, context});
    }
    koksma__statement_reset(s);
    return koksma__store_leave(store, status);
}

bool koksma__store_is_sealed(const koksma__store *store)
{
    return store->found.rows == store->seal.rows && store->found.sum == store->seal.sum;
}
