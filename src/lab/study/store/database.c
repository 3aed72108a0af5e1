/* SPDX-License-Identifier: Apache-2.0 */
/*
 * SQLite behind a narrow interface: opens a file, runs statements, binds values, steps through rows, and turns
 * error codes into a status and a text. No other file includes sqlite3.h.
 *
 * A database may come from an untrusted source. Its header is checked before SQLite opens it; every connection is
 * "defensive", does not trust the schema, and has triggers and views switched off
 * (https://sqlite.org/security.html).
 *
 * To read a file, a second handle, which is used only for locking, takes the shared lock that SQLite's readers take.
 * The file then can't change and is opened as immutable: SQLite takes no further locks and makes no write-ahead log,
 * so that the folder need not be writable. If a killed run has left a write-ahead log, SQLite needs an index of the
 * log. It keeps that index in memory only in exclusive mode, in which it would lock the file for writing. The VFS
 * "unix-none", which has no locks, prevents that write lock; the second handle's shared lock still protects the file.
 */
#include "study/store/store_internal.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sqlite3.h>

#include "core/status.h"

enum { MAX_PATH = 4096, HEADER = 100 };

/* A file opened through SQLite's VFS, which refers to the name until the file is closed. */
typedef struct held_file {
    char *name;
    sqlite3_file file; /* must be last: the VFS needs further bytes after this member */
} held_file;

struct koksma__database {
    sqlite3 *file;
    held_file *lock;             /* the second handle, which holds SQLite's shared lock while the file is read */
    char *path;                  /* the path, for error messages */
    char real[MAX_PATH];         /* the absolute path, which SQLite cannot take for a URI */
    char uri[3 * MAX_PATH + 64]; /* the URI that opens the file for reading */
};

/* How long to wait for a lock, and how often to try. A lock ends with its process, but a killed process may hold it
   for a while, until the system has removed the process. */
enum { LAST_BREATH_MS = 1500, LOOK_AGAIN_MS = 10 };

/* A reader is kept out by runs only, and a run by other runs and by readers. */
static koksma_status fail_busy(const koksma__database *database)
{
    return koksma__fail(KOKSMA_IO,
                        database->lock ? "%s: another run is using it"
                                       : "%s: another run, or an export, report or audit, is using it",
                        database->path);
}

/* Returns the system's error number behind SQLite's last error, or 0. SQLite keeps one for the connection, which a
   rollback after the error may have overwritten, and one for each file: the database, and its write-ahead log or
   journal, to which most writes go. */
static int system_error(sqlite3 *file)
{
    sqlite3_file *log = NULL;
    int number = sqlite3_system_errno(file);
    if (!number && file) { /* without memory there is no connection */
        sqlite3_file_control(file, NULL, SQLITE_FCNTL_LAST_ERRNO, &number);
    }
    if (!number && file && sqlite3_file_control(file, NULL, SQLITE_FCNTL_JOURNAL_POINTER, &log) == SQLITE_OK && log &&
        log->pMethods && log->pMethods->xFileControl) { /* a journal in memory has none */
        log->pMethods->xFileControl(log, SQLITE_FCNTL_LAST_ERRNO, &number);
    }
    return number;
}

