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

/* Opens the temporary file for writing; "-" is standard output. temporary may be handed to a library that wants
   a name; it then overwrites what the open made. */
KOKSMA__LAB koksma_status koksma__atomic_open(const char *path, koksma__atomic_file *file);

/* With keep: flushes, syncs and renames; without, or when that fails: removes the temporary. Releases all. */
KOKSMA__LAB koksma_status koksma__atomic_close(koksma__atomic_file *file, bool keep);

#endif
