/* SPDX-License-Identifier: Apache-2.0 */
/* SQLite with faults: its usual files and memory, with a question asked before each call. The files offer no shared
   memory, which only a write-ahead log would need. */
#include <sqlite3.h>

#include "faults.h"

/* ---- Memory -------------------------------------------------------------------------------------------- */

static sqlite3_mem_methods usual_memory;

static void *take(int bytes)
{
    return fault_here(FAULT_DB_MEMORY, NULL) ? NULL : usual_memory.xMalloc(bytes);
}

static void *take_more(void *old, int bytes)
{
    return fault_here(FAULT_DB_MEMORY, NULL) ? NULL : usual_memory.xRealloc(old, bytes);
}

/* ---- Files --------------------------------------------------------------------------------------------- */

typedef struct file {
    sqlite3_file base; /* first: SQLite casts */
    sqlite3_file *usual;
} file;

static sqlite3_vfs faulty, *usual;

static sqlite3_file *below(sqlite3_file *f)
{
    return ((file *)f)->usual;
}

static int on_close(sqlite3_file *f)
{
    return below(f)->pMethods->xClose(below(f));
}

static int on_write(sqlite3_file *f, const void *bytes, int size, sqlite3_int64 at)
{
    bool half = false;
    if (fault_here(FAULT_DB, &half)) {
        if (half) {
            below(f)->pMethods->xWrite(below(f), bytes, size / 2, at);
            fault_end();
        }
        return SQLITE_FULL;
    }
    return below(f)->pMethods->xWrite(below(f), bytes, size, at);
}

/* A method of a file: it fails with `code`, or is the usual one. */
#define METHOD(name, method, parameters, arguments, code)                                                            \
    static int name parameters                                                                                       \
    {                                                                                                                \
        return fault_here(FAULT_DB, NULL) ? (code) : below(f)->pMethods->method arguments;                           \
    }
METHOD(on_read, xRead, (sqlite3_file * f, void *bytes, int size, sqlite3_int64 at), (below(f), bytes, size, at),
       SQLITE_IOERR_READ)
METHOD(on_truncate, xTruncate, (sqlite3_file * f, sqlite3_int64 size), (below(f), size), SQLITE_IOERR_TRUNCATE)
METHOD(on_sync, xSync, (sqlite3_file * f, int flags), (below(f), flags), SQLITE_IOERR_FSYNC)
METHOD(on_size, xFileSize, (sqlite3_file * f, sqlite3_int64 *size), (below(f), size), SQLITE_IOERR_FSTAT)
METHOD(on_lock, xLock, (sqlite3_file * f, int level), (below(f), level), SQLITE_IOERR_LOCK)
METHOD(on_check_lock, xCheckReservedLock, (sqlite3_file * f, int *locked), (below(f), locked),
       SQLITE_IOERR_CHECKRESERVEDLOCK)
#undef METHOD

static int on_unlock(sqlite3_file *f, int level)
{
    return below(f)->pMethods->xUnlock(below(f), level);
}

static int on_control(sqlite3_file *f, int what, void *argument)
{
    return below(f)->pMethods->xFileControl(below(f), what, argument);
}

static int on_sector(sqlite3_file *f)
{
    return below(f)->pMethods->xSectorSize(below(f));
}

static int on_characteristics(sqlite3_file *f)
{
    return below(f)->pMethods->xDeviceCharacteristics(below(f));
}

static int on_open(sqlite3_vfs *vfs, const char *path, sqlite3_file *f, int flags, int *got)
{
    static const sqlite3_io_methods methods = {.iVersion = 1,
                                               .xClose = on_close,
                                               .xRead = on_read,
                                               .xWrite = on_write,
                                               .xTruncate = on_truncate,
                                               .xSync = on_sync,
                                               .xFileSize = on_size,
                                               .xLock = on_lock,
                                               .xUnlock = on_unlock,
                                               .xCheckReservedLock = on_check_lock,
                                               .xFileControl = on_control,
                                               .xSectorSize = on_sector,
                                               .xDeviceCharacteristics = on_characteristics};
    file *opened = (file *)f;
    (void)vfs;
    *opened = (file){.usual = (sqlite3_file *)(void *)(opened + 1)};
    if (fault_here(FAULT_DB, NULL)) {
        return SQLITE_CANTOPEN;
    }
    const int code = usual->xOpen(usual, path, opened->usual, flags, got);
    opened->base.pMethods = opened->usual->pMethods ? &methods : NULL;
    return code;
}

static int on_delete(sqlite3_vfs *vfs, const char *path, int sync)
{
    (void)vfs;
    return fault_here(FAULT_DB, NULL) ? SQLITE_IOERR_DELETE : usual->xDelete(usual, path, sync);
}

static int on_access(sqlite3_vfs *vfs, const char *path, int flags, int *answer)
{
    (void)vfs;
    return fault_here(FAULT_DB, NULL) ? SQLITE_IOERR_ACCESS : usual->xAccess(usual, path, flags, answer);
}

void fault_install_sqlite(void)
{
    sqlite3_config(SQLITE_CONFIG_GETMALLOC, &usual_memory);
    sqlite3_mem_methods memory = usual_memory;
    memory.xMalloc = take;
    memory.xRealloc = take_more;
    sqlite3_config(SQLITE_CONFIG_MALLOC, &memory);
    usual = sqlite3_vfs_find(NULL);
    faulty = *usual;
    faulty.zName = "faulty";
    faulty.szOsFile = (int)sizeof(file) + usual->szOsFile;
    faulty.xOpen = on_open;
    faulty.xDelete = on_delete;
    faulty.xAccess = on_access;
    sqlite3_vfs_register(&faulty, 1);
}
