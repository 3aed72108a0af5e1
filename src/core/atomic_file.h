/* SPDX-License-Identifier: Apache-2.0 */
/* Output files that are written whole or not at all: a temporary name beside the target, then a rename. */
#ifndef KOKSMA_CORE_ATOMIC_FILE_H
#define KOKSMA_CORE_ATOMIC_FILE_H

#include <stdio.h>

#include <koksma/koksma.h>

#include "core/visibility.h"

typedef struct koksma__atomic_file {
    FILE *stream;
    char *path, *temporary; /* NULL for standard output */
} koksma__atomic_file;

/* Opens a temporary file beside path for writing; "-" is standard output. A library that wants a file name may be given
   `temporary`; it then overwrites the empty file. */
KOKSMA__LAB koksma_status koksma__atomic_open(const char *path, koksma__atomic_file *file);

/* Closes the file. If keep is true it is flushed, synced and renamed to its path; if keep is false, or one of these
   steps fails, the temporary file is removed. Frees the struct's memory in either case. */
KOKSMA__LAB koksma_status koksma__atomic_close(koksma__atomic_file *file, bool keep);

#endif
