/* SPDX-License-Identifier: Apache-2.0 */
/* Point sets of patterns that read files, kept for the process. */
#ifndef KOKSMA_PATTERNS_SHARED_FILE_SETS_H
#define KOKSMA_PATTERNS_SHARED_FILE_SETS_H

#include <stdbool.h>

#include <koksma/koksma.h>

#include "core/visibility.h"

/* While `trust` is true, calls of this thread take a kept set without asking whether its file has changed. Returns the
   previous value, false at first. */
KOKSMA__LAB bool koksma__trust_files(bool trust);

/* Generates the points of a pattern whose operand is the path of a file, before modifiers: from memory if this process
   has read the same set from the same file, else by pattern->generate. Several threads may call it at once. Errors:
   those of pattern->generate. */
koksma_status koksma__file_points(const koksma_pattern *pattern, uint64_t seed, const koksma_args *args,
                                  koksma_points *out);

#endif
