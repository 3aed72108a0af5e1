/* SPDX-License-Identifier: Apache-2.0 */
/* Long because it is the only file that knows SQLite. */
#include "study/store.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <sqlite3.h>

#include "core/status.h"
#include "study/clocks.h"
#include "study/schema.h"
#include "study/schema_upgrade.h"

#define SCHEMA_VERSION "4"
#define GROUP_KEY "kind, scene, scene_hash, options, pattern, n, dim, width, height"
#define SERIES_KEY GROUP_KEY ", what"

#define ROW "(?,?,?,?,?,?)"
#define TIMES_8(row) row "," row "," row "," row "," row "," row "," row "," row
#define TIMES_MANY(row) TIMES_8(row) "," TIMES_8(row) "," TIMES_8(row) "," TIMES_8(row)

/* Rows of a statement that puts many, and columns of a row. */
enum { MANY = 32, ROW_COLUMNS = 6, SERIES_COLUMNS = 10 };

enum {
    FIND_SERIES,
    NEXT_SERIES,
    ADD_SERIES,
    PUT,
    PUT_MANY,
    GET_RESULTS,
    GET_IDS,
    GET_SERIES,
    LAST_SERIES,
    PUT_REFERENCE,
    GET_REFERENCE,
    PUT_TEXT,
    GET_TEXT,
    PUT_RUN,
    GET_RUN,
    N_STATEMENTS
};

static const char *const statements[N_STATEMENTS] = {
    [FIND_SERIES] = "SELECT id FROM series WHERE (" SERIES_KEY ") = (?,?,?,?,?,?,?,?,?,?)",
    [NEXT_SERIES] = "SELECT max(id), (SELECT max(id) FROM series) FROM series WHERE (" GROUP_KEY ") = "
                    "(?,?,?,?,?,?,?,?,?) AND kind = 'discrepancy'",
    [ADD_SERIES] = "INSERT INTO series (" SERIES_KEY ", id) VALUES (?,?,?,?,?,?,?,?,?,?,?)",
    [PUT] = "INSERT INTO result VALUES " ROW " ON CONFLICT (id) DO UPDATE SET v0 = coalesce(v0, excluded.v0), "
            "v1 = coalesce(v1, excluded.v1), v2 = coalesce(v2, excluded.v2), v3 = coalesce(v3, excluded.v3)",
    [PUT_MANY] = "INSERT OR IGNORE INTO result VALUES " TIMES_MANY(ROW),
    [GET_RESULTS] =
        "WITH RECURSIVE trials(trial) AS (VALUES (0) UNION ALL SELECT trial + 1 FROM trials WHERE trial + 1 < ?2) "
        "SELECT trial, seed, v0, v1, v2, v3 FROM trials CROSS JOIN result ON id = trial << 32 | ?1",
    [GET_IDS] = "SELECT id, v0, v1, v2, v3 FROM result",
    [GET_SERIES] = "SELECT " SERIES_KEY ", id FROM series ORDER BY " SERIES_KEY,
    [LAST_SERIES] = "SELECT max(id) FROM series",
    [PUT_REFERENCE] = "INSERT OR REPLACE INTO reference VALUES (?,?,?,?,?,?,?)",
    [GET_REFERENCE] = "SELECT standard_error FROM reference WHERE scene=? AND scene_hash=? AND options=? AND width=? "
                      "AND height=? AND reference=?",
    [PUT_TEXT] = "INSERT OR REPLACE INTO meta VALUES (?,?)",
    [GET_TEXT] = "SELECT value FROM meta WHERE key=?",
    [PUT_RUN] = "INSERT INTO run (started, machine, version, workers, jobs, seconds, idle_seconds, "
                "processor_seconds, store_seconds) VALUES "
                "(?,?,?,?,?,?,?,?,?)",
    [GET_RUN] = "SELECT started, machine, version, workers, jobs, seconds, idle_seconds, processor_seconds, "
                "store_seconds FROM run ORDER BY id LIMIT 1 "
                "OFFSET ?",
};

