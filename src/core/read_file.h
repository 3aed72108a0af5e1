/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_READ_FILE_H
#define KOKSMA_CORE_READ_FILE_H

#include <stdbool.h>

#include <koksma/koksma.h>

#include "core/visibility.h"

/* A whole file in memory, with a 0 behind its end; the caller frees *bytes. "-" is standard input.
   Errors: MISSING (absent, unreadable, a directory), MALFORMED (more than max bytes), MEMORY. */
KOKSMA__LAB koksma_status koksma__read_file(const char *path, size_t max, unsigned char **bytes, size_t *size);

enum { KOKSMA__MAX_PATH = 4096 };

/* A path that the file `name` mentions, which starts at that file's folder; false when it is too long. */
KOKSMA__LAB bool koksma__path_beside(const char *name, const char *path, char out[KOKSMA__MAX_PATH]);

#endif
