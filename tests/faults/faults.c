/* SPDX-License-Identifier: Apache-2.0 */
/* The program with a fault: linked in by --wrap, so that what the program and the two libraries call comes here, and
   what outside libraries and libc call does not. Long because all calls share the counts. */
#include "faults.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <jansson.h>
#include <sqlite3.h>

static const char *const names[N_FAULTS] = {
    "none", "memory", "open", "read", "write", "sync", "close", "rename", "thread", "db",
};

enum { MODE_ONCE, MODE_ON, MODE_END, ENDED = 99 };

static fault_kind wanted;
static long wanted_at;
static int mode;
static bool listening; /* KOKSMA_FAULT is set */
static atomic_long counts[N_FAULTS];

_Noreturn void fault_end(void)
{
    _exit(ENDED);
}

bool fault_here(fault_kind kind, bool *half)
{
    const long at = atomic_fetch_add(&counts[kind], 1) + 1;
    if (kind != wanted || at < wanted_at || (mode != MODE_ON && at > wanted_at)) {
        return false;
    }
    if (mode == MODE_END && !half) {
        fault_end();
    }
    if (half) {
        *half = mode == MODE_END;
    }
    return true;
}

/* ---- Calls that only fail ------------------------------------------------------------------------------ */

/* A call: it fails with `code` in errno and returns `failed`, or is the usual one. */
#define WRAP(type, name, parameters, arguments, kind, code, failed)                                                  \
    type __real_##name parameters;                                                                                   \
    type __wrap_##name parameters;                                                                                   \
    type __wrap_##name parameters                                                                                    \
    {                                                                                                                \
        const bool fails = fault_here(kind, NULL);                                                                   \
        errno = fails ? (code) : errno;                                                                              \
        return fails ? (failed) : __real_##name arguments;                                                           \
    }
WRAP(void *, malloc, (size_t size), (size), FAULT_MEMORY, ENOMEM, NULL)
WRAP(void *, calloc, (size_t n, size_t size), (n, size), FAULT_MEMORY, ENOMEM, NULL)
WRAP(void *, realloc, (void *old, size_t size), (old, size), FAULT_MEMORY, ENOMEM, NULL)
WRAP(void *, aligned_alloc, (size_t alignment, size_t size), (alignment, size), FAULT_MEMORY, ENOMEM, NULL)
WRAP(char *, strdup, (const char *text), (text), FAULT_MEMORY, ENOMEM, NULL)
/* The bits of a new file are in their register whether the caller gave them or not. */
WRAP(int, open, (const char *path, int flags, mode_t bits), (path, flags, bits), FAULT_OPEN, EMFILE, -1)
WRAP(int, memfd_create, (const char *name, unsigned flags), (name, flags), FAULT_OPEN, EMFILE, -1)
WRAP(int, mkdir, (const char *path, mode_t bits), (path, bits), FAULT_OPEN, ENOSPC, -1)
WRAP(int, fsync, (int descriptor), (descriptor), FAULT_SYNC, EIO, -1)
WRAP(int, rename, (const char *from, const char *to), (from, to), FAULT_RENAME, EACCES, -1)
WRAP(int, pthread_create, (pthread_t * thread, const pthread_attr_t *attributes, void *(*f)(void *), void *argument),
     (thread, attributes, f, argument), FAULT_THREAD, EAGAIN, EAGAIN)
WRAP(int, sqlite3_open_v2, (const char *path, sqlite3 **database, int flags, const char *vfs),
     (path, database, flags, vfs), FAULT_DB, EIO, SQLITE_CANTOPEN)
WRAP(int, sqlite3_prepare_v3,
     (sqlite3 * database, const char *sql, int size, unsigned flags, sqlite3_stmt **statement, const char **tail),
     (database, sql, size, flags, statement, tail), FAULT_DB, ENOMEM, SQLITE_NOMEM)
WRAP(int, sqlite3_exec,
     (sqlite3 * database, const char *sql, int (*f)(void *, int, char **, char **), void *context, char **reason),
     (database, sql, f, context, reason), FAULT_DB, EIO, SQLITE_IOERR)
WRAP(int, sqlite3_step, (sqlite3_stmt * statement), (statement), FAULT_DB, ENOSPC, SQLITE_FULL)
#undef WRAP

/* jansson 2.14 writes past its buffer where it doesn't get the memory for a longer string. That buffer grows by
   powers of two from 32 on; requests of those sizes, its tables' among them, are not made to fail. */
static void *json_memory(size_t size)
{
    return size >= 32 && !(size & (size - 1)) ? __real_malloc(size) : __wrap_malloc(size);
}

/* ---- Files --------------------------------------------------------------------------------------------- */

/* A stream whose reads and writes come by here; the stream below it has no buffer of its own. */
enum { MAX_FILES = 64, BUFFER = 1024 };
static struct {
    _Atomic(FILE *) above;
    char buffer[BUFFER]; /* small, so that there are several writes in a short file */
} files[MAX_FILES];

FILE *__real_fopen(const char *path, const char *how);
FILE *__real_fdopen(int descriptor, const char *how);
int __real_fclose(FILE *stream);
FILE *__real_fopencookie(void *cookie, const char *how, cookie_io_functions_t functions);
ssize_t __real_write(int descriptor, const void *bytes, size_t size);
int __real_close(int descriptor);
FILE *__wrap_fopen(const char *path, const char *how);
FILE *__wrap_fdopen(int descriptor, const char *how);
int __wrap_fclose(FILE *stream);
FILE *__wrap_fopencookie(void *cookie, const char *how, cookie_io_functions_t functions);
ssize_t __wrap_write(int descriptor, const void *bytes, size_t size);
int __wrap_close(int descriptor);

