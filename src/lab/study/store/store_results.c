/* SPDX-License-Identifier: Apache-2.0 */
/* Reads results from the store. A scan reads all rows, finds the number of trials of
   each series, and keeps up to MOST_KEPT rows in memory, ordered by series. Of larger stores the results of a series are
   looked up trial by trial in the database, or filtered from all rows where that is faster. */
#include <math.h>
#include <stdlib.h>

#include "core/capacity.h"
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

/* The number of the group of a row; n_groups if none of its series is known. */
static size_t number_of_group(const koksma__row *row, size_t n_groups)
{
    const size_t group = (size_t)(row->id & 0xffffffff) / KOKSMA__GROUP;
    return row->id >= 0 && group < n_groups ? group : n_groups;
}

/* Sorts the rows by group, by counting; rows of no known series come last. Returns false if no memory is left. */
static bool group_rows(koksma__kept_rows *kept, size_t n_series)
{
    const size_t n_groups = (n_series + KOKSMA__GROUP - 1) / KOKSMA__GROUP;
    kept->order = malloc((kept->rows.n + 1) * sizeof *kept->order);
    kept->first = calloc(n_groups + 3, sizeof *kept->first);
    if (!kept->order || !kept->first) {
        return false;
    }
    for (size_t i = 0; i < kept->rows.n; i++) {
        kept->first[number_of_group(&kept->rows.at[i], n_groups) + 2]++;
    }
    for (size_t g = 0; g <= n_groups; g++) {
        kept->first[g + 2] += kept->first[g + 1];
    }
    for (size_t i = 0; i < kept->rows.n; i++) { /* first[g + 1] grows from the start of group g to its end */
        kept->order[kept->first[number_of_group(&kept->rows.at[i], n_groups) + 1]++] = (unsigned)i;
    }
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
static koksma_status read_rows(koksma__store *store, const visitor *v)
{
    koksma__statement *s = store->queries[KOKSMA__GET_IDS];
    koksma_status status = KOKSMA_OK;
    koksma__kept_rows kept = {.all = true};
    while (koksma__next_row(store->database, s, &status)) {
        koksma__row row;
        koksma__read(s, 0, "w", &row.id);
        status = koksma__store_read_row(store, s, 1, &row);
        store->rows++;
        kept.all = kept.all && keep(&kept, &row);
        if (!status) {
            see_row(store, &row, v);
        }
    }
    koksma__statement_reset(s);
    kept.all = kept.all && !status && group_rows(&kept, store->n_known);
    if (!kept.all) {
        KOKSMA__FREE(kept.rows.at, kept.order, kept.first);
        kept = (koksma__kept_rows){.all = false};
    }
    store->kept = kept;
    return status;
}

/* Calls v->see for each result in the order of the rows' ids. */
static koksma_status scan(koksma__store *store, const visitor *v)
{
    koksma_status status = koksma__store_write_rows(store);
    status = status ? status : koksma__store_know_series(store);
    if (!status && store->kept.all) {
        for (size_t i = 0; i < store->kept.rows.n; i++) {
            see_row(store, &store->kept.rows.at[i], v);
        }
    } else if (!status) {
        store->rows = 0;
        status = read_rows(store, v);
    }
    return status;
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
}

/* Looking up one row by its id takes as long as reading about this many rows in sequence. */
static const long long ROWS_A_LOOKUP = 8;

/* Finds the highest trial of every series. */
static koksma_status find_ends(koksma__store *store)
{
    koksma_status status = koksma__store_write_rows(store);
    if (!status && !store->knows_ends) {
        status = scan(store, &(visitor){see_end, store, false});
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

/* Trials are looked up one by one, or filtered from all rows if that is faster. */
static koksma_status each_in_database(koksma__store *store, const wanted *w)
{
    const bool filter = store->rows / ROWS_A_LOOKUP <= w->end;
    koksma__statement *s = store->queries[filter ? KOKSMA__FILTER_RESULTS : KOKSMA__GET_RESULTS];
    koksma_status status = KOKSMA_OK;
    koksma__bind(s, 1, "ww", koksma__group_of(w->series), w->end);
    while (koksma__next_row(store->database, s, &status)) {
        koksma__row row;
        koksma__read(s, 0, "w", &row.id);
        row.id <<= 32;
        status = koksma__store_read_row(store, s, 1, &row);
        status = status ? status : pass_result(store, w, &row);
    }
    koksma__statement_reset(s);
    return status;
}

static koksma_status each_in_memory(const koksma__store *store, const wanted *w)
{
    const koksma__kept_rows *kept = &store->kept;
    const size_t group = (size_t)w->series / KOKSMA__GROUP;
    for (size_t i = kept->first[group]; i < kept->first[group + 1]; i++) {
        const koksma__row *row = &kept->rows.at[kept->order[i]];
        KOKSMA__TRY(row->id >> 32 < w->end ? pass_result(store, w, row) : KOKSMA_OK);
    }
    return KOKSMA_OK;
}

/* Calls `visit` for the results in the order of trials. */
static koksma_status each_result(koksma__store *store, const wanted *w)
{
    if (w->end <= 0) {
        return KOKSMA_OK;
    }
    return store->kept.all ? each_in_memory(store, w) : each_in_database(store, w);
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
    koksma_status status = find_ends(store);
    const long long all = status ? 0 : end_of(store, series), end = all < trials ? all : trials;
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
