/* SPDX-License-Identifier: Apache-2.0 */
/* Making, opening and upgrading a store; and its statements. */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/store/schema.h"
#include "study/store/schema_upgrade.h"
#include "study/store/store_internal.h"

#define SCHEMA_VERSION "5"
#define GROUP_KEY "kind, scene, scene_hash, options, pattern, n, dim, width, height"
#define SERIES_KEY GROUP_KEY ", what"

#define ROW "(?,?,?,?,?,?)"
#define TIMES_8(row) row "," row "," row "," row "," row "," row "," row "," row
#define TIMES_32(row) TIMES_8(row) "," TIMES_8(row) "," TIMES_8(row) "," TIMES_8(row)

static const char *const queries[KOKSMA__N_QUERIES] = {
    [KOKSMA__FIND_SERIES] = "SELECT id FROM series WHERE (" SERIES_KEY ") = (?,?,?,?,?,?,?,?,?,?)",
    [KOKSMA__NEXT_SERIES] = "SELECT max(id), (SELECT max(id) FROM series) FROM series WHERE (" GROUP_KEY ") = "
                            "(?,?,?,?,?,?,?,?,?) AND kind = 'discrepancy'",
    [KOKSMA__ADD_SERIES] = "INSERT INTO series (" SERIES_KEY ", id) VALUES (?,?,?,?,?,?,?,?,?,?,?)",
    [KOKSMA__PUT_ROW] =
        "INSERT INTO result VALUES " ROW " ON CONFLICT (id) DO UPDATE SET v0 = coalesce(v0, excluded.v0), "
        "v1 = coalesce(v1, excluded.v1), v2 = coalesce(v2, excluded.v2), v3 = coalesce(v3, excluded.v3)",
    [KOKSMA__PUT_ROWS] = "INSERT OR IGNORE INTO result VALUES " TIMES_32(ROW),
    [KOKSMA__GET_RESULTS] =
        "WITH RECURSIVE trials(trial) AS (VALUES (0) UNION ALL SELECT trial + 1 FROM trials WHERE trial + 1 < ?2) "
        "SELECT trial, seed, v0, v1, v2, v3 FROM trials CROSS JOIN result ON id = trial << 32 | ?1",
    [KOKSMA__GET_IDS] = "SELECT id, v0, v1, v2, v3 FROM result",
    [KOKSMA__GET_SERIES] = "SELECT " SERIES_KEY ", id FROM series ORDER BY " SERIES_KEY,
    [KOKSMA__LAST_SERIES] = "SELECT max(id) FROM series",
    [KOKSMA__PUT_REFERENCE] = "INSERT OR REPLACE INTO reference VALUES (?,?,?,?,?,?,?)",
    [KOKSMA__GET_REFERENCE] = "SELECT standard_error FROM reference WHERE scene=? AND scene_hash=? AND options=? AND "
                              "width=? AND height=? AND reference=?",
    [KOKSMA__PUT_TEXT] = "INSERT OR REPLACE INTO meta VALUES (?,?)",
    [KOKSMA__GET_TEXT] = "SELECT value FROM meta WHERE key=?",
    [KOKSMA__PUT_RUN] = "INSERT INTO run (started, machine, version, workers, jobs, seconds, idle_seconds, "
                        "processor_seconds, store_seconds) VALUES (?,?,?,?,?,?,?,?,?)",
    [KOKSMA__GET_RUN] = "SELECT started, machine, version, workers, jobs, seconds, idle_seconds, processor_seconds, "
                        "store_seconds FROM run ORDER BY id LIMIT 1 OFFSET ?",
};

_Static_assert(KOKSMA__ROWS_AT_ONCE == 32, "as PUT_ROWS has it");

static koksma_status open_query(koksma__store *store, koksma__query i)
{
    return koksma__statement_open(store->database, queries[i], &store->queries[i]);
}