/* Rows are gathered in memory and written together: a statement a row would take most of the time of small jobs. A
   killed run loses what was gathered in this time, or in one job if that takes longer. */
static const double WRITE_AFTER_S = 0.2;
enum { MOST_GATHERED = 1 << 14 };

/* A plan's tasks are in memory, too, and each is far more than a number. */
static const long long MOST_SERIES = 1 << 26;

typedef struct row {
    long long id;
    uint64_t seed;
    double values[KOKSMA__RESULT_VALUES];
} row;

typedef struct rows {
    size_t n;
    row *at;
} rows;

typedef struct known_series {
    bool image;
    long long end, count; /* all its trials are below; how many there are */
} known_series;

struct koksma__store {
    sqlite3 *database;
    sqlite3_stmt *prepared[N_STATEMENTS];
    char *path;
    pthread_mutex_t lock; /* guards the database, and what follows */
    bool in_transaction;
    double began_s, entered_s, seconds;
    rows spare;
    size_t n_known;      /* of `known`, by the id of a series */
    known_series *known; /* read when it is first wanted */
    bool knows_ends;
    pthread_mutex_t gather_lock; /* taken within the other; guards what follows */
    rows gathered;
    double written_s; /* when something was last written */
};

/* Results lie four in a row. Of an image its four values are one; of point sets one value each of four measures: the
   series of one pattern, n, dim and options have ids that follow each other from a multiple of GROUP, as far as they
   were made one after the other. A row's id is in the order in which a run makes rows, so that they are appended. */
enum { GROUP = KOKSMA__RESULT_VALUES };

static long long group_of(long long series)
{
    return series - series % GROUP;
}

static long long row_id(long long series, long long trial)
{
    return (long long)((unsigned long long)trial << 32 | (unsigned long long)group_of(series));
}

static void enter(koksma__store *store)
{
    pthread_mutex_lock(&store->lock);
    store->entered_s = koksma__thread_s();
}

static koksma_status leave(koksma__store *store, koksma_status status)
{
    store->seconds += koksma__thread_s() - store->entered_s;
    pthread_mutex_unlock(&store->lock);
    return status;
}

static koksma_status fail(koksma__store *store)
{
    const int code = sqlite3_errcode(store->database);
    if (code == SQLITE_BUSY || code == SQLITE_LOCKED) {
        return koksma__fail(KOKSMA_IO, "%s: another run is at work on it", store->path);
    }
    if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: %s; move it away to begin anew", store->path,
                            sqlite3_errmsg(store->database));
    }
    if (code == SQLITE_READONLY || code == SQLITE_CANTOPEN) {
        return koksma__fail(KOKSMA_IO, "%s: can't be written; its folder must be writable, too", store->path);
    }
    if (code == SQLITE_NOMEM) {
        return koksma__fail(KOKSMA_MEMORY, "%s: out of memory", store->path);
    }
    return koksma__fail(KOKSMA_IO, "%s: %s", store->path, sqlite3_errmsg(store->database));
}

static koksma_status execute(koksma__store *store, const char *sql)
{
    return sqlite3_exec(store->database, sql, NULL, NULL, NULL) == SQLITE_OK ? KOKSMA_OK : fail(store);
}

static koksma_status commit(koksma__store *store)
{
    if (!store->in_transaction) {
        return KOKSMA_OK;
    }
    store->in_transaction = false;
    return execute(store, "COMMIT");
}

static koksma_status begin(koksma__store *store)
{
    if (store->in_transaction) {
        return KOKSMA_OK;
    }
    const koksma_status status = execute(store, "BEGIN IMMEDIATE");
    store->in_transaction = !status;
    store->began_s = koksma__now_s();
    return status;
}

/* ---- Binding and stepping; the caller holds the lock -------------------------------------------------- */

static void bind_text(sqlite3_stmt *s, int *column, const char *text)
{
    sqlite3_bind_text(s, (*column)++, text, -1, SQLITE_STATIC);
}

