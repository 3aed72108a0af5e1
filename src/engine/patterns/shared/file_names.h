/* SPDX-License-Identifier: Apache-2.0 */
/* Paths with the placeholders {n} and {seed}, such as my_{n}_{seed}.npy: they name a family of sets of points, one file
   for each set. */
#ifndef KOKSMA_PATTERNS_SHARED_FILE_NAMES_H
#define KOKSMA_PATTERNS_SHARED_FILE_NAMES_H

#include <string.h>

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Returns whether the operand of a pattern, which may be NULL, is a path to a file, a program or a library. An operand that
   is a list of numbers has a name with colons, "Z1:Z2:..". */
static inline bool koksma__names_path(const koksma_pattern *pattern)
{
    return pattern && pattern->operand && !strchr(pattern->operand, ':');
}

/* Returns whether the operand of a pattern whose operand is a path is that of a library, which may have the name of one of
   its samplers behind it: "LIBRARY.so:NAME". */
static inline bool koksma__names_library(const koksma_pattern *pattern)
{
    return pattern->runs_code && strstr(pattern->operand, ".so");
}

/* Returns the ':' before the name of a sampler in "LIBRARY.so:NAME", or NULL if there is none. A ':' in the name of a
   folder is part of the path. */
KOKSMA__LAB const char *koksma__library_end(const char *operand);

/* Returns whether a pattern reads its points from a file instead of generating them. */
static inline bool koksma__reads_points(const koksma_pattern *pattern)
{
    return pattern->operand && pattern->whole;
}

/* Returns whether a path contains the placeholder `place`, "{n}" or "{seed}". */
KOKSMA__LAB bool koksma__file_has(const char *path, const char *place);

/* Returns whether a path has a placeholder, so that it names a family of files. */
static inline bool koksma__file_is_family(const char *path)
{
    return koksma__file_has(path, "{n}") || koksma__file_has(path, "{seed}");
}

/* Makes the path of the set of n points with this seed. Errors: ARGUMENT (the path is too long). */
KOKSMA__LAB koksma_status koksma__file_name(const char *path, size_t n, uint64_t seed, char out[KOKSMA_MAX_SPEC]);

/* The numbers in the name of an existing file. n or seed is 0 if the path has no {n} or {seed}. */
typedef struct koksma__file_set {
    size_t n;
    uint64_t seed;
} koksma__file_set;

/* Allocates the list of the files that match a path with placeholders, sorted by n and seed. The list has at least one
   file: a study that went on without any would have fewer jobs than its plan says. Errors: MISSING (no file matches),
   ARGUMENT (two placeholders are adjacent, so that their digits cannot be separated, or more than two parts of the path
   have any), MEMORY. */
KOKSMA__LAB koksma_status koksma__file_sets(const char *path, koksma__file_set **sets, size_t *count);

/* Fails with a status and the text that a family of files has no set of n points. */
KOKSMA__LAB koksma_status koksma__file_fail_n(const char *path, size_t n, koksma_status status);

/* Fails with N in place of MISSING if a spec is a family of files that has sets of other numbers of points, but none of n.
   Such a family lacks one set; one without any file is a mistake in its name, and the text says what was looked for.
   Other statuses of a trial to make n points are returned unchanged. Errors: the status, MEMORY. */
KOKSMA__LAB koksma_status koksma__file_gap(const koksma_spec *spec, size_t n, koksma_status status);

/* Returns the smallest seed for which a spec has a set of n points: for a family of files the smallest seed in their
 names, else 0.
 */
KOKSMA__LAB uint64_t koksma__first_seed(const koksma_spec *spec, size_t n);

#endif
