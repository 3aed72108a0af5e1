/* SPDX-License-Identifier: Apache-2.0 */
/*
 * SQLite behind a narrow interface: opens a file, runs statements, binds values, steps through rows, and turns
 * error codes into a status and a text. No other file includes sqlite3.h.
 *
 * A database may come from an untrusted source: every connection is "defensive", does not trust the schema, and has
 * triggers and views switched off (https://sqlite.org/security.html).
 */
#include "study/store/store_internal.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <sqlite3.h>

#include "core/status.h"

struct koksma__database {
    sqlite3 *file;
    bool writes;
    char *path; /* for error messages */
};

/* How long to wait for a lock. A lock ends with its process, but a killed process may hold it for a while, until the
   system has removed the process. */
enum { LAST_BREATH_MS = 1500 };

/* Returns the system's error number behind SQLite's last error, or 0. SQLite keeps one for the connection, which a
   rollback after the error may have overwritten, and one for each file. */
static int system_error(sqlite3 *file)
{
    sqlite3_file *journal = NULL;
    int number = sqlite3_system_errno(file);
    if (!number && file) { /* without memory there is no connection */
        sqlite3_file_control(file, NULL, SQLITE_FCNTL_LAST_ERRNO, &number);
    }
    if (!number && file && sqlite3_file_control(file, NULL, SQLITE_FCNTL_JOURNAL_POINTER, &journal) == SQLITE_OK &&
        journal && journal->pMethods && journal->pMethods->xFileControl) { /* one in memory has none */
        journal->pMethods->xFileControl(journal, SQLITE_FCNTL_LAST_ERRNO, &number);
    }
    return number;
}

static koksma_status fail(koksma__database *database)
{
    const char *path = database->path, *reason = sqlite3_errmsg(database->file);
    const int code = sqlite3_errcode(database->file), system = system_error(database->file);
    switch (code) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED: /* a reader is kept out by runs only, and a run by other runs and by readers */
        return koksma__fail(KOKSMA_IO,
                            database->writes ? "%s: another run, or an export, report or audit, is using it"
                                             : "%s: another run is using it",
                            path);
    case SQLITE_ERROR: /* of a statement about a table that has other columns */
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
        return koksma__fail(KOKSMA_MALFORMED, "%s: %s; move it away to begin anew", path, reason);
    case SQLITE_CONSTRAINT:
        return koksma__fail(KOKSMA_MALFORMED, "%s: %s", path, reason);
    case SQLITE_NOMEM:
        return koksma__fail(KOKSMA_MEMORY, "%s: out of memory", path);
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
        KOKSMA__FAIL_IF(system == 0 || system == EACCES || system == EROFS || system == EPERM || system == ENOENT,
                        KOKSMA_IO, "%s: can't be written; its folder must be writable, too", path);
        break;
    case SQLITE_FULL:
        return koksma__fail(KOKSMA_IO, "%s: %s", path, strerror(ENOSPC));
    default:
        break;
    }
    const bool of_system = system && (code == SQLITE_IOERR || code == SQLITE_CANTOPEN);
    return koksma__fail(KOKSMA_IO, "%s: %s", path, of_system ? strerror(system) : reason);
}

/* A run needs no file yet. What is no regular file is not opened, because reading a pipe might not end. */
static koksma_status check_file(const char *path, bool writes)
{
    struct stat info;
    const bool exists = !stat(path, &info);
    KOKSMA__FAIL_IF(!exists && !writes && errno == ENOTDIR, KOKSMA_MISSING,
                    "%s: %s; a study is the folder that 'koksma study run' makes", path, strerror(errno));
    KOKSMA__FAIL_IF(!exists && errno != ENOENT, KOKSMA_IO, "%s: %s", path, strerror(errno));
    KOKSMA__FAIL_IF(!exists && !writes, KOKSMA_MISSING, "%s: %s; 'koksma study run' makes it", path, strerror(errno));
    return exists && !S_ISREG(info.st_mode) ? koksma__fail(KOKSMA_MALFORMED, "%s: not a regular file", path)
                                            : KOKSMA_OK;
}

static koksma_status open_file(koksma__database *database)
{
    static const struct {
        int what, on;
    } settings[] = {{SQLITE_DBCONFIG_DEFENSIVE, 1},
                    {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                    {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                    {SQLITE_DBCONFIG_ENABLE_VIEW, 0}};
    /* A reader, too, may have to roll back what a killed run left. Where it can't write, SQLite opens to read. */
    const int flags = SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_READWRITE | (database->writes ? SQLITE_OPEN_CREATE : 0);
    char path[4096];
    /* SQLite might take a relative path for a URI */
    snprintf(path, sizeof path, "%s%s", database->path[0] == '/' ? "" : "./", database->path);
    if (sqlite3_open_v2(path, &database->file, flags, NULL) != SQLITE_OK) {
        return fail(database);
    }
    sqlite3_busy_timeout(database->file, LAST_BREATH_MS);
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        sqlite3_db_config(database->file, settings[i].what, settings[i].on, NULL);
    }
    return koksma__database_execute(database, "PRAGMA cell_size_check=ON; PRAGMA cache_size=-32768; "
                                              "PRAGMA page_size=16384");
}

koksma_status koksma__database_open(const char *path, bool writes, koksma__database **out)
{
    *out = NULL;
    KOKSMA__TRY(check_file(path, writes));
    koksma__database *database = calloc(1, sizeof *database);
    KOKSMA__REQUIRE_MEMORY(database, sizeof *database);
    database->writes = writes;
    database->path = strdup(path);
    const koksma_status status = database->path ? open_file(database) : koksma__fail_memory(strlen(path));
    if (status) {
        koksma__database_close(database);
        return status;
    }
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

void koksma__bind(koksma__statement *s, int column, const char *types, ...)
{
    va_list values;
    va_start(values, types);
    for (; *types; types++, column++) {
        if (*types == 't') {
            sqlite3_bind_text(s, column, va_arg(values, const char *), -1, SQLITE_STATIC);
        } else if (*types == 'w') {
            sqlite3_bind_int64(s, column, va_arg(values, long long));
        } else {
            sqlite3_bind_double(s, column, va_arg(values, double));
        }
    }
    va_end(values);
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

bool koksma__read(koksma__statement *s, int column, const char *types, ...)
{
    bool right = true;
    va_list out;
    va_start(out, types);
    for (; *types; types++, column++) {
        const int type = sqlite3_column_type(s, column);
        if (*types == 't') {
            const char *text = (const char *)sqlite3_column_text(s, column);
            *va_arg(out, const char **) = text ? text : "";
            right = right && type == SQLITE_TEXT;
        } else if (*types == 'w') {
            *va_arg(out, long long *) = sqlite3_column_int64(s, column);
            right = right && type == SQLITE_INTEGER;
        } else {
            const double number = type == SQLITE_NULL ? (double)NAN : sqlite3_column_double(s, column);
            *va_arg(out, double *) = number;
            right = right && (type == SQLITE_NULL || (type == SQLITE_FLOAT && isfinite(number)));
        }
    }
    va_end(out);
    return right;
}