/* What the file says of itself must be this; a new file is told. */
static koksma_status check_text(koksma__store *store, const char *key, const char *value, bool write)
{
    char *found;
    koksma_status status = koksma__store_find_text(store, key, &found);
    if (!status && !found && write) {
        status = koksma__store_put_text(store, key, value);
    } else if (!status && (!found || strcmp(found, value) != 0)) {
        status = koksma__fail(KOKSMA_MALFORMED, "%s: its %s is '%s' and this run's is '%s'; choose another folder",
                              koksma__database_path(store->database), key, found ? found : "", value);
    }
    free(found);
    return status;
}

/* A store of schema 3 or 4 is made one of this. Schema 4 had no coherence of errors and a view without it: its trials
   of images lack one, so that the next run renders them again. */
static koksma_status upgrade(koksma__store *store)
{
    char *found;
    koksma_status status = koksma__store_find_text(store, "schema", &found);
    const bool is_3 = found && !strcmp(found, "3"), is_4 = found && !strcmp(found, "4");
    if (!status && (is_3 || is_4)) {
        koksma__database *database = store->database;
        status = koksma__database_execute(database, "DROP VIEW IF EXISTS rows");
        if (!status && is_3) {
            status = koksma__database_execute(
                database, "ALTER TABLE series RENAME TO series_3; ALTER TABLE result RENAME TO result_3");
        }
        status = status ? status : koksma__database_execute(database, koksma__schema_sql);
        if (!status && is_3) {
            status = koksma__database_execute(database, koksma__schema_upgrade_sql);
        }
        status = status ? status : koksma__store_put_text(store, "schema", SCHEMA_VERSION);
    }
    free(found);
    return status;
}

/* One run at a time: a second one on the same folder is told so instead of doing the same work. A store of an older
   schema is known by its `meta`, before anything is made in it. */
static koksma_status prepare(koksma__store *store, bool write, const char *plan_name)
{
    koksma__database *database = store->database;
    koksma_status status = koksma__database_execute(
        database,
        "PRAGMA page_size=16384; PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL; "
        "PRAGMA cache_size=-32768;");
    status = status ? status : koksma__store_begin(store);
    if (!status && write) {
        status = koksma__database_execute(database, "CREATE TABLE IF NOT EXISTS meta (key TEXT PRIMARY KEY, value "
                                                    "TEXT NOT NULL) WITHOUT ROWID");
    }
    status = status ? status : open_query(store, KOKSMA__PUT_TEXT);
    status = status ? status : open_query(store, KOKSMA__GET_TEXT);
    status = status ? status : upgrade(store);
    status = status ? status : check_text(store, "schema", SCHEMA_VERSION, write);
    if (!status && write) { /* another version's results can be read, not added to */
        status = check_text(store, "version", koksma_version(), write);
    }
    if (!status && plan_name) {
        status = check_text(store, "plan", plan_name, write);
    }
    if (!status && write) {
        status = koksma__database_execute(database, koksma__schema_sql);
    }
    status = status ? status : koksma__store_end(store);
    for (koksma__query i = 0; !status && i < KOKSMA__N_QUERIES; i++) {
        if (!store->queries[i]) {
            status = open_query(store, i);
        }
    }
    return status;
}

koksma_status koksma__store_open(const char *path, koksma__store_mode mode, const char *plan_name,
                                 koksma__store **out)
{
    const bool write = mode == KOKSMA__STORE_WRITE;
    koksma__store *store = calloc(1, sizeof *store);
    *out = NULL;
    if (!store) {
        return koksma__fail_memory(sizeof *store);
    }
    pthread_mutex_init(&store->lock, NULL);
    koksma_status status = koksma__store_rows_init(store);
    status = status ? status : koksma__database_open(path, write, &store->database);
    status = status ? status : prepare(store, write, plan_name);
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
    const koksma_status status = koksma__store_write_rows(store);
    for (int i = 0; i < KOKSMA__N_QUERIES; i++) {
        koksma__statement_close(store->queries[i]);
    }
    koksma__database_close(store->database);
    koksma__store_rows_fini(store);
    koksma__store_forget(store);
    koksma__point_files_fini(&store->files);
    pthread_mutex_destroy(&store->lock);
    free(store);
    return status;
}