static void bind_whole(sqlite3_stmt *s, int *column, long long value)
{
    sqlite3_bind_int64(s, (*column)++, value);
}

/* All that the series of a group have in common; the next column comes back. */
static int bind_group(sqlite3_stmt *s, const koksma__series *key)
{
    int column = 1;
    bind_text(s, &column, key->kind);
    bind_text(s, &column, key->scene);
    bind_text(s, &column, key->scene_hash);
    bind_text(s, &column, key->options);
    bind_text(s, &column, key->pattern);
    bind_whole(s, &column, key->n);
    bind_whole(s, &column, key->dim);
    bind_whole(s, &column, key->width);
    bind_whole(s, &column, key->height);
    return column;
}

static void bind_series(sqlite3_stmt *s, const koksma__series *key)
{
    int column = bind_group(s, key);
    bind_text(s, &column, key->what);
}

static koksma_status step_put(koksma__store *store, sqlite3_stmt *s)
{
    koksma_status status = begin(store);
    if (!status && sqlite3_step(s) != SQLITE_DONE) {
        status = fail(store);
    }
    sqlite3_reset(s);
    if (!status && koksma__now_s() - store->began_s > WRITE_AFTER_S) {
        status = commit(store);
    }
    return status;
}

static void bind_row(sqlite3_stmt *s, int column, const row *from)
{
    sqlite3_bind_int64(s, column++, from->id);
    sqlite3_bind_int64(s, column++, (long long)from->seed);
    for (int k = 0; k < KOKSMA__RESULT_VALUES; k++) {
        sqlite3_bind_double(s, column++, from->values[k]); /* NaN is stored as NULL */
    }
}

static koksma_status step_rows(koksma__store *store, sqlite3_stmt *s)
{
    const bool done = sqlite3_step(s) == SQLITE_DONE;
    const koksma_status status = done ? KOKSMA_OK : fail(store);
    sqlite3_reset(s);
    return status;
}

static koksma_status put_one(koksma__store *store, const row *from)
{
    bind_row(store->prepared[PUT], 1, from);
    return step_rows(store, store->prepared[PUT]);
}

/* A row that exists may have room for what others of its group have: that is seldom, and looked at one by one. */
static koksma_status put_many(koksma__store *store, const row *from)
{
    for (int k = 0; k < MANY; k++) {
        bind_row(store->prepared[PUT_MANY], 1 + ROW_COLUMNS * k, &from[k]);
    }
    koksma_status status = step_rows(store, store->prepared[PUT_MANY]);
    if (!status && sqlite3_changes(store->database) < MANY) {
        for (int k = 0; !status && k < MANY; k++) {
            status = put_one(store, &from[k]);
        }
    }
    return status;
}

static void forget(koksma__store *store)
{
    free(store->known);
    store->known = NULL;
    store->n_known = 0;
    store->knows_ends = false;
}

/* Writes and commits all rows that were gathered. The lock must be held, so that the spare room is free. */
static koksma_status write_gathered(koksma__store *store)
{
    pthread_mutex_lock(&store->gather_lock);
    const rows taken = store->gathered;
    store->gathered = (rows){0, store->spare.at};
    store->spare.at = taken.at;
    store->written_s = koksma__now_s();
    pthread_mutex_unlock(&store->gather_lock);
    if (taken.n) { /* what is known of the rows is known no more */
        forget(store);
    }
    size_t i = 0;
    koksma_status status = taken.n || store->in_transaction ? begin(store) : KOKSMA_OK;
    for (; !status && taken.n - i >= MANY; i += MANY) {
        status = put_many(store, &taken.at[i]);
    }
    for (; !status && i < taken.n; i++) {
        status = put_one(store, &taken.at[i]);
    }
    return status ? status : commit(store);
}

/* One row, or none: *found says so. The caller reads the columns and resets. */
static koksma_status step_get(koksma__store *store, sqlite3_stmt *s, bool *found)
{
    const int code = sqlite3_step(s);
    *found = code == SQLITE_ROW;
    return code == SQLITE_ROW || code == SQLITE_DONE ? KOKSMA_OK : fail(store);
}

