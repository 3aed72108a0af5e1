/* SPDX-License-Identifier: Apache-2.0 */
/* The one way to open files from outside: what is no file is refused, nothing waits, and each kind has a limit. */
#ifndef KOKSMA_CORE_READ_FILE_H
#define KOKSMA_CORE_READ_FILE_H

#include <stdbool.h>
#include <stdio.h>

#include <koksma/koksma.h>

#include "core/visibility.h"

typedef enum koksma__file_kind {
#define FILE_KIND(name, mib, text) KOKSMA__FILE_##name,
#include "core/file_kinds.def"
#undef FILE_KIND
} koksma__file_kind;

/* Who named the file. The user may name a pipe, a terminal or "-", standard input; a file, such as a scene, only plain
   files. Devices are refused from both. */
typedef enum koksma__named { KOKSMA__BY_USER, KOKSMA__BY_FILE } koksma__named;

/* Opens a file for reading; koksma__file_close ends it. Never waits, but for the other end of a fifo that the user
   named. Errors: MISSING (absent, unreadable, no plain file), MALFORMED (too long), SYSTEM (no descriptor or memory
   is left). */
koksma_status koksma__file_open(const char *path, koksma__file_kind kind, koksma__named by, FILE **stream);
void koksma__file_close(FILE *stream);

/* The limit of a kind in bytes, and the error of a file that has more: MALFORMED. */
uint64_t koksma__file_most(koksma__file_kind kind);
koksma_status koksma__file_too_long(const char *name, koksma__file_kind kind);

enum { KOKSMA__FILE_START = 512 };

/* Looks at the first KOKSMA__FILE_START bytes of a file, or all of a shorter one, before more is read. An error's text
   names no file. */
typedef koksma_status koksma__check_start(const unsigned char *bytes, size_t size);

/* MALFORMED where a zero byte is: of UTF-16, or of no text. */
KOKSMA__LAB koksma__check_start koksma__check_text;

/* A whole file in memory, with a 0 behind its end; the caller frees *bytes. check may be NULL.
   Errors: those of koksma__file_open and check, MEMORY. */
KOKSMA__LAB koksma_status koksma__read_file(const char *path, koksma__file_kind kind, koksma__named by,
                                            koksma__check_start *check, unsigned char **bytes, size_t *size);

/* The hash of a file of points that a pattern names, in a fixed amount of memory. Errors: those of koksma__file_open. */
KOKSMA__LAB koksma_status koksma__hash_file(const char *path, uint64_t *hash);

enum { KOKSMA__MAX_PATH = 4096 };

/* A path that the file `name` mentions, which starts at that file's folder; false when it is too long. */
KOKSMA__LAB bool koksma__path_beside(const char *name, const char *path, char out[KOKSMA__MAX_PATH]);

#endif
