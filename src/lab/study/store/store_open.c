/* SPDX-License-Identifier: Apache-2.0 */
/* Creates and opens a store, and holds the SQL of its statements. An existing file is first checked without
   changing any byte (database.c), and rejected if it is not a store of this schema. A new store is written under a
   temporary name and linked to its own when complete. */
#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/files.h"
#include "core/status.h"
#include "study/store/schema.h"
#include "study/store/store_internal.h"

/* ---- The tables -------------------------------------------------------------------------------------------------- */

/* Checks which tables a file has. The SQL of every table and view, as SQLite stores it, is compared with the
   statements of schema.sql after removing comments (from -- to the end of the line) and replacing white space by one
   blank: the file must have each statement once and nothing else. A file from an untrusted source thus has no
   triggers, further tables or views, virtual tables, or computed columns. */

/* "Kksm", which no other program has in SQLite's own list of application ids (magic.txt). */
static const uint32_t APPLICATION = 0x4b6b736d;

enum { STATEMENTS = 8 };

/* Writes one statement to `out` without comments that begin with -- and with one blank for each stretch of white space,
   both outside quotes. The statement ends at the first ';' outside quotes, or at the end of the text. Returns the rest of
   the SQL. */
static const char *normal_form(const char *sql, char *out)
{
    char *to = out;
    for (char quote = 0; *sql && (quote || *sql != ';'); sql++) {
        if (!quote && sql[0] == '-' && sql[1] == '-') {
            sql += strcspn(sql, "\n") - 1;
            continue;
        }
        if (quote || !isspace((unsigned char)*sql)) {
            *to++ = *sql;
        } else if (to > out && to[-1] != ' ') {
            *to++ = ' ';
        }
        quote = quote ? (*sql == quote ? 0 : quote) : strchr("'\"`", *sql) ? *sql : 0;
    }
    to -= to > out && to[-1] == ' ';
    *to = '\0';
    return *sql ? sql + 1 : sql;
}

/* Returns the index of the statement in `schema` that equals `sql`, or -1; `out` receives the normal form of
   `sql`. */
static int find_statement(const char *schema, const char *sql, char *out, char *known)
{
    normal_form(sql, out);
    for (int i = 0; *schema; i++) {
        schema = normal_form(schema, known);
        if (*known && !strcmp(known, out)) {
            return i;
        }
    }
    return -1;
}

/* Checks that every entry of the file's schema is a statement of schema.sql and that none is repeated; *n is the number
   of entries. */
static koksma_status compare(koksma__database *database, int *n)
{
    koksma__statement *s;
    bool seen[STATEMENTS] = {false};
    char *out = NULL, *known = malloc(strlen(koksma__schema_sql) + 1);
    koksma_status status = koksma__statement_open(database, "SELECT sql, type, name FROM sqlite_schema", &s);
    *n = 0;
    while (koksma__next_row(database, s, &status)) {
        const char *sql, *type, *name;
        if (!koksma__read(s, 0, "ttt", &sql, &type, &name) && !strcmp(type, "index") &&
            !strncmp(name, "sqlite_autoindex_", 17)) {
            continue; /* skips the indices that SQLite makes for UNIQUE and PRIMARY KEY */
        }
        free(out);
        out = malloc(strlen(sql) + 1);
        const int i = out && known ? find_statement(koksma__schema_sql, sql, out, known) : -1;
        if (!out || !known) {
            status = koksma__fail_memory(strlen(sql));
        } else if (i < 0 || i >= STATEMENTS || seen[i]) {
            status = koksma__fail(
                KOKSMA_MALFORMED,
                "%s: not a store of koksma study: its %.20s '%.100s' is another program's; choose another folder",
                koksma__database_path(database), type, name);
        } else {
            seen[i] = true;
            ++*n;
        }
    }
    koksma__statement_close(s);
    free(out);
    free(known);
    return status;
}

/* Checks that the database is a store of KOKSMA__SCHEMA and has no other tables. Errors: MALFORMED (another program's
   database, or another schema). */
static koksma_status check_schema(koksma__database *database, const koksma__database_header *header)
{
    const char *path = koksma__database_path(database);
    const bool ours = header->application_id == APPLICATION;
    int n = 0;
    KOKSMA__FAIL_IF(ours && header->version != KOKSMA__SCHEMA, KOKSMA_MALFORMED,
                    "%s: the file has schema %u, but this program has schema %d; choose another folder", path,
                    (unsigned)header->version, KOKSMA__SCHEMA);
    const koksma_status status = ours ? compare(database, &n) : KOKSMA_OK;
    KOKSMA__FAIL_IF(!status && n != STATEMENTS, KOKSMA_MALFORMED,
                    "%s: not a store of koksma study; choose another folder", path);
    return status;
}