/* Never NULL, though a damaged database may have that where the schema forbids it. */
static const char *read_text(sqlite3_stmt *s, int column)
{
    const char *text = (const char *)sqlite3_column_text(s, column);
    return text ? text : "";
}

static double read_value(sqlite3_stmt *s, int column)
{
    return sqlite3_column_type(s, column) == SQLITE_NULL ? (double)NAN : sqlite3_column_double(s, column);
}

/* False where the row has no result of the series, only of others of its group. */
static bool read_result(sqlite3_stmt *s, const koksma__store *store, long long series, koksma__result *result)
{
    const int place = (int)(series - group_of(series));
    result->trial = sqlite3_column_int64(s, 0);
    result->seed = (uint64_t)sqlite3_column_int64(s, 1);
    result->values[0] = read_value(s, 2 + place);
    for (int k = 1; k < KOKSMA__RESULT_VALUES; k++) {
        result->values[k] = store->known[series].image ? read_value(s, 2 + k) : (double)NAN;
    }
    return !isnan(result->values[0]);
}

/* ---- Opening ------------------------------------------------------------------------------------------- */

static koksma_status put_text(koksma__store *store, const char *key, const char *value)
{
    int column = 1;
    bind_text(store->prepared[PUT_TEXT], &column, key);
    bind_text(store->prepared[PUT_TEXT], &column, value);
    return step_put(store, store->prepared[PUT_TEXT]);
}

static koksma_status get_text(koksma__store *store, const char *key, char **value)
{
    sqlite3_stmt *s = store->prepared[GET_TEXT];
    int column = 1;
    bool found;
    bind_text(s, &column, key);
    koksma_status status = step_get(store, s, &found);
    *value = found ? strdup(read_text(s, 0)) : NULL;
    if (found && !*value) {
        status = koksma__fail_memory(1);
    }
    sqlite3_reset(s);
    return status;
}

/* What the file says of itself must be this; a new file is told. */
static koksma_status check_text(koksma__store *store, const char *key, const char *value, bool write)
{
    char *found;
    koksma_status status = get_text(store, key, &found);
    if (!status && !found && write) {
        status = put_text(store, key, value);
    } else if (!status && (!found || strcmp(found, value) != 0)) {
        status = koksma__fail(KOKSMA_MALFORMED, "%s: its %s is '%s' and this run's is '%s'; choose another folder",
                              store->path, key, found ? found : "", value);
    }
    free(found);
    return status;
}

static koksma_status prepare_statement(koksma__store *store, int i)
{
    return sqlite3_prepare_v3(store->database, statements[i], -1, SQLITE_PREPARE_PERSISTENT, &store->prepared[i],
                              NULL) == SQLITE_OK
               ? KOKSMA_OK
               : fail(store);
}

/* A store of schema 3 is made one of this. */
static koksma_status upgrade(koksma__store *store)
{
    char *found;
    koksma_status status = get_text(store, "schema", &found);
    if (!status && found && !strcmp(found, "3")) {
        status = execute(store, "DROP VIEW IF EXISTS rows; ALTER TABLE series RENAME TO series_3; ALTER TABLE result "
                                "RENAME TO result_3");
        status = status ? status : execute(store, koksma__schema_sql);
        status = status ? status : execute(store, koksma__schema_upgrade_sql);
        status = status ? status : put_text(store, "schema", SCHEMA_VERSION);
    }
    free(found);
    return status;
}

/* One run at a time: a second one on the same folder is told so instead of doing the same work. A store of an older
   schema is known by its `meta`, before anything is made in it. */
