/* SPDX-License-Identifier: Apache-2.0 */
/* Opens a store, and holds the SQL of its statements. A run holds SQLite's exclusive lock on the file, and a reader the
   shared one, until they close it. An existing file is changed only after it was found to be a store: it has our
   application id, our schema's number, and our tables and view and nothing else, so that a file from a stranger has no
   triggers, virtual tables or views of its own. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/store/schema.h"
#include "study/store/store_internal.h"

/* "Kksm", which no other program has in SQLite's own list of application ids (magic.txt). */
enum { APPLICATION = 0x4b6b736d };

static const char tables[] =
    "table failed,table left_out,table meta,table reference,table result,view rows,table run,"
    "table series";

#define SERIES_KEY                                                                                                   \
    "kind, scene, scene_hash, options, pattern, n, dim, width, height, made_by, what, metric, measured_by"
#define SORT_KEY                                                                                                     \
    "kind, scene, scene_hash, options, pattern, n, dim, width, height, what, metric, made_by, measured_by"

#define PUT_ROWS(rows) "INSERT INTO result VALUES " rows " ON CONFLICT (id) DO NOTHING"
#define ROW "(?,?,?,?,?,?)"
#define TIMES_8(row) row "," row "," row "," row "," row "," row "," row "," row
#define TIMES_32(row) TIMES_8(row) "," TIMES_8(row) "," TIMES_8(row) "," TIMES_8(row)

static const char *const queries[KOKSMA__N_QUERIES] = {
    [KOKSMA__FIND_SERIES] = "SELECT id FROM series WHERE (" SERIES_KEY ") = (?,?,?,?,?,?,?,?,?,?,?,?,?)",
    [KOKSMA__ADD_SERIES] = "INSERT INTO series (" SERIES_KEY ") VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?) RETURNING id",
    [KOKSMA__PUT_ROW] = PUT_ROWS(ROW),
    [KOKSMA__PUT_ROWS] = PUT_ROWS(TIMES_32(ROW)),
    [KOKSMA__GET_ROW] = "SELECT * FROM result WHERE id = ?",
    [KOKSMA__GET_ROWS] = "SELECT * FROM result ORDER BY id",
    [KOKSMA__GET_RESULTS] = "SELECT trial << 32 | series, seed, v0, v1, v2, v3 FROM sorted WHERE series = ? AND "
                            "trial < ? ORDER BY trial",
    [KOKSMA__GET_SERIES] = "SELECT " SORT_KEY ", id FROM series ORDER BY " SORT_KEY,
    [KOKSMA__GET_TABLES] =
        "SELECT application_id, user_version, (SELECT coalesce(group_concat(type || ' ' || name), '') "
        "FROM (SELECT type, name FROM sqlite_schema WHERE name NOT LIKE 'sqlite_autoindex_%' "
        "ORDER BY name)) FROM pragma_application_id, pragma_user_version",
    [KOKSMA__PUT_REFERENCE] = "INSERT OR REPLACE INTO reference VALUES (?,?,?,?,?,?,?,?,?)",
    [KOKSMA__GET_REFERENCE] = "SELECT standard_error, pixels FROM reference WHERE scene=? AND scene_hash=? AND "
                              "options=? AND width=? AND height=? AND reference=? AND made_by=?",
    [KOKSMA__PUT_TEXT] = "INSERT OR REPLACE INTO meta VALUES (?,?)",
    [KOKSMA__GET_TEXT] = "SELECT value FROM meta WHERE key=?",
    [KOKSMA__PUT_FAILED] = "INSERT INTO fresh (label, n, failed, trials, reason) VALUES (?,?,?,?,?) ON CONFLICT DO "
                           "UPDATE SET failed = excluded.failed, trials = excluded.trials WHERE excluded.failed > "
                           "failed",
    [KOKSMA__GET_FAILED] =
        "WITH ranked AS (SELECT *, row_number() OVER (PARTITION BY label, n ORDER BY id) AS rank FROM failed), "
        "grown AS (SELECT label, group_concat(' ' || n || ' (' || failed || ' of ' || trials || ' trial' || "
        "iif(trials = 1, '', 's') || ')', ',') OVER line AS sizes, first_value(reason) OVER line AS reason, "
        "first_value(id) OVER line AS first, lead(id) OVER line AS next FROM ranked "
        "WINDOW line AS (PARTITION BY label, rank ORDER BY id)) "
        "SELECT label || ', N =' || sizes || ': ' || reason FROM grown WHERE next IS NULL ORDER BY first",
    [KOKSMA__COUNT_FAILED] = "SELECT sum(failed) FROM failed",
    [KOKSMA__PUT_LEFT_OUT] = "INSERT INTO left_out (line) VALUES (?)",
    [KOKSMA__GET_LEFT_OUT] = "SELECT line FROM left_out ORDER BY id",
    [KOKSMA__PUT_RUN] = "INSERT INTO run (started, machine, version, workers, jobs, seconds, idle_seconds, "
                        "processor_seconds, store_seconds) VALUES (?,?,?,?,?,?,?,?,?)",
    [KOKSMA__GET_RUN] = "SELECT started, machine, version, workers, jobs, seconds, idle_seconds, processor_seconds, "
                        "store_seconds FROM run ORDER BY id LIMIT 1 OFFSET ?",
};

_Static_assert(KOKSMA__ROWS_AT_ONCE == 32, "as PUT_ROWS has it");