/* Creates the tables of KOKSMA__SCHEMA in an empty database. */
static koksma_status make_schema(koksma__database *database)
{
    char header[96];
    snprintf(header, sizeof header, "PRAGMA application_id=%u; PRAGMA user_version=%d", (unsigned)APPLICATION,
             KOKSMA__SCHEMA);
    const koksma_status status = koksma__database_execute(database, header);
    return status ? status : koksma__database_execute(database, koksma__schema_sql);
}

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
    [KOKSMA__ADD_SERIES] = "INSERT INTO series (" SERIES_KEY ", id) VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?)",
    [KOKSMA__PUT_ROW] = PUT_ROWS(ROW),
    [KOKSMA__PUT_ROWS] = PUT_ROWS(TIMES_32(ROW)),
    [KOKSMA__GET_ROW] = "SELECT * FROM result WHERE id = ?",
    [KOKSMA__GET_ROWS] = "SELECT * FROM result ORDER BY id",
    [KOKSMA__GET_RESULTS] = "SELECT trial << 32 | series, seed, v0, v1, v2, v3 FROM sorted WHERE series = ? AND "
                            "trial < ? ORDER BY trial",
    [KOKSMA__GET_SERIES] = "SELECT " SORT_KEY ", id FROM series ORDER BY " SORT_KEY,
    [KOKSMA__LAST_SERIES] = "SELECT max(id) FROM series",
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

/* ---- Allocation ---------------------------------------------------------------------------------------- */

