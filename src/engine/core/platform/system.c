/* SPDX-License-Identifier: Apache-2.0 */
/* Processors, memory, locale and the form of paths, for each system. */
#ifdef __linux__
#define _DEFAULT_SOURCE /* madvise */
#endif
#include "core/platform/system.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <malloc.h>
#include <windows.h>
#else
#include <pthread.h>
#include <unistd.h>
#endif
#ifdef __linux__
#include <sys/mman.h>
#endif

enum { LINE = 64 };

#ifdef _WIN32

/* The thread gets a locale of its own only where its decimal point isn't that of "C", as the calls take long. */
koksma__locale koksma__locale_enter(void)
{
    koksma__locale locale = {0};
    if (strcmp(localeconv()->decimal_point, ".") != 0) {
        locale.per_thread = _configthreadlocale(_ENABLE_PER_THREAD_LOCALE);
        const char *name = setlocale(LC_NUMERIC, NULL);
        strncpy(locale.name, name ? name : "C", sizeof locale.name - 1);
        setlocale(LC_NUMERIC, "C");
    }
    return locale;
}

void koksma__locale_leave(koksma__locale locale)
{
    if (locale.per_thread) {
        setlocale(LC_NUMERIC, locale.name);
        _configthreadlocale(locale.per_thread);
    }
}

int koksma__processors(void)
{
    return (int)GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
}

void *koksma__aligned(size_t bytes)
{
    return _aligned_malloc(bytes, LINE);
}

void koksma__aligned_free(void *memory)
{
    _aligned_free(memory);
}

const char *koksma__last_slash(const char *path)
{
    const char *last = NULL;
    for (const char *s = path; *s; s++) {
        last = *s == '/' || *s == '\\' || (*s == ':' && s == path + 1) ? s : last;
    }
    return last;
}

bool koksma__path_is_absolute(const char *path)
{
    return *path == '/' || *path == '\\' || (*path && path[1] == ':');
}

#else

static locale_t c_locale;

/* This locale is never freed. glibc and musl create it without allocating memory. If another libc cannot create it,
   uselocale(0) below does not change the caller's locale. */
static void make_c_locale(void)
{
    c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

koksma__locale koksma__locale_enter(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, make_c_locale);
    return (koksma__locale){uselocale(c_locale)};
}

void koksma__locale_leave(koksma__locale locale)
{
    uselocale(locale.before);
}

int koksma__processors(void)
{
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : online < 1 << 20 ? (int)online : 1 << 20;
}

/* C11 wants a multiple of the alignment. */
void *koksma__aligned(size_t bytes)
{
    return bytes > SIZE_MAX - LINE ? NULL : aligned_alloc(LINE, (bytes + LINE - 1) / LINE * LINE);
}

void koksma__aligned_free(void *memory)
{
    free(memory);
}

const char *koksma__last_slash(const char *path)
{
    return strrchr(path, '/');
}

bool koksma__path_is_absolute(const char *path)
{
    return *path == '/';
}

#endif

void koksma__large_pages(void *memory, size_t bytes)
{
    enum {
        MANY = 1 << 22
    }; /* twice the size of a large page: such a block contains at least one complete large page */
#ifdef MADV_HUGEPAGE
    const long page = sysconf(_SC_PAGESIZE);
    if (memory && bytes >= MANY && page > 0) {
        const uintptr_t first = ((uintptr_t)memory + (uintptr_t)page - 1) & ~((uintptr_t)page - 1);
        const uintptr_t end = ((uintptr_t)memory + bytes) & ~((uintptr_t)page - 1);
        madvise((void *)first, end - first, MADV_HUGEPAGE);
    }
#else
    (void)memory, (void)bytes, (void)MANY;
#endif
}
