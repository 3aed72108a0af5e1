/* SPDX-License-Identifier: Apache-2.0 */
/* Paths of files of points with {n} and {seed} in them, as my_{n}_{seed}.npy: a family of sets, one file each. */
#ifndef KOKSMA_PATTERNS_SHARED_FILE_NAMES_H
#define KOKSMA_PATTERNS_SHARED_FILE_NAMES_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Whether a pattern's points are those of a file, and not made from its parameters. */
static inline bool koksma__reads_points(const koksma_pattern *pattern)
{
    return pattern->operand && pattern->whole;
}

/* Whether a path has the place, "{n}" or "{seed}". */
KOKSMA__LAB bool koksma__file_has(const char *path, const char *place);

/* The path of the set of n points with this seed. Errors: ARGUMENT (longer than a path may be). */
KOKSMA__LAB koksma_status koksma__file_name(const char *path, size_t n, uint64_t seed, char out[KOKSMA_MAX_SPEC]);

/* A file that is there. n is 0 without {n}, seed without {seed}. */
typedef struct koksma__file_set {
    size_t n;
    uint64_t seed;
} koksma__file_set;

/* Allocates the list of the files that match a path with places, sorted by n and seed; *count may be 0. Errors:
   ARGUMENT (two places touch, so that their digits cannot be told apart), MEMORY. */
KOKSMA__LAB koksma_status koksma__file_sets(const char *path, koksma__file_set **sets, size_t *count);

/* The smallest seed for which a spec has a set of n points: of a family of files that of a file, else 0. */
KOKSMA__LAB uint64_t koksma__first_seed(const koksma_spec *spec, size_t n);

/* The path that finds these files by glob(3), for errors that name what was looked for. */
KOKSMA__LAB void koksma__file_glob(const char *path, bool escape, char *out, size_t size);

#endif