static koksma_status prepare(koksma__store *store, bool write, const char *plan_name)
{
    koksma_status status = execute(
        store,
        "PRAGMA page_size=16384; PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL; "
        "PRAGMA cache_size=-32768;");
    status = status ? status : begin(store);
    if (!status && write) {
        status = execute(store, "CREATE TABLE IF NOT EXISTS meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT "
                                "ROWID");
    }
    status = status ? status : prepare_statement(store, PUT_TEXT);
    status = status ? status : prepare_statement(store, GET_TEXT);
    status = status ? status : upgrade(store);
    status = status ? status : check_text(store, "schema", SCHEMA_VERSION, write);
    status = status ? status : check_text(store, "version", koksma_version(), write);
    if (!status && plan_name) {
        status = check_text(store, "plan", plan_name, write);
    }
    if (!status && write) {
        status = execute(store, koksma__schema_sql);
    }
    status = status ? status : commit(store);
    for (int i = 0; !status && i < N_STATEMENTS; i++) {
        if (!store->prepared[i]) {
            status = prepare_statement(store, i);
        }
    }
    return status;
}

/* A lock dies with its process, but a process that was killed holds it until the system has found time to end it. */
enum { LAST_BREATH_MS = 1500 };

koksma_status koksma__store_open(const char *path, koksma__store_mode mode, const char *plan_name,
                                 koksma__store **out)
{
    const bool write = mode == KOKSMA__STORE_WRITE;
    koksma__store *store = calloc(1, sizeof *store);
    *out = NULL;
    if (!store || !(store->path = strdup(path))) {
        free(store);
        return koksma__fail_memory(sizeof *store);
    }
    pthread_mutex_init(&store->lock, NULL);
    pthread_mutex_init(&store->gather_lock, NULL);
    store->gathered.at = malloc(MOST_GATHERED * sizeof *store->gathered.at);
    store->spare.at = malloc(MOST_GATHERED * sizeof *store->spare.at);
    koksma_status status = store->gathered.at && store->spare.at
                               ? KOKSMA_OK
                               : koksma__fail_memory(2 * MOST_GATHERED * sizeof *store->spare.at);
    if (!status && !write && access(path, F_OK)) {
        status = koksma__fail(KOKSMA_MISSING, "%s: %s", path, strerror(errno));
    } else if (!status && access(path, W_OK) &&
               errno != ENOENT) { /* SQLite's own words for it mislead; also readers lock */
        status = koksma__fail(KOKSMA_IO, "%s: can't be written: %s", path, strerror(errno));
    }
    const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX | (write ? SQLITE_OPEN_CREATE : 0);
    if (!status && sqlite3_open_v2(path, &store->database, flags, NULL) != SQLITE_OK) {
        status = fail(store);
    }
    if (!status) {
        sqlite3_busy_timeout(store->database, LAST_BREATH_MS);
        status = prepare(store, write, plan_name);
    }
    if (status) {
        store->in_transaction = false; /* closing rolls back */
        koksma__store_close(store);
        return status;
    }
    *out = store;
    return KOKSMA_OK;
}

koksma_status koksma__store_close(koksma__store *store)
{
    if (!store) {
        return KOKSMA_OK;
    }
    const koksma_status status = write_gathered(store);
    for (int i = 0; i < N_STATEMENTS; i++) {
        sqlite3_finalize(store->prepared[i]);
    }
    sqlite3_close(store->database);
    pthread_mutex_destroy(&store->lock);
    pthread_mutex_destroy(&store->gather_lock);
    free(store->gathered.at);
    free(store->spare.at);
    forget(store);
    free(store->path);
    free(store);
    return status;
}

koksma_status koksma__store_commit(koksma__store *store)
{
    enter(store);
    return leave(store, write_gathered(store));
}

double koksma__store_seconds(koksma__store *store)
{
    pthread_mutex_lock(&store->lock);
    const double seconds = store->seconds;
    pthread_mutex_unlock(&store->lock);
    return seconds;
}

koksma_status koksma__store_set_text(koksma__store *store, const char *key, const char *value)
{
    enter(store);
    return leave(store, put_text(store, key, value));
}

