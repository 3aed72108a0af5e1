/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_SOURCE_H
#define KOKSMA_CLI_SOURCE_H

#include "cli.h"

/* The points of an operand: a file, "-" for stdin, or "pattern:SPEC@N" or "pattern:SPEC@N@DIM", which are generated
   with seed. Allocates points. Returns the exit code, after an error on stderr unless it is 0. */
int cli_source_points(const cli_arguments *arguments, const char *source, uint64_t seed, const koksma_run *run,
                      koksma_points *points);

/* Whether a text has the form SPEC@N or SPEC@N@DIM. */
bool cli_source_is_spec(const char *text);

/* What an operand names: "pattern:SPEC@N[@DIM]" taken apart, or a file. */
typedef struct cli_source {
    bool is_pattern;
    koksma_spec spec;
    size_t n;
    int dim;
} cli_source;

/* Reads no file. Returns the exit code, after an error on stderr unless it is 0. */
int cli_source_open(const cli_arguments *arguments, const char *text, cli_source *source);

/* Refuses what can't be read so often, from operand `first` on: stdin twice, also for two warps, and files for
   several trials, as each is one set. False after an error on stderr. */
bool cli_sources_check(const cli_arguments *arguments, int first, uint64_t trials, size_t n_warps);

#endif
