/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The atlas: static pages that answer questions about sampling by commands, and entries, which submit a point set as a
 * new record. Part of libkoksma-lab.
 *
 *     const koksma_atlas_options options = {.folder = "atlas", .program = "/usr/bin/koksma", .quick = true};
 *     koksma_atlas_summary summary;
 *     if (!koksma_atlas_build(&options, NULL, &summary)) {
 *         printf("%zu commands were run\n", summary.computed);
 *     }
 */
#ifndef KOKSMA_ATLAS_H
#define KOKSMA_ATLAS_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The pages ---- */

typedef struct koksma_atlas_options {
    const char *questions; /* a JSON file of questions (studies/README.md); NULL: those of the library */
    const char *folder;  /* receives index.html, a page for each question and pattern, and the rows of all commands */
    const char *program; /* absolute path of the koksma program that runs the commands */
    bool quick;          /* true: of each choice {quick|full} in a command take the first */
} koksma_atlas_options;

typedef struct koksma_atlas_summary {
    size_t computed, kept; /* commands that were run; commands whose results the folder had */
    size_t pages;          /* pages written; 0 on the ranks of an MPI run but the first */
    size_t failed;         /* patterns that have no datasheet; the index has the reasons */
} koksma_atlas_summary;

/* Runs the commands of all questions and writes the pages. A result that the folder has is kept if the command, the
   version and the revisions of the patterns, measures, integrands, metrics and warps that the command names are the same.
   The ranks of an MPI run share the commands.
     run      its threads are passed to the commands
     summary  receives the counts; may not be NULL
   Errors: MISSING (the file or the program), MALFORMED (the file; a command that fails; an answer that names no row or
   several), IO, MEMORY, UNSUPPORTED (MPI without its module), INTERRUPTED: finished results are kept. */
KOKSMA_API koksma_status koksma_atlas_build(const koksma_atlas_options *options, const koksma_run *run,
                                            koksma_atlas_summary *summary);

/* ---- Entries ---- */

/* Makes an entry: a JSON text with the points, in digits that read back to the same bits, the exact value of the measure,
   the author, and a SHA-256 digest of all but the value.
     points   in [0,1]
     measure  a measure with exact values
     author   whom to credit; not empty
     json     receives a text that the caller frees with free()
   Errors: those of koksma_evaluate; ARGUMENT; UNSUPPORTED (only bounds of the measure are known for these points). */
KOKSMA_API koksma_status koksma_entry_text(const koksma_points *points, const koksma_spec *measure,
                                           const char *author, const koksma_run *run, char **json);

/* What a check found: one of
     accepted   better than the record; where none is known for this measure, n and dimension, and up to 512 coordinates,
                better than the listed patterns
     altered    the digest is not that of the points, measure and author
     false      the measure of the points is not the claimed value, to 13 digits
     worse      not better than the record, the listed patterns where there is none, or an entry before it, by more than
                1e-9, as no copy of one is
     invalid    the file is missing or no entry, or its points cannot be measured */
typedef struct koksma_entry_result {
    const char *verdict;  /* one of these words; a constant */
    koksma_status status; /* of an invalid entry the error; otherwise OK */
    char reason[512];     /* one line; of an accepted entry empty, or that it is the first of its measure and size */
    char measure[KOKSMA_MAX_SPEC]; /* the measure's spec; empty if unknown */
    size_t n;
    int dim;
    double claimed, value; /* NaN for an altered entry's value */
    double record; /* best value that it was compared with: of the record, entries before it, patterns; NaN: none */
} koksma_entry_result;

/* Checks entries in their order, each against the sets of the pattern `record` and the entries before it. Measures every
   set again.
     paths    n files, at least one
     results  receives n results
   Errors: MEMORY, INTERRUPTED: the results so far have a verdict, the others NULL. */
KOKSMA_API koksma_status koksma_entries_check(const char *const *paths, size_t n, const koksma_run *run,
                                              koksma_entry_result *results);

#ifdef __cplusplus
}
#endif

#endif