koksma_status koksma__store_get_text(koksma__store *store, const char *key, char **value)
{
    enter(store);
    return leave(store, get_text(store, key, value));
}

/* ---- Rows ---------------------------------------------------------------------------------------------- */

/* The id for a new series: the next of its group, or the first of a new one. */
static koksma_status next_series(koksma__store *store, const koksma__series *series, long long *id)
{
    sqlite3_stmt *s = store->prepared[NEXT_SERIES];
    bool found;
    bind_group(s, series);
    const koksma_status status = step_get(store, s, &found);
    const long long last = found ? sqlite3_column_int64(s, 0) : 0,
                    last_of_all = found ? sqlite3_column_int64(s, 1) : 0;
    *id = (last + 1) % GROUP && last ? last + 1 : group_of(last_of_all) + GROUP;
    sqlite3_reset(s);
    return status;
}

koksma_status koksma__store_series(koksma__store *store, const koksma__series *series, bool add, long long *id)
{
    bool found;
    enter(store);
    bind_series(store->prepared[FIND_SERIES], series);
    koksma_status status = step_get(store, store->prepared[FIND_SERIES], &found);
    *id = found ? sqlite3_column_int64(store->prepared[FIND_SERIES], 0) : 0;
    sqlite3_reset(store->prepared[FIND_SERIES]);
    if (!status && !found && add) {
        status = next_series(store, series, id);
        bind_series(store->prepared[ADD_SERIES], series);
        sqlite3_bind_int64(store->prepared[ADD_SERIES], SERIES_COLUMNS + 1, *id);
        status = status ? status : step_put(store, store->prepared[ADD_SERIES]);
        forget(store);
    }
    return leave(store, status);
}

/* There must be room for one more. */
static void gather(rows *to, long long series, const koksma__result *result)
{
    const long long id = row_id(series, result->trial);
    const int place = (int)(series - group_of(series));
    if (to->n == 0 || to->at[to->n - 1].id != id) {
        to->at[to->n++] = (row){id, result->seed, {NAN, NAN, NAN, NAN}};
    }
    row *r = &to->at[to->n - 1];
    for (int k = 0; place + k < KOKSMA__RESULT_VALUES; k++) {
        r->values[place + k] = isnan(r->values[place + k]) ? result->values[k] : r->values[place + k];
    }
}

koksma_status koksma__store_put(koksma__store *store, const long long *series, const koksma__result *results,
                                size_t n)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < n;) {
        pthread_mutex_lock(&store->gather_lock);
        rows *to = &store->gathered;
        for (; i < n && to->n < MOST_GATHERED; i++) {
            gather(to, series[i], &results[i]);
        }
        const bool write = i < n || koksma__now_s() - store->written_s > WRITE_AFTER_S;
        pthread_mutex_unlock(&store->gather_lock);
        if (write) {
            enter(store);
            status = leave(store, write_gathered(store));
        }
    }
    return status;
}

/* Which series are of images. */
static koksma_status know_series(koksma__store *store)
{
    sqlite3_stmt *s = store->prepared[GET_SERIES];
    if (store->known) {
        return KOKSMA_OK;
    }
    bool found;
    koksma_status status = step_get(store, store->prepared[LAST_SERIES], &found);
    const long long last = found ? sqlite3_column_int64(store->prepared[LAST_SERIES], 0) : 0;
    sqlite3_reset(store->prepared[LAST_SERIES]);
    if (!status && (last < 0 || last > MOST_SERIES)) {
        status = koksma__fail(KOKSMA_MALFORMED, "%s: a series with the number %lld; move it away to begin anew",
                              store->path, last);
    }
    if (status) {
        return status;
    }
    store->n_known = (size_t)last + 1;
    store->known = calloc(store->n_known, sizeof *store->known);
    if (!store->known) {
        return koksma__fail_memory(store->n_known * sizeof *store->known);
    }
    int code;
    while ((code = sqlite3_step(s)) == SQLITE_ROW) {
        const long long id = sqlite3_column_int64(s, SERIES_COLUMNS);
        const char *kind = read_text(s, 0);
        if (id >= 0 && (size_t)id < store->n_known) {
            store->known[id].image = !strcmp(kind, "image");
        }
    }
    status = code == SQLITE_DONE ? KOKSMA_OK : fail(store);
    sqlite3_reset(s);
    return status;
}

