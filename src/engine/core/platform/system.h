/* SPDX-License-Identifier: Apache-2.0 */
/* What differs between systems beside files (core/files.h) and processes (processes.h). The sources call POSIX; posix/ has
   those of its functions that Windows or macOS lack, under the names of POSIX's own headers. */
#ifndef KOKSMA_CORE_PLATFORM_SYSTEM_H
#define KOKSMA_CORE_PLATFORM_SYSTEM_H

#include <locale.h>
#include <stdbool.h>
#include <stddef.h>

#include "core/visibility.h"

#ifdef __APPLE__
#include <xlocale.h>
#endif

/* The locale of this thread, to restore. */
typedef struct koksma__locale {
#ifdef _WIN32
    int per_thread; /* of _configthreadlocale; 0: nothing was changed */
    char name[128];
#else
    locale_t before;
#endif
} koksma__locale;

/* Between these two calls the C library converts numbers as the locale "C" does. */
koksma__locale koksma__locale_enter(void);
void koksma__locale_leave(koksma__locale locale);

/* Returns the number of processors that the system has switched on; 1 if it does not tell. */
int koksma__processors(void);

/* Returns uninitialised memory at a multiple of 64 bytes, so that no vector crosses a cache line; NULL if there is none.
   koksma__aligned_free releases it, not free. */
KOKSMA__LAB void *koksma__aligned(size_t bytes);
KOKSMA__LAB void koksma__aligned_free(void *memory);

/* Asks the system for large pages in a new block of many megabytes; for smaller blocks it does nothing. This pays
   because the first access to each page of a new block takes longer than filling the page several times. The system
   may ignore the request. */
void koksma__large_pages(void *memory, size_t bytes);

/* Returns the last character of a path that ends a folder's name; NULL if there is none. Windows has two such characters,
   and a drive's colon. */
KOKSMA__LAB const char *koksma__last_slash(const char *path);

/* Whether a path begins at a root, so that it means the same from every folder. */
KOKSMA__LAB bool koksma__path_is_absolute(const char *path);

#endif
