/* SPDX-License-Identifier: Apache-2.0 */
/* Output files that are written whole or not at all. */
#ifndef KOKSMA_CORE_ATOMIC_FILE_H
#define KOKSMA_CORE_ATOMIC_FILE_H

#include <stdio.h>

#include <koksma/koksma.h>

#include "core/visibility.h"

typedef struct koksma__atomic_file {
    FILE *stream;
    struct koksma__output *output; /* the file behind the stream */
} koksma__atomic_file;

/* Opens a file for writing. If folder is NULL, the user chose the path: "-" is standard output; streams, devices and
   pipes are written directly; a symbolic link remains, and its target is replaced. Otherwise path is a name below
   folder that the program chose: symbolic links below folder are not followed, and a link in the file's place is
   replaced. Errors: IO, MEMORY. */
KOKSMA__LAB koksma_status koksma__atomic_open(const char *folder, const char *path, koksma__atomic_file *file);

enum { KOKSMA__TEMPORARY_PATH = 64 };

/* Returns the path of the temporary file while it is open, for a library that opens files by name. Works only for
   plain files. */
KOKSMA__LAB void koksma__atomic_temporary(const koksma__atomic_file *file, char path[KOKSMA__TEMPORARY_PATH]);

/* Closes the file. If keep is true, the file is synced and renamed to its final name; if keep is false, or a step
   fails, an older file of that name stays. Errors: IO; the message has the system's reason for the first write that
   failed. */
KOKSMA__LAB koksma_status koksma__atomic_close(koksma__atomic_file *file, bool keep);

/* Opens a file, writes the bytes and closes it. */
KOKSMA__LAB koksma_status koksma__atomic_put(const char *folder, const char *path, const void *bytes, size_t size);

/* The same, but a file that exists stays, also if another process makes it at this moment; *made tells which. */
KOKSMA__LAB koksma_status koksma__atomic_put_new(const char *folder, const char *path, const void *bytes, size_t size,
                                                 bool *made);

/* Returns the path of the file that a path leads to through symbolic links, which need not exist; the caller frees it.
   NULL: the links have no end or lead below a file, or there is no memory; errno tells which. */
KOKSMA__LAB char *koksma__atomic_target(const char *path);

/* Makes a folder, unless it exists, and syncs its entry, so that it survives a loss of power. Error: IO. */
KOKSMA__LAB koksma_status koksma__atomic_folder(const char *path);

#endif