/* Finds whether the file is a store. One that has nothing yet becomes a store if it is opened to write. */
static koksma_status check_schema(koksma__database *database, bool writes)
{
    const char *path = koksma__database_path(database), *found = "";
    char create[96];
    long long application = 0, version = 0;
    koksma__statement *s;
    KOKSMA__TRY(koksma__statement_open(database, queries[KOKSMA__GET_TABLES], &s));
    koksma_status status = KOKSMA_OK;
    if (koksma__next_row(database, s, &status)) {
        koksma__read(s, 0, "wwt", &application, &version, &found);
    }
    const bool ours = application == APPLICATION, empty = !application && !version && !*found;
    const bool right = ours && !strcmp(found, tables);
    koksma__statement_close(s);
    KOKSMA__TRY(status);
    KOKSMA__FAIL_IF(ours && version != KOKSMA__SCHEMA, KOKSMA_MALFORMED,
                    "%s: the file has schema %lld, but this program has schema %d; choose another folder", path,
                    version, KOKSMA__SCHEMA);
    KOKSMA__FAIL_IF(!right && !(empty && writes), KOKSMA_MALFORMED, "%s: not a store of koksma study; %s", path,
                    empty ? "it is empty" : "choose another folder");
    if (right) {
        return KOKSMA_OK;
    }
    snprintf(create, sizeof create, "PRAGMA application_id=%d; PRAGMA user_version=%d", APPLICATION, KOKSMA__SCHEMA);
    KOKSMA__TRY(koksma__database_execute(database, create));
    return koksma__database_execute(database, koksma__schema_sql);
}

/* Checks the structure of all pages. A damaged one that is still readable may hide rows from one query and not from
   another. */
static koksma_status check_pages(koksma__database *database)
{
    koksma__statement *check;
    const char *found;
    koksma_status status = KOKSMA_OK;
    KOKSMA__TRY(koksma__statement_open(database, "PRAGMA quick_check(1)", &check));
    if (koksma__next_row(database, check, &status) && koksma__read(check, 0, "t", &found) &&
        strcmp(found, "ok") != 0) {
        status = koksma__fail(KOKSMA_MALFORMED, "%s: database disk image is malformed; move it away to begin anew",
                              koksma__database_path(database));
    }
    koksma__statement_close(check);
    return status;
}

static koksma_status open_queries(koksma__store *store)
{
    KOKSMA__TRY(koksma__database_execute(store->database,
                                         "CREATE TEMP TABLE sorted (series, trial, seed, v0, v1, v2, v3, "
                                         "PRIMARY KEY (series, trial)) WITHOUT ROWID; "
                                         "CREATE TEMP TABLE fresh (id INTEGER PRIMARY KEY, label, n, failed, trials, "
                                         "reason, UNIQUE (label, n, reason))"));
    for (koksma__query i = 0; i < KOKSMA__N_QUERIES; i++) {
        KOKSMA__TRY(koksma__statement_open(store->database, queries[i], &store->queries[i]));
    }
    return KOKSMA_OK;
}

/* Checks that the file belongs to the plan `name`; writes the name into a new file. */
static koksma_status check_plan(koksma__store *store, const char *name)
{
    char *found;
    koksma_status status = koksma__store_get_text(store, "plan", &found);
    if (!status && !found) {
        status = koksma__store_set_text(store, "plan", name);
    } else if (!status && strcmp(found, name) != 0) {
        status = koksma__fail(KOKSMA_MALFORMED, "%s: its plan is '%s' and this run's is '%s'; choose another folder",
                              koksma__database_path(store->database), found, name);
    }
    free(found);
    return status;
}

static koksma_status open_store(koksma__store *store, const char *path, bool writes, const char *plan_name)
{
    KOKSMA__TRY(koksma__store_rows_init(store));
    KOKSMA__TRY(koksma__database_open(path, writes, &store->database));
    if (writes) {
        KOKSMA__TRY(koksma__database_execute(store->database, "PRAGMA locking_mode=EXCLUSIVE"));
        KOKSMA__TRY(koksma__store_begin(store));
    } else {
        KOKSMA__TRY(koksma__database_execute(store->database, "BEGIN; SELECT 1 FROM sqlite_schema"));
    }
    KOKSMA__TRY(check_schema(store->database, writes));
    KOKSMA__TRY(check_pages(store->database)); /* damage must be reported before any byte is written */
    KOKSMA__TRY(open_queries(store));
    KOKSMA__TRY(writes && plan_name ? check_plan(store, plan_name) : KOKSMA_OK);
    return koksma__store_end(store);
}

koksma_status koksma__store_open(const char *path, koksma__store_mode mode, const char *plan_name,
                                 koksma__store **out)
{
    koksma__store *store = calloc(1, sizeof *store);
    *out = NULL;
    KOKSMA__REQUIRE_MEMORY(store, sizeof *store);
    pthread_mutex_init(&store->lock, NULL);
    const koksma_status status = open_store(store, path, mode == KOKSMA__STORE_WRITE, plan_name);
    if (status) {
        store->in_transaction = false; /* closing the database rolls the transaction back */
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
    const koksma_status status = store->database ? koksma__store_write_rows(store) : KOKSMA_OK;
    for (int i = 0; i < KOKSMA__N_QUERIES; i++) {
        koksma__statement_close(store->queries[i]);
    }
    koksma__database_close(store->database);
    koksma__store_rows_fini(store);
    koksma__point_files_fini(&store->files);
    pthread_mutex_destroy(&store->lock);
    free(store);
    return status;
}
