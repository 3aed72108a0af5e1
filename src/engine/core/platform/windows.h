/* SPDX-License-Identifier: Apache-2.0 */
/* The functions of POSIX that the sources call and that Windows lacks, or has with paths in the ANSI code page and texts
   for binary files: here paths are UTF-8, may be longer than 260 characters, and every file is binary. The compiler reads
   this file first (cmake/flags.cmake), as names may be replaced only after the system's headers. posix/ has the
   headers that Windows lacks. Errors set errno. */
#ifndef KOKSMA_CORE_PLATFORM_WINDOWS_H
#define KOKSMA_CORE_PLATFORM_WINDOWS_H

#ifdef _WIN32

/* The sources have functions of these names, and none calls io.h's. */
#define read koksma__io_read
#define write koksma__io_write
#define tell koksma__io_tell
#define open koksma__io_open
#include <direct.h>
#include <io.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#include <wchar.h>
#undef read
#undef write
#undef tell
#undef open

#include "core/visibility.h"

/* Returns a path for Windows's own functions, to be freed; NULL and errno if it is no UTF-8, or there is no memory. */
KOKSMA__LAB wchar_t *koksma__wide_path(const char *path);

/* Sets errno after a function of Windows failed. Returns -1. */
KOKSMA__LAB int koksma__set_errno(void);

/* ---- Files ---- */

struct koksma__stat {
    uint64_t st_dev, st_ino;
    unsigned st_mode;
    int64_t st_size;
    struct timespec st_mtim, st_ctim;
};

KOKSMA__LAB int koksma__stat(const char *path, struct koksma__stat *info);
KOKSMA__LAB int koksma__lstat(const char *path, struct koksma__stat *info);
KOKSMA__LAB int koksma__fstat(int descriptor, struct koksma__stat *info);
KOKSMA__LAB int koksma__open(const char *path, int flags, ...);
KOKSMA__LAB FILE *koksma__fopen(const char *path, const char *mode);
KOKSMA__LAB int koksma__fclose(FILE *stream);
KOKSMA__LAB int koksma__access(const char *path, int mode);
KOKSMA__LAB int koksma__mkdir(const char *path, int mode);
KOKSMA__LAB int koksma__unlink(const char *path);
KOKSMA__LAB int koksma__rmdir(const char *path);
KOKSMA__LAB int koksma__rename(const char *from, const char *to);
KOKSMA__LAB char *koksma__realpath(const char *path, char *out);
KOKSMA__LAB char *koksma__getcwd(char *out, size_t size);
KOKSMA__LAB intptr_t koksma__readlink(const char *path, char *out, size_t size);
KOKSMA__LAB intptr_t koksma__pread(int descriptor, void *bytes, size_t size, int64_t offset);

#undef stat
#undef fstat
#undef lstat
#undef S_ISLNK
#define stat koksma__stat
#define fstat koksma__fstat
#define lstat koksma__lstat
#define S_ISLNK(mode) (((mode)&0xF000) == 0xA000)
#define fopen koksma__fopen
#define fclose koksma__fclose
#define access koksma__access
#define faccessat(at, path, mode, flags) koksma__access(path, mode)
#define mkdir koksma__mkdir
#define unlink koksma__unlink
#define rmdir koksma__rmdir
#define rename koksma__rename
#define fsync _commit
#define fchmod(descriptor, mode) ((void)0)
#define realpath koksma__realpath
#define getcwd koksma__getcwd
#define readlink koksma__readlink
#define pread koksma__pread
#define putc_unlocked _putc_nolock
#define fcntl(descriptor, command, ...) koksma__no_flags()

/* Of what fcntl sets elsewhere. */
static inline int koksma__no_flags(void)
{
    return 0;
}

#undef X_OK
#define X_OK 0
#undef PATH_MAX
#define PATH_MAX 4096

/* ---- The machine ---- */

enum { _SC_NPROCESSORS_ONLN, _SC_PHYS_PAGES, _SC_PAGESIZE };

KOKSMA__LAB long koksma__sysconf(int name);
KOKSMA__LAB int koksma__getentropy(void *bytes, size_t size);
KOKSMA__LAB struct tm *koksma__gmtime_r(const time_t *when, struct tm *out);

#define sysconf koksma__sysconf
#define getentropy koksma__getentropy
#define gmtime_r koksma__gmtime_r

/* ---- Streams and texts ---- */

/* The text is there after fclose, as here nothing else is asked of it. */
KOKSMA__LAB FILE *koksma__open_memstream(char **text, size_t *size);
KOKSMA__LAB char *koksma__strndup(const char *text, size_t size);

#define open_memstream koksma__open_memstream
#define fmemopen(bytes, size, mode) NULL /* it reads what a program printed, and none runs here */
#define strndup koksma__strndup

/* Of mingw's these are -1 for true, and the sources count with them. */
#undef isnan
#undef isfinite
#define isnan(x) (!!__builtin_isnan(x))
#define isfinite(x) (!!__builtin_isfinite(x))

/* ---- Libraries ---- */

enum { RTLD_NOW = 0, RTLD_LOCAL = 0, RTLD_GLOBAL = 0 };

KOKSMA__LAB void *koksma__dlopen(const char *path, int mode);
KOKSMA__LAB void *koksma__dlsym(void *library, const char *name);
KOKSMA__LAB int koksma__dlclose(void *library);
KOKSMA__LAB const char *koksma__dlerror(void);

#define dlopen koksma__dlopen
#define dlsym koksma__dlsym
#define dlclose koksma__dlclose
#define dlerror koksma__dlerror

/* The file that contains this code, in UTF-8, to be freed. */
KOKSMA__LAB char *koksma__this_file(void);

/* ---- glob(3) ---- */

typedef struct koksma__glob_t {
    size_t gl_pathc;
    char **gl_pathv;
} koksma__glob_t;

enum { GLOB_NOSORT = 1, GLOB_NOMATCH = 2, GLOB_NOSPACE = 3 };

KOKSMA__LAB int koksma__glob(const char *pattern, int flags, void *unused, koksma__glob_t *found);
KOKSMA__LAB void koksma__globfree(koksma__glob_t *found);

#define glob_t koksma__glob_t
#define glob koksma__glob
#define globfree koksma__globfree

#endif

#endif