static koksma_status make_store(koksma__database *database, koksma__store **out)
{
    koksma__store *store = calloc(1, sizeof *store);
    *out = store;
    if (!store) {
        koksma__database_close(database);
        return koksma__fail_memory(sizeof *store);
    }
    store->database = database;
    pthread_mutex_init(&store->lock, NULL);
    return koksma__store_rows_init(store);
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

/* ---- New stores ---------------------------------------------------------------------------------------- */

/* Builds a complete store without rows in an empty file that no other program knows. Messages name the file `shown`. */
static koksma_status build(const char *path, const char *shown, koksma__store **out)
{
    koksma__database *database;
    koksma_status status = koksma__database_open(path, shown, KOKSMA__DATABASE_BUILD, &database);
    *out = NULL;
    status = status ? status : make_store(database, out);
    status = status ? status : koksma__store_begin(*out);
    status = status ? status : make_schema(database);
    status = status ? status : open_queries(*out);
    return status ? status : koksma__store_end(*out);
}

/* Sets bytes 18 and 19 of the header, which mark a file with a write-ahead log (https://sqlite.org/fileformat.html).
   SQLite itself would change the header in place, with a journal that a kill may leave behind. */
static koksma_status mark_as_logged(const char *temporary, const char *path)
{
    FILE *stream = fopen(temporary, "r+be");
    const bool written = stream && !fseek(stream, 18, SEEK_SET) && fwrite("\2\2", 1, 2, stream) == 2;
    const bool done = stream && !fclose(stream) && written;
    return done ? KOKSMA_OK : koksma__fail(KOKSMA_IO, "%s: writing failed: %s", path, strerror(errno));
}

/* Builds a store under a temporary name and gives it the name `path` when complete. It replaces nothing, so that it
   cannot destroy the store of another run that was faster. */
static koksma_status put_in_place(const char *path)
{
    koksma__atomic_file file;
    koksma__store *store;
    KOKSMA__TRY(koksma__atomic_open(NULL, path, &file));
    char temporary[KOKSMA__TEMPORARY_PATH];
    koksma__atomic_temporary(&file, temporary);
    koksma_status status = build(temporary, path, &store);
    const koksma_status closed = koksma__store_close(store);
    status = status ? status : closed;
    status = status ? status : mark_as_logged(temporary, path);
    /* the file system may have no hard links; the file is then renamed */
    const bool rename = !status && link(temporary, path) && errno != EEXIST;
    const koksma_status placed = koksma__atomic_close(&file, rename);
    return status ? status : placed;
}

/* ---- Existing stores ----------------------------------------------------------------------------------- */

/* Checks that the file belongs to the plan `name`; writes the name into a new file. */
static koksma_status check_plan(koksma__store *store, const char *name)
{
    char *found;
    koksma_status status = koksma__store_find_text(store, "plan", &found);
    if (!status && !found) {
        status = koksma__store_put_text(store, "plan", name);
    } else if (!status && strcmp(found, name) != 0) {
        status = koksma__fail(KOKSMA_MALFORMED, "%s: its plan is '%s' and this run's is '%s'; choose another folder",
                              koksma__database_path(store->database), found, name);
    }
    free(found);
    return status;
}

/* Opens a store to read and checks its header and tables before anything can write to it. */
static koksma_status look(const char *path, bool *exists, koksma__database **out)
{
    koksma__database_header header;
    koksma_status status = koksma__database_look(path, &header);
    *out = NULL;
    *exists = header.exists;
    if (!status && *exists) {
        status = koksma__database_open(path, path, KOKSMA__DATABASE_READ, out);
        status = status ? status : check_schema(*out, &header);
    }
    if (status) {
        koksma__database_close(*out);
        *out = NULL;
    }
    return status;
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

static koksma_status open_to_read(const char *path, koksma__store **out)
{
    koksma__database *database;
    bool exists;
    koksma_status status = look(path, &exists, &database);
    if (!status && !exists) {
        status = koksma__fail(KOKSMA_MISSING, "%s: %s; 'koksma study run' makes it", path, strerror(ENOENT));
    }
    status = status ? status : check_pages(database);
    if (status) {
        koksma__database_close(database);
        return status;
    }
    status = make_store(database, out);
    return status ? status : open_queries(*out);
}

/* Makes a new store where there was none. A log beside it belongs to a database that is gone, and SQLite would write its
   contents into the new file. */
static koksma_status make_new(const char *path)
{
    static const char *const log_endings[] = {"-wal", "-shm", "-journal"};
    char beside[4096];
    struct stat info;
    for (size_t i = 0; i < sizeof log_endings / sizeof *log_endings; i++) {
        snprintf(beside, sizeof beside, "%s%s", path, log_endings[i]);
        KOKSMA__FAIL_IF(!lstat(beside, &info), KOKSMA_MALFORMED,
                        "%s: the database that it belongs to is gone; remove it, or choose another folder", beside);
    }
    return put_in_place(path);
}

/* Opens a store for the only run that may write it; a second run on the same folder fails instead of doing the
   work twice. */
static koksma_status open_to_write(const char *path, const char *plan_name, koksma__store **out)
{
    koksma__database *database;
    koksma__database_header header;
    bool exists;
    KOKSMA__FAIL_IF(access(path, W_OK) && errno != ENOENT, KOKSMA_IO, "%s: can't be written: %s", path,
                    strerror(errno));
    koksma_status status = look(path, &exists, &database);
    koksma__database_close(status ? NULL : database);
    if (!status && !exists) {
        status = make_new(path);
    }
    status = status ? status : koksma__database_open(path, path, KOKSMA__DATABASE_WRITE, &database);
    status = status ? status : make_store(database, out);
    status = status ? status : koksma__store_begin(*out);
    if (!status && koksma__database_has_moved(database)) {
        status = koksma__fail(KOKSMA_IO, "%s: another run is using it", path);
    }
    /* check again, now that no other program can write */
    status = status ? status : koksma__database_look(path, &header);
    status = status ? status : check_schema(database, &header);
    status = status ? status : open_queries(*out);
    status = status ? status : check_pages(database); /* damage must be reported before any byte is written */
    if (!status && plan_name) {
        status = check_plan(*out, plan_name);
    }
    return status ? status : koksma__store_end(*out);
}

koksma_status koksma__store_open(const char *path, koksma__store_mode mode, const char *plan_name,
                                 koksma__store **out)
{
    koksma__store *store = NULL;
    const koksma_status status =
        mode == KOKSMA__STORE_WRITE ? open_to_write(path, plan_name, &store) : open_to_read(path, &store);
    *out = store;
    if (status) {
        if (store) {
            store->in_transaction = false; /* closing the database rolls the transaction back */
            koksma__store_wrote(store, status);
        }
        koksma__store_close(store);
        *out = NULL;
        return status;
    }
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
    koksma__point_files_fini(&store->files);
    pthread_mutex_destroy(&store->lock);
    free(store);
    return status;
}
