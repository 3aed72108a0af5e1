/* SPDX-License-Identifier: Apache-2.0 */
/* Files. Input files are opened only here: a path that is not a file is rejected, opening waits for nothing but the writer
   of a fifo that the user named, and each kind of file has a size limit. Output files are written whole or not at all. */
#ifndef KOKSMA_CORE_FILES_H
#define KOKSMA_CORE_FILES_H

#include <koksma/koksma.h>

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "core/visibility.h"

/* Whether a path ends in `ending`, as in ".npy", and has something before it. */
static inline bool koksma__path_ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), n = strlen(ending);
    return length > n && !strcmp(path + length - n, ending);
}

/* ---- Reading ---- */

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
KOKSMA__LAB koksma_status koksma__check_text(const unsigned char *bytes, size_t size);

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

/* Returns FOLDER/PATH, or a copy of the path if folder is NULL, to be freed; NULL without memory. */
KOKSMA__LAB char *koksma__path_below(const char *folder, const char *path);

/* ---- Writing ---- */

typedef struct koksma__atomic_file {
    FILE *stream;
    struct koksma__output *output; /* the file behind the stream */
} koksma__atomic_file;

/* Opens a file for writing. If folder is NULL, the user chose the path: "-" is standard output; streams, devices and
   pipes are written directly; a symbolic link remains, and its target is replaced. Otherwise path is a name below
   folder that the program chose: symbolic links below folder are not followed, and a link in the file's place is
   replaced. Errors: IO, MEMORY. */
KOKSMA__LAB koksma_status koksma__atomic_open(const char *folder, const char *path, koksma__atomic_file *file);

/* Returns the bytes that the disk of the open file has left; UINT64_MAX: unknown, or the target is not a plain file. */
KOKSMA__LAB uint64_t koksma__atomic_space(const koksma__atomic_file *file);

/* Closes the file. If keep is true, the file is synced and renamed to its final name; if keep is false, or a step
   fails, an older file of that name stays. Errors: IO; the message has the system's reason for the first write that
   failed. */
KOKSMA__LAB koksma_status koksma__atomic_close(koksma__atomic_file *file, bool keep);

/* Opens a file, writes the bytes and closes it. */
KOKSMA__LAB koksma_status koksma__atomic_put(const char *folder, const char *path, const void *bytes, size_t size);

/* Returns the path of the file that a path leads to through symbolic links, which need not exist; the caller frees it.
   NULL: the links have no end or lead below a file, or there is no memory; errno tells which. */
KOKSMA__LAB char *koksma__atomic_target(const char *path);

/* Makes a folder, unless it exists, and syncs its entry, so that it survives a loss of power. Error: IO. */
KOKSMA__LAB koksma_status koksma__atomic_folder(const char *path);

#endif