/* Reads all rows, in the order of their ids. */
static koksma_status scan(koksma__store *store, void (*see)(void *context, long long series, long long trial),
                          void *context)
{
    sqlite3_stmt *s = store->prepared[GET_IDS];
    koksma_status status = write_gathered(store);
    status = status ? status : know_series(store);
    int code = SQLITE_DONE;
    while (!status && (code = sqlite3_step(s)) == SQLITE_ROW) {
        const long long id = sqlite3_column_int64(s, 0), first = id & 0xffffffff;
        for (int k = 0; id >= 0 && k < GROUP && (size_t)(first + k) < store->n_known; k++) {
            if (sqlite3_column_type(s, 1 + k) != SQLITE_NULL && (k == 0 || !store->known[first].image)) {
                see(context, first + k, id >> 32);
            }
        }
    }
    if (!status && code != SQLITE_DONE) {
        status = fail(store);
    }
    sqlite3_reset(s);
    return status;
}

koksma_status koksma__store_scan(koksma__store *store, void (*see)(void *context, long long series, long long trial),
                                 void *context)
{
    enter(store);
    return leave(store, scan(store, see, context));
}

static void see_end(void *context, long long series, long long trial)
{
    koksma__store *store = context;
    known_series *k = &store->known[series];
    k->end = trial >= k->end ? trial + 1 : k->end;
    k->count++;
}

/* Trials are made in their order, but for what was in hand when a run ended, so that a number far above the others is
   damage; looking up all below it would take hours. */
static const long long MOST_HOLES = 100000;