static ssize_t read_below(void *cookie, char *bytes, size_t size)
{
    if (fault_here(FAULT_READ, NULL)) {
        errno = EIO;
        return -1;
    }
    const size_t got = fread(bytes, 1, size, cookie);
    return got == 0 && ferror((FILE *)cookie) ? -1 : (ssize_t)got;
}

static ssize_t write_below(void *cookie, const char *bytes, size_t size)
{
    bool half = false;
    if (fault_here(FAULT_WRITE, &half)) {
        if (half) {
            fwrite(bytes, 1, size / 2, cookie);
            fflush(cookie);
            fault_end();
        }
        errno = ENOSPC;
        return 0; /* what glibc asks for */
    }
    return (ssize_t)fwrite(bytes, 1, size, cookie);
}

static int seek_below(void *cookie, off64_t *offset, int from)
{
    if (fseeko(cookie, *offset, from)) {
        return -1;
    }
    *offset = ftello(cookie);
    return 0;
}

static int close_below(void *cookie)
{
    return __real_fclose(cookie);
}

static FILE *in_pieces(FILE *stream)
{
    for (int i = 0; stream && i < MAX_FILES; i++) {
        FILE *nobody = NULL;
        if (atomic_compare_exchange_strong(&files[i].above, &nobody, stream)) {
            setvbuf(stream, files[i].buffer, _IOFBF, BUFFER);
            return stream;
        }
    }
    abort();
}

static FILE *above(FILE *below, const char *how)
{
    const cookie_io_functions_t functions = {read_below, write_below, seek_below, close_below};
    if (!below) {
        return NULL;
    }
    setvbuf(below, NULL, _IONBF, 0);
    return in_pieces(__real_fopencookie(below, how, functions));
}

FILE *__wrap_fopen(const char *path, const char *how)
{
    if (fault_here(FAULT_OPEN, NULL)) {
        errno = EMFILE;
        return NULL;
    }
    FILE *stream = __real_fopen(path, how);
    return listening ? above(stream, how) : stream;
}

FILE *__wrap_fdopen(int descriptor, const char *how)
{
    if (fault_here(FAULT_OPEN, NULL)) {
        errno = ENOMEM;
        return NULL;
    }
    FILE *stream = __real_fdopen(descriptor, how);
    return listening ? above(stream, how) : stream;
}

int __wrap_fclose(FILE *stream)
{
    int i = 0;
    while (i < MAX_FILES && atomic_load(&files[i].above) != stream) {
        i++;
    }
    const int code = __real_fclose(stream);
    if (i < MAX_FILES) {
        atomic_store(&files[i].above, NULL); /* only now: closing writes the buffer */
    }
    if (fault_here(FAULT_CLOSE, NULL)) {
        errno = EIO;
        return EOF;
    }
    return code;
}

FILE *__wrap_fopencookie(void *cookie, const char *how, cookie_io_functions_t functions)
{
    if (fault_here(FAULT_OPEN, NULL)) {
        errno = ENOMEM;
        return NULL;
    }
    FILE *stream = __real_fopencookie(cookie, how, functions);
    return listening ? in_pieces(stream) : stream;
}

ssize_t __wrap_write(int descriptor, const void *bytes, size_t size)
{
    bool half = false;
    if (fault_here(FAULT_WRITE, &half)) {
        if (half) {
            __real_write(descriptor, bytes, size / 2);
            fault_end();
        }
        errno = ENOSPC;
        return -1;
    }
    return __real_write(descriptor, bytes, size);
}

int __wrap_close(int descriptor)
{
    const int code = __real_close(descriptor);
    if (fault_here(FAULT_CLOSE, NULL)) {
        errno = EIO;
        return -1;
    }
    return code;
}

/* ---- Before main, and at the end ----------------------------------------------------------------------- */

static void tell_counts(void)
{
    FILE *stream = __real_fopen(getenv("KOKSMA_FAULT_COUNT"), "w");
    if (stream) {
        for (int i = 1; i < N_FAULTS; i++) {
            fprintf(stream, "%s %ld\n", names[i], atomic_load(&counts[i]));
        }
        __real_fclose(stream);
    }
}

__attribute__((constructor)) static void begin(void)
{
    const char *kind = getenv("KOKSMA_FAULT"), *at = getenv("KOKSMA_FAULT_AT"), *how = getenv("KOKSMA_FAULT_MODE");
    if (!kind) {
        return;
    }
    json_set_alloc_funcs(json_memory, free);
    stdout = above(stdout, "w");
    memset(counts, 0, sizeof counts);
    listening = true;
    int i = 0;
    while (i < N_FAULTS && strcmp(kind, names[i]) != 0) {
        i++;
    }
    if (i == N_FAULTS) {
        abort();
    }
    mode = how && !strcmp(how, "on") ? MODE_ON : how && !strcmp(how, "end") ? MODE_END : MODE_ONCE;
    wanted_at = at ? strtol(at, NULL, 10) : 1;
    wanted = (fault_kind)i;
    if (getenv("KOKSMA_FAULT_COUNT")) {
        atexit(tell_counts);
    }
}
