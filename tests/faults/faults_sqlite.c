/* SPDX-License-Identifier: Apache-2.0 */
/* SQLite with faults: its usual files and memory, with a question asked before each call. The files offer no shared
   memory, which a store in exclusive mode does without (https://sqlite.org/wal.html, section 8). What changes a file or
   folder goes into KOKSMA_FAULT_LOG. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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
    unsigned long long inode, folder; /* for the log; folder 0: its entry is synced */
} file;

static sqlite3_vfs faulty, *usual;

static sqlite3_file *below(sqlite3_file *f)
{
    return ((file *)f)->usual;
}

static unsigned long long inode_of(const char *path)
{
    struct stat info;
    return stat(path, &info) ? 0 : (unsigned long long)info.st_ino;
}

static unsigned long long folder_of(const char *path)
{
    char *copy = strdup(path), *slash = strrchr(copy, '/');
    slash[slash == copy] = '\0'; /* SQLite's paths are absolute */
    const unsigned long long inode = inode_of(copy);
    free(copy);
    return inode;
}

static int on_close(sqlite3_file *f)
{
    return below(f)->pMethods->xClose(below(f));
}

static int on_read(sqlite3_file *f, void *bytes, int size, sqlite3_int64 at)
{
    return fault_here(FAULT_DB, NULL) ? SQLITE_IOERR_READ : below(f)->pMethods->xRead(below(f), bytes, size, at);
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
    fault_note_write(((file *)f)->inode, at, bytes, (size_t)size);
    return below(f)->pMethods->xWrite(below(f), bytes, size, at);
}

static int on_truncate(sqlite3_file *f, sqlite3_int64 size)
{
    if (fault_here(FAULT_DB, NULL)) {
        return SQLITE_IOERR_TRUNCATE;
    }
    fault_note("truncate %llu %lld\n", ((file *)f)->inode, (long long)size);
    return below(f)->pMethods->xTruncate(below(f), size);
}

/* With its first sync of a log or journal SQLite syncs the folder, too (unixSync, UNIXFILE_DIRSYNC). */
static int on_sync(sqlite3_file *f, int flags)
{
    file *synced = (file *)f;
    if (fault_here(FAULT_DB, NULL)) {
        return SQLITE_IOERR_FSYNC;
    }
    const int code = below(f)->pMethods->xSync(below(f), flags);
    fault_note("sync %llu\n", synced->inode);
    if (synced->folder) {
        fault_note("sync %llu\n", synced->folder);
        synced->folder = 0;
    }
    return code;
}

static int on_size(sqlite3_file *f, sqlite3_int64 *size)
{
    return fault_here(FAULT_DB, NULL) ? SQLITE_IOERR_FSTAT : below(f)->pMethods->xFileSize(below(f), size);
}

static int on_lock(sqlite3_file *f, int level)
{
    return fault_here(FAULT_DB, NULL) ? SQLITE_IOERR_LOCK : below(f)->pMethods->xLock(below(f), level);
}

static int on_unlock(sqlite3_file *f, int level)
{
    return below(f)->pMethods->xUnlock(below(f), level);
}

static int on_check_lock(sqlite3_file *f, int *locked)
{
    return fault_here(FAULT_DB, NULL) ? SQLITE_IOERR_CHECKRESERVEDLOCK
                                      : below(f)->pMethods->xCheckReservedLock(below(f), locked);
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
    const unsigned long long before = path && fault_logs() ? inode_of(path) : 0;
    const int code = usual->xOpen(usual, path, opened->usual, flags, got);
    if (path && fault_logs() && code == SQLITE_OK) {
        const bool is_log = flags & (SQLITE_OPEN_WAL | SQLITE_OPEN_MAIN_JOURNAL | SQLITE_OPEN_SUPER_JOURNAL);
        opened->inode = inode_of(path);
        opened->folder = is_log && flags & SQLITE_OPEN_CREATE ? folder_of(path) : 0;
        if (!before) {
            fault_note("create %llu %llu %s\n", folder_of(path), opened->inode, strrchr(path, '/') + 1);
        }
    }
    opened->base.pMethods = opened->usual->pMethods ? &methods : NULL;
    return code;
}

static int on_delete(sqlite3_vfs *vfs, const char *path, int sync)
{
    (void)vfs;
    if (fault_here(FAULT_DB, NULL)) {
        return SQLITE_IOERR_DELETE;
    }
    if (fault_logs() && inode_of(path)) {
        fault_note("unlink %llu %s\n", folder_of(path), strrchr(path, '/') + 1);
    }
    const int code = usual->xDelete(usual, path, sync);
    if (fault_logs() && sync) {
        fault_note("sync %llu\n", folder_of(path));
    }
    return code;
}

int __real_sqlite3_open_v2(const char *path, sqlite3 **database, int flags, const char *vfs);
int __wrap_sqlite3_open_v2(const char *path, sqlite3 **database, int flags, const char *vfs);

/* With a log, short runs have many checkpoints. */
int __wrap_sqlite3_open_v2(const char *path, sqlite3 **database, int flags, const char *vfs)
{
    enum { PAGES = 6 };
    const int code = __real_sqlite3_open_v2(path, database, flags, vfs);
    if (code == SQLITE_OK && fault_logs()) {
        sqlite3_wal_autocheckpoint(*database, PAGES);
    }
    return code;
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
