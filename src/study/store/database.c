/* SPDX-License-Identifier: Apache-2.0 */
/* SQLite behind a narrow interface: opens a file, runs statements, binds values, steps through rows, and turns error
   codes into a status and a text. No other file includes sqlite3.h. */
#include "study/store/database.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <sqlite3.h>

#include "core/status.h"

struct koksma__database {
    sqlite3 *file;
    char *path;
};

/* A lock dies with its process, but a process that was killed holds it until the system has found time to end it. */
enum { LAST_BREATH_MS = 1500 };

static koksma_status fail(koksma__database *database)
{
    const char *path = database->path;
    const int code = sqlite3_errcode(database->file);
    if (code == SQLITE_BUSY || code == SQLITE_LOCKED) {
        return koksma__fail(KOKSMA_IO, "%s: another run is at work on it", path);
    }
    if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: %s; move it away to begin anew", path,
                            sqlite3_errmsg(database->file));
    }
    if (code == SQLITE_READONLY || code == SQLITE_CANTOPEN) {
        return koksma__fail(KOKSMA_IO, "%s: can't be written; its folder must be writable, too", path);
    }
    if (code == SQLITE_NOMEM) {
        return koksma__fail(KOKSMA_MEMORY, "%s: out of memory", path);
    }
    return koksma__fail(KOKSMA_IO, "%s: %s", path, sqlite3_errmsg(database->file));
}

koksma_status koksma__database_open(const char *path, bool create, koksma__database **out)
{
    koksma__database *database = calloc(1, sizeof *database);
    *out = NULL;
    if (!database || !(database->path = strdup(path))) {
        free(database);
        return koksma__fail_memory(sizeof *database);
    }
    koksma_status status = KOKSMA_OK;
    if (!create && access(path, F_OK)) {
        status = koksma__fail(KOKSMA_MISSING, "%s: %s", path, strerror(errno));
    } else if (access(path, W_OK) && errno != ENOENT) { /* SQLite's own words for it mislead; also readers lock */
        status = koksma__fail(KOKSMA_IO, "%s: can't be written: %s", path, strerror(errno));
    }
    const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX | (create ? SQLITE_OPEN_CREATE : 0);
    if (!status && sqlite3_open_v2(path, &database->file, flags, NULL) != SQLITE_OK) {
        status = fail(database);
    }
    if (status) {
        koksma__database_close(database);
        return status;
    }
    sqlite3_busy_timeout(database->file, LAST_BREATH_MS);
    *out = database;
    return KOKSMA_OK;
}

void koksma__database_close(koksma__database *database)
{
    if (database) {
        sqlite3_close(database->file);
        free(database->path);
        free(database);
    }
}

const char *koksma__database_path(const koksma__database *database)
{
    return database->path;
}

koksma_status koksma__database_execute(koksma__database *database, const char *sql)
{
    return sqlite3_exec(database->file, sql, NULL, NULL, NULL) == SQLITE_OK ? KOKSMA_OK : fail(database);
}

int koksma__database_changes(koksma__database *database)
{
    return sqlite3_changes(database->file);
}

koksma_status koksma__statement_open(koksma__database *database, const char *sql, koksma__statement **out)
{
    return sqlite3_prepare_v3(database->file, sql, -1, SQLITE_PREPARE_PERSISTENT, out, NULL) == SQLITE_OK
               ? KOKSMA_OK
               : fail(database);
}

void koksma__statement_close(koksma__statement *statement)
{
    sqlite3_finalize(statement);
}

void koksma__bind_text(koksma__statement *s, int *column, const char *text)
{
    sqlite3_bind_text(s, (*column)++, text, -1, SQLITE_STATIC);
}

void koksma__bind_whole(koksma__statement *s, int *column, long long value)
{
    sqlite3_bind_int64(s, (*column)++, value);
}

void koksma__bind_number(koksma__statement *s, int *column, double value)
{
    sqlite3_bind_double(s, (*column)++, value);
}

koksma_status koksma__statement_run(koksma__database *database, koksma__statement *s)
{
    const bool done = sqlite3_step(s) == SQLITE_DONE;
    const koksma_status status = done ? KOKSMA_OK : fail(database);
    sqlite3_reset(s);
    return status;
}

bool koksma__next_row(koksma__database *database, koksma__statement *s, koksma_status *status)
{
    const int code = *status ? SQLITE_DONE : sqlite3_step(s);
    if (code != SQLITE_ROW && code != SQLITE_DONE) {
        *status = fail(database);
    }
    return code == SQLITE_ROW;
}

void koksma__statement_reset(koksma__statement *s)
{
    sqlite3_reset(s);
}

const char *koksma__column_text(koksma__statement *s, int column)
{
    const char *text = (const char *)sqlite3_column_text(s, column);
    return text ? text : "";
}

long long koksma__column_whole(koksma__statement *s, int column)
{
    return sqlite3_column_int64(s, column);
}

double koksma__column_number(koksma__statement *s, int column)
{
    return koksma__column_is_null(s, column) ? (double)NAN : sqlite3_column_double(s, column);
}

bool koksma__column_is_null(koksma__statement *s, int column)
{
    return sqlite3_column_type(s, column) == SQLITE_NULL;
}
