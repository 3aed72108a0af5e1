/* SPDX-License-Identifier: Apache-2.0 */
/* The only way to open input files: a path that is not a file is rejected, opening waits for nothing but the writer of
   a fifo that the user named, and each kind of file has a size limit. */
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

/* Who named the file. The user may name a pipe, a terminal or "-" for standard input; another file, such as a scene,
   may name only plain files. Devices are rejected in both cases. */
typedef enum koksma__named { KOKSMA__BY_USER, KOKSMA__BY_FILE } koksma__named;

/* Opens a file for reading; koksma__file_close closes it. It waits only for the writer of a fifo that the user named.
   Errors: MISSING (the file is absent, unreadable or not plain), MALFORMED (it is too long), SYSTEM (no descriptor or
   memory is left). */
koksma_status koksma__file_open(const char *path, koksma__file_kind kind, koksma__named by, FILE **stream);
void koksma__file_close(FILE *stream);

/* Return the size limit of a kind of file in bytes, and the error for a file above the limit: MALFORMED. */
KOKSMA__LAB uint64_t koksma__file_most(koksma__file_kind kind);
koksma_status koksma__file_too_long(const char *name, koksma__file_kind kind);

enum { KOKSMA__FILE_START = 512 };

/* Checks the first KOKSMA__FILE_START bytes of a file, or all of a shorter file, before the rest is read. The error
   text need not name the file. */
typedef koksma_status koksma__check_start(const unsigned char *bytes, size_t size);

/* Fails with MALFORMED if the bytes contain a zero, because the file is then UTF-16 or not a text. */
KOKSMA__LAB koksma__check_start koksma__check_text;

/* Reads a whole file into memory and appends a zero byte; the caller frees *bytes. check may be NULL. Errors: those
   of koksma__file_open and check, MEMORY. */
KOKSMA__LAB koksma_status koksma__read_file(const char *path, koksma__file_kind kind, koksma__named by,
                                            koksma__check_start *check, unsigned char **bytes, size_t *size);

/* Computes the hash of a file of points that a pattern names, in a fixed amount of memory. Errors: those of
   koksma__file_open. */
KOKSMA__LAB koksma_status koksma__hash_file(const char *path, uint64_t *hash);

enum { KOKSMA__MAX_PATH = 4096 };

/* Makes the path of a file that the file `name` mentions, relative to that file's folder. Returns false if the path
   is too long. */
KOKSMA__LAB bool koksma__path_beside(const char *name, const char *path, char out[KOKSMA__MAX_PATH]);

#endif
