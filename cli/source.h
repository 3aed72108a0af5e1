/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_SOURCE_H
#define KOKSMA_CLI_SOURCE_H

#include "cli.h"

/* The options of commands that take points, beside the operands. */
#define CLI_SOURCE_OPTIONS                                                                                           \
    {'p', "patterns", "PATTERN,..|all", "patterns, as operands PATTERN or SPEC@N; all: that have such sets"},        \
        {'n', "n", "N,..", "number of points of patterns without @N"},                                               \
    {                                                                                                                \
        'd', "dim", "DIM", "number of dimensions of patterns without @N (default: 2)"                                \
    }

/* The points of an operand: a file, "-" for stdin, or "[pattern:]SPEC@N[@DIM]", which is generated with seed. Allocates points. Returns the exit code, after an error on stderr unless it is 0. */
int cli_source_points(const cli_arguments *arguments, const char *source, uint64_t seed, const koksma_run *run,
                      koksma_points *points);

/* Whether an operand is "[pattern:]SPEC@N[@DIM]", and no file. */
bool cli_source_is_pattern(const char *text);

/* Whether a text begins with the name of a pattern. */
bool cli_names_pattern(const char *text);

/* Pattern i (0..) of -p: of its list, or of the table for "all". False past the end. */
bool cli_pattern_item(const char *list, size_t i, char spec[KOKSMA_MAX_SPEC]);

/* Takes "pattern:" and "@N" off the patterns of uses, "[USE=]SPEC@N;..", where N is the number of samples a pixel. *n:
   0 where it is unknown so far. False after an error: two numbers. */
bool cli_take_counts(const cli_arguments *arguments, char *text, uint64_t *n);

/* What an operand names: a pattern's points taken apart, or a file. */
typedef struct cli_source {
    bool is_pattern;
    koksma_spec spec;
    size_t n;
    int dim;
} cli_source;

/* Reads no file. Returns the exit code, after an error on stderr unless it is 0. */
int cli_source_open(const cli_arguments *arguments, const char *text, cli_source *source);

/* Reads "[pattern:]SPEC[@N[@DIM]]", never as the name of a file; n and dim are 0 where they are not given. Returns the
   exit code, after an error on stderr unless it is 0. */
int cli_pattern_open(const cli_arguments *arguments, const char *text, cli_source *source);

/* Completes the operands by -p, -n and -d, for the parser of options, and frees them. Returns the exit code. */
int cli_sources_expand(cli_arguments *arguments);
void cli_sources_free(cli_arguments *arguments);

/* Refuses what can't be read so often, from operand `first` on: stdin twice, also for two warps, and files for
   several trials, as each is one set. False after an error on stderr. */
bool cli_sources_check(const cli_arguments *arguments, int first, uint64_t trials, size_t n_warps);

#endif