/* How far the trials of every series go. */
static koksma_status find_ends(koksma__store *store)
{
    koksma_status status = write_gathered(store);
    if (!status && !store->knows_ends) {
        status = scan(store, see_end, store);
        for (size_t i = 0; !status && i < store->n_known; i++) {
            const known_series *k = &store->known[i];
            if (k->end > MOST_HOLES + MOST_HOLES * k->count) {
                status = koksma__fail(KOKSMA_MALFORMED,
                                      "%s: series %zu has a trial %lld of %lld; move it away to begin anew",
                                      store->path, i, k->end - 1, k->count);
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

/* Shows a series' results with trials below `end`. */
static koksma_status each_result(koksma__store *store, long long series, long long end, const koksma__series *key,
                                 koksma__row_visitor visit, void *context)
{
    sqlite3_stmt *s = store->prepared[GET_RESULTS];
    koksma_status status = KOKSMA_OK;
    int code = SQLITE_DONE;
    sqlite3_bind_int64(s, 1, group_of(series));
    sqlite3_bind_int64(s, 2, end);
    while (end > 0 && !status && (code = sqlite3_step(s)) == SQLITE_ROW) {
        koksma__result result;
        if (read_result(s, store, series, &result)) {
            status = visit(context, key, &result);
        }
    }
    if (!status && code != SQLITE_DONE) {
        status = fail(store);
    }
    sqlite3_reset(s);
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
    enter(store);
    koksma_status status = find_ends(store);
    const long long all = status ? 0 : end_of(store, series), end = all < trials ? all : trials;
    if (end > 0 && !(to.at = calloc((size_t)end, sizeof *to.at))) {
        status = koksma__fail_memory((size_t)end * sizeof *to.at);
    }
    status = status ? status : each_result(store, series, end, NULL, keep_result, &to);
    *out = to.at;
    *n = to.n;
    return leave(store, status);
}

koksma_status koksma__store_visit(koksma__store *store, koksma__row_visitor visit, void *context)
{
    sqlite3_stmt *s = store->prepared[GET_SERIES];
    int code = SQLITE_DONE;
    enter(store);
    koksma_status status = find_ends(store);
    while (!status && (code = sqlite3_step(s)) == SQLITE_ROW) {
        const char *texts[10];
        for (int k = 0; k < 10; k++) {
            texts[k] = k < 5 || k == 9 ? read_text(s, k) : NULL;
        }
        const koksma__series series = {texts[0],
                                       texts[1],
                                       texts[2],
                                       texts[3],
                                       texts[4],
                                       texts[9],
                                       sqlite3_column_int64(s, 5),
                                       sqlite3_column_int64(s, 6),
                                       sqlite3_column_int64(s, 7),
                                       sqlite3_column_int64(s, 8)};
        const long long id = sqlite3_column_int64(s, 10);
        status = each_result(store, id, end_of(store, id), &series, visit, context);
    }
    if (!status && code != SQLITE_DONE) {
        status = fail(store);
    }
    sqlite3_reset(s);
    return leave(store, status);
}

/* ---- References and runs ------------------------------------------------------------------------------- */

static int bind_reference(sqlite3_stmt *s, const koksma__series *series)
{
    int column = 1;
    bind_text(s, &column, series->scene);
    bind_text(s, &column, series->scene_hash);
    bind_text(s, &column, series->options);
    bind_whole(s, &column, series->width);
    bind_whole(s, &column, series->height);
    bind_text(s, &column, series->what);
    return column;
}

koksma_status koksma__store_put_reference(koksma__store *store, const koksma__series *series, double standard_error)
{
    sqlite3_stmt *s = store->prepared[PUT_REFERENCE];
    enter(store);
    sqlite3_bind_double(s, bind_reference(s, series), standard_error); /* NaN is stored as NULL */
    return leave(store, step_put(store, s));
}

koksma_status koksma__store_reference(koksma__store *store, const koksma__series *series, double *standard_error)
{
    sqlite3_stmt *s = store->prepared[GET_REFERENCE];
    bool found;
    enter(store);
    bind_reference(s, series);
    const koksma_status status = step_get(store, s, &found);
    *standard_error = found && sqlite3_column_type(s, 0) != SQLITE_NULL ? sqlite3_column_double(s, 0) : (double)NAN;
    sqlite3_reset(s);
    return leave(store, status);
}

koksma_status koksma__store_put_run(koksma__store *store, const koksma__run_record *record)
{
    sqlite3_stmt *s = store->prepared[PUT_RUN];
    int column = 1;
    enter(store);
    bind_text(s, &column, record->started);
    bind_text(s, &column, record->machine);
    bind_text(s, &column, record->version);
    bind_whole(s, &column, record->workers);
    bind_whole(s, &column, record->jobs);
    sqlite3_bind_double(s, column++, record->seconds);
    sqlite3_bind_double(s, column++, record->idle_seconds);
    sqlite3_bind_double(s, column++, record->processor_seconds);
    sqlite3_bind_double(s, column, record->store_seconds);
    return leave(store, step_put(store, s));
}

koksma_status koksma__store_run(koksma__store *store, long long i, koksma__run_record *record, bool *found)
{
    sqlite3_stmt *s = store->prepared[GET_RUN];
    int column = 1;
    enter(store);
    bind_whole(s, &column, i);
    const koksma_status status = step_get(store, s, found);
    if (*found) {
        snprintf(record->started, sizeof record->started, "%s", read_text(s, 0));
        snprintf(record->machine, sizeof record->machine, "%s", read_text(s, 1));
        snprintf(record->version, sizeof record->version, "%s", read_text(s, 2));
        record->workers = sqlite3_column_int64(s, 3);
        record->jobs = sqlite3_column_int64(s, 4);
        record->seconds = sqlite3_column_double(s, 5);
        record->idle_seconds = sqlite3_column_double(s, 6);
        record->processor_seconds = sqlite3_column_double(s, 7);
        record->store_seconds = sqlite3_column_double(s, 8);
    }
    sqlite3_reset(s);
    return leave(store, status);
}