static koksma_status fail(koksma__database *database)
{
    const char *path = database->path, *reason = sqlite3_errmsg(database->file);
    const int code = sqlite3_errcode(database->file), system = system_error(database->file);
    switch (code) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        return fail_busy(database);
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

/* ---- Looking at a file before SQLite opens it ----------------------------------------------------------- */

static void close_file(held_file *held)
{
    if (held) {
        if (held->file.pMethods) {
            held->file.pMethods->xClose(&held->file);
        }
        sqlite3_free_filename(held->name);
        sqlite3_free(held);
    }
}

/* Opens a file through SQLite's own VFS, which knows the other descriptors of this process: under POSIX, closing
   a second descriptor of a file would release the locks of the first. */
static koksma_status open_file(const char *path, held_file **out)
{
    sqlite3_vfs *vfs = sqlite3_vfs_find(NULL);
    int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_MAIN_DB;
    const size_t size = offsetof(held_file, file) + (size_t)vfs->szOsFile;
    held_file *held = sqlite3_malloc64(size);
    *out = NULL;
    if (!held) {
        return koksma__fail_memory(size);
    }
    memset(held, 0, size);
    held->name = (char *)sqlite3_create_filename(path, "", "", 0, NULL);
    if (!held->name) {
        close_file(held);
        return koksma__fail_memory(size);
    }
    errno = 0;
    const int code = vfs->xOpen(vfs, held->name, &held->file, flags, &flags);
    const int reason = errno;
    if (code != SQLITE_OK) {
        close_file(held);
        return koksma__fail(KOKSMA_IO, "%s: can't be read: %s", path, strerror(reason ? reason : EIO));
    }
    *out = held;
    return KOKSMA_OK;
}

/* Finds whether a file exists and its size. Fails if it is not a regular file, because reading a pipe might not
   end. */
static koksma_status look_at(const char *path, bool follow_link, bool *exists, long long *size)
{
    struct stat info;
    *exists = !(follow_link ? stat(path, &info) : lstat(path, &info));
    *size = *exists ? (long long)info.st_size : 0;
    KOKSMA__FAIL_IF(!*exists && errno == ENOTDIR, KOKSMA_MISSING,
                    "%s: %s; a study is the folder that 'koksma study run' makes", path, strerror(errno));
    KOKSMA__FAIL_IF(!*exists && errno != ENOENT, KOKSMA_IO, "%s: %s", path, strerror(errno));
    return *exists && !S_ISREG(info.st_mode) ? koksma__fail(KOKSMA_MALFORMED, "%s: not a regular file", path)
                                             : KOKSMA_OK;
}

/* Finds the size of a file that SQLite writes beside the database, with the ending "-wal" or "-journal". It follows no link
   there. */
static koksma_status look_beside(const char *path, const char *ending, long long *size)
{
    char beside[MAX_PATH + 16];
    bool exists;
    strcpy(stpcpy(beside, path), ending);
    return look_at(beside, false, &exists, size);
}

static uint32_t word_at(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

koksma_status koksma__database_look(const char *path, koksma__database_header *header)
{
    unsigned char bytes[HEADER];
    long long size;
    held_file *held;
    *header = (koksma__database_header){0};
    koksma_status status = look_at(path, true, &header->exists, &size);
    if (status || !header->exists) {
        return status;
    }
    KOKSMA__FAIL_IF(size == 0, KOKSMA_MALFORMED, "%s: it is empty; move it away to begin anew", path);
    /* symbolic links are resolved first, because SQLite's VFS does not follow them here */
    char *real = realpath(path, NULL);
    status = real ? open_file(real, &held) : koksma__fail(KOKSMA_IO, "%s: %s", path, strerror(errno));
    free(real);
    KOKSMA__TRY(status);
    const int code = held->file.pMethods->xRead(&held->file, bytes, HEADER, 0);
    close_file(held);
    KOKSMA__FAIL_IF(code != SQLITE_OK && code != SQLITE_IOERR_SHORT_READ, KOKSMA_IO, "%s: can't be read: %s", path,
                    strerror(EIO));
    KOKSMA__FAIL_IF(code != SQLITE_OK || memcmp(bytes, "SQLite format 3", 16) != 0, KOKSMA_MALFORMED,
                    "%s: file is not a database; move it away to begin anew", path);
    header->version = word_at(bytes + 60);
    header->application_id = word_at(bytes + 68);
    return KOKSMA_OK;
}

/* ---- Opening ------------------------------------------------------------------------------------------- */

static koksma_status lock_to_read(koksma__database *database)
{
    koksma_status status = open_file(database->real, &database->lock);
    for (int waited = 0; !status; waited += LOOK_AGAIN_MS) {
        const int code = database->lock->file.pMethods->xLock(&database->lock->file, SQLITE_LOCK_SHARED);
        if (code == SQLITE_OK) {
            return KOKSMA_OK;
        }
        if (code != SQLITE_BUSY || waited >= LAST_BREATH_MS) {
            status = code == SQLITE_BUSY ? fail_busy(database)
                                         : koksma__fail(KOKSMA_IO, "%s: can't be locked", database->path);
        }
        sqlite3_sleep(LOOK_AGAIN_MS);
    }
    return status;
}

/* Writes the URI "file:/a%3fb?…" of the absolute path, escaped as SQLite requires. */
static void write_uri(koksma__database *database, const char *query)
{
    char *to = stpcpy(database->uri, "file:");
    for (const char *from = database->real; *from; from++) {
        static const char digits[] = "0123456789abcdef";
        const unsigned char c = (unsigned char)*from;
        if (strchr("%?#", c)) {
            *to++ = '%';
            *to++ = digits[c >> 4];
            *to++ = digits[c & 15];
        } else {
            *to++ = *from;
        }
    }
    strcpy(to, query);
}

static koksma_status prepare_to_read(koksma__database *database)
{
    long long log, journal;
    koksma_status status = lock_to_read(database);
    status = status ? status : look_beside(database->real, "-journal", &journal);
    status = status ? status : look_beside(database->real, "-wal", &log);
    if (!status && journal) {
        status = koksma__fail(
            KOKSMA_MALFORMED,
            "%s-journal: another program left a journal of the database and must complete its work first",
            database->path);
    }
    if (!status && log) {
        write_uri(database, "?mode=ro&vfs=unix-none");
    }
    return status;
}

static koksma_status harden(koksma__database *database)
{
    static const struct {
        int what, on;
    } settings[] = {{SQLITE_DBCONFIG_DEFENSIVE, 1},
                    {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                    {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                    {SQLITE_DBCONFIG_ENABLE_VIEW, 0}};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        sqlite3_db_config(database->file, settings[i].what, settings[i].on, NULL);
    }
    return koksma__database_execute(database, "PRAGMA cell_size_check=ON");
}

static koksma_status open_as(koksma__database *database, koksma__database_mode mode)
{
    static const char *const settings[] = {
        [KOKSMA__DATABASE_READ] = "PRAGMA locking_mode=EXCLUSIVE; PRAGMA cache_size=-32768",
        [KOKSMA__DATABASE_WRITE] = ("PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=WAL; PRAGMA "
                                    "synchronous=FULL; PRAGMA cache_size=-32768"),
        [KOKSMA__DATABASE_BUILD] = "PRAGMA page_size=16384; PRAGMA journal_mode=MEMORY; PRAGMA synchronous=FULL"};
    const bool read = mode == KOKSMA__DATABASE_READ;
    const char *path = read ? database->uri : database->real;
    const int flags = SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_URI | (read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE);
    write_uri(database, "?mode=ro&immutable=1");
    koksma_status status = read ? prepare_to_read(database) : KOKSMA_OK;
    if (!status && sqlite3_open_v2(path, &database->file, flags, NULL) != SQLITE_OK) {
        return fail(database);
    }
    if (!status) {
        sqlite3_busy_timeout(database->file, LAST_BREATH_MS);
        sqlite3_db_config(database->file, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, mode != KOKSMA__DATABASE_WRITE, NULL);
        status = harden(database);
    }
    return status ? status : koksma__database_execute(database, settings[mode]);
}

koksma_status koksma__database_open(const char *path, const char *shown, koksma__database_mode mode,
                                    koksma__database **out)
{
    koksma__database *database = calloc(1, sizeof *database);
    char *whole = NULL;
    koksma_status status = KOKSMA_OK;
    *out = NULL;
    if (!database || !(database->path = strdup(shown))) {
        status = koksma__fail_memory(sizeof *database);
    } else if (!(whole = realpath(path, NULL))) {
        status = koksma__fail(errno == ENOENT ? KOKSMA_MISSING : KOKSMA_IO, "%s: %s", shown, strerror(errno));
    } else if (strlen(whole) >= MAX_PATH) {
        status = koksma__fail(KOKSMA_ARGUMENT, "%s: the path is too long", shown);
    }
    if (!status) {
        strcpy(database->real, whole);
        status = open_as(database, mode);
    }
    free(whole);
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
        close_file(database->lock);
        free(database->path);
        free(database);
    }
}

bool koksma__database_has_moved(koksma__database *database)
{
    int moved = 0;
    sqlite3_file_control(database->file, NULL, SQLITE_FCNTL_HAS_MOVED, &moved);
    return moved;
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
