/* SPDX-License-Identifier: Apache-2.0 */
/* Operands that name points: files, standard input, and patterns. */
#ifndef KOKSMA_CLI_SOURCE_H
#define KOKSMA_CLI_SOURCE_H

#include <glob.h>

#include "cli.h"

/* Options of commands that take points, in addition to their operands. */
#define CLI_SOURCE_OPTIONS                                                                                           \
    {'p', "patterns", "PATTERN,..|all",                                                                              \
     "further patterns, PATTERN or SPEC@N; all: every pattern that accepts N and DIM"},                              \
        {'n', "n", "N,..", "number of points of patterns without @N"},                                               \
        {0, "scale", "W[,H..]",                                                                                      \
         "divide the coordinates of files by W, or by one number for each axis: pixels of an image by its size"},    \
    {                                                                                                                \
        'd', "dim", "DIM", "number of dimensions of patterns without @N (default: 2)"                                \
    }

/* The pattern that integrates where none is named. Of smooth integrands the errors fall fastest with linear scrambling; the
   digital shift makes random the digits below the 32 of the sequence, whose truncation is a bias of 2^-33 in each
   coordinate. */
#define CLI_USUAL_PATTERN "sobol:scramble=lms,digital-shift=1"

enum { CLI_ODDITIES = 4096 }; /* bytes of the text of koksma_points_oddities */

/* Warns, unless --quiet, of what koksma_points_oddities finds in a file's points, but for the lines that are in `said`,
   which may be NULL. */
void cli_warn_points(const cli_args *args, const char *path, const koksma_points *points, const char *said);

/* Says, unless --quiet, that a pattern whose first 2^m points are a net or lattice is better at such a number.
   Returns whether that is so. */
bool cli_warn_unbalanced(const cli_args *args, const koksma_spec *spec, uint64_t n);

/* Does the first for the file of a pattern file:PATH, of which n points are taken, or any number if n is 0. Other patterns
   and what can't be read give no warning here. */
void cli_warn_file(const cli_args *args, const char *pattern, uint64_t n);

/* Reads the points of an operand, which is a file or "-" for stdin, or generates them, with `seed`, for
   "[pattern:]SPEC@N[@DIM]". Allocates the points. Returns the exit code, which is not 0 after an error on stderr. */
int cli_source_points(const cli_args *args, const char *source, uint64_t seed, const koksma_run *run,
                      koksma_points *points);

/* Returns whether an operand is the name of a family of files, one set each, such as my_{n}_{seed}.npy. */
bool cli_is_family(const char *text);

/* Finds the files whose names have digits in place of each {n} and {seed} of `family`; a name without these is its own
   family. Returns how many there are: the first of found->gl_pathv, which the caller frees by globfree(). */
size_t cli_family_files(const char *family, glob_t *found);

/* Whether `output` is a file that an operand names: itself, or the file or one of the family of files of a pattern. */
bool cli_reads(const char *text, const char *output);

/* Splits "[pattern:]SPEC@N[@DIM]" at its last one or two '@'. *dim is 0 if DIM is out of range. Returns false if the text
   has another form. */
bool cli_split(const char *text, char spec[KOKSMA_MAX_SPEC], size_t *n, int *dim);

/* Returns the text behind "pattern:", or the text itself if it does not begin so. */
const char *cli_spec_in(const char *text);

/* Returns whether an operand has the form "[pattern:]SPEC@N[@DIM]" and is no file. */
bool cli_source_is_pattern(const char *text);

/* Returns whether a text begins with the name of a pattern. */
bool cli_names_pattern(const char *text);

/* Copies pattern i (0..) of the -p list to `spec`; for "all" these are the patterns of the library that read no file.
   Returns false past the end. */
bool cli_pattern_item(const char *list, size_t i, char spec[KOKSMA_MAX_SPEC]);

/* Removes "pattern:" and "@N" from each pattern of `text`, "[USE=]SPEC@N;..", and stores N, the number of samples a pixel,
   in *n. *n is 0 until a number is found. Returns false after an error if two numbers differ or N is not a number. */
bool cli_take_counts(const cli_args *args, char *text, uint64_t *n);

/* A parsed operand: a file, or a pattern with its number of points and dimensions. */
typedef struct cli_source {
    bool is_pattern;
    koksma_spec spec;
    size_t n;
    int dim;
} cli_source;

/* Parses an operand without reading its file. Returns the exit code, which is not 0 after an error on stderr. */
int cli_source_open(const cli_args *args, const char *text, cli_source *source);

/* Parses "[pattern:]SPEC[@N[@DIM]]", which is never taken for the name of a file. n and dim are 0 if the text does
   not give them. Returns the exit code, which is not 0 after an error on stderr. */
int cli_pattern_open(const cli_args *args, const char *text, cli_source *source);

/* cli_sources_expand completes the operands by -p, -n and -d, and returns the exit code; cli_sources_free frees them.
   The option parser calls both. */
int cli_sources_expand(cli_args *args);
void cli_sources_free(cli_args *args);

/* Warns that --seed has no effect on the points of `source`. */
void cli_warn_one_set(const cli_args *args, const char *source);

/* Checks the operands from number `first` on. Refuses to read stdin twice, also for two warps, and to read files for
   several trials, because a file is one set. Returns false after an error on stderr. */
bool cli_sources_check(const cli_args *args, int first, uint64_t trials, size_t n_warps);

#endif
