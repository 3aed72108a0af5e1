/* SPDX-License-Identifier: Apache-2.0 */
/* Points and numbers from files. Each section is the interface of the file of its name. */
#ifndef KOKSMA_PATTERNS_FILES_FILES_H
#define KOKSMA_PATTERNS_FILES_FILES_H

#include <koksma/koksma.h>

#include <stdbool.h>
#include <string.h>

#include "core/visibility.h"

/* ---- Number lines ---------------------------------------------------------------------------------------- */

/* Reads files of published parameters, generating vectors and matrices: lines of whole numbers, one for each dimension.
 */

typedef struct koksma__number_lines {
    char name[KOKSMA_MAX_SPEC + 16]; /* "pattern:PATH", for error messages */
    /* The kind of the file's contents, by the first rule that applies. If its comments have a heading of LatNet
       Builder: "lattice", "plattice", "dnet", "soboljk" or "sobol", as the heading says. If its first line is a
       comment "# word": the word. If the file begins with Joe & Kuo's header "d s a m_i": "soboljk". Otherwise "". */
    char kind[16];
    uint64_t base; /* the base that LatNet Builder's output has in its heading; 0 for other files */
    char *text, *at;
    size_t number; /* number of the line read last, from 1 */
} koksma__number_lines;

/* Reads the file that a pattern names; koksma__number_lines_close frees. Errors: those of koksma__read_file. */
koksma_status koksma__number_lines_open(const char *pattern, const char *path, koksma__number_lines *lines);
void koksma__number_lines_close(koksma__number_lines *lines);

/* Reads the next line that has numbers; *count is 0 at the end of the file. Text after a # is a comment. Errors:
   MALFORMED (more than `most` numbers, or text that is not a whole number below 2^64). */
koksma_status koksma__number_lines_next(koksma__number_lines *lines, size_t most, uint64_t *numbers, size_t *count);

/* Reads the next line that has numbers; it must have `needed` of them. Error messages call them `what`. */
koksma_status koksma__number_lines_take(koksma__number_lines *lines, const char *what, size_t needed,
                                        uint64_t *numbers);

/* Fails with DIM if the file has fewer dimensions than are wanted. */
koksma_status koksma__number_lines_dims(const koksma__number_lines *lines, uint64_t dims, int wanted);

/* ---- File names ------------------------------------------------------------------------------------------ */

/* Paths with the placeholders {n} and {seed}, such as my_{n}_{seed}.npy: they name a family of sets of points, one file
   for each set. */

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
KOKSMA__LAB bool koksma__file_is_family(const char *path);

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

/* ---- File sets ------------------------------------------------------------------------------------------- */

/* Point sets of patterns that read files, kept for the process. */

/* While `trust` is true, calls of this thread take a kept set without asking whether its file has changed. Returns the
   previous value, false at first. */
KOKSMA__LAB bool koksma__trust_files(bool trust);

/* Generates the points of a pattern whose operand is the path of a file, before modifiers: from memory if this process
   has read the same set from the same file, else by pattern->generate. Several threads may call it at once. Errors:
   those of pattern->generate. */
koksma_status koksma__file_points(const koksma_pattern *pattern, uint64_t seed, const koksma_args *args,
                                  koksma_points *out);

#endif
