/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of `koksma study` and `koksma rank` that have files of their own. */
#ifndef KOKSMA_CLI_STUDYING_H
#define KOKSMA_CLI_STUDYING_H

#include <koksma/study.h>

#include "cli.h"

/* ---- The run of `koksma study` and `koksma reproduce` --------------------------------------------------- */

/* Prints something of a study that has run. */
typedef koksma_status cli_of_study(const cli_args *args, koksma_study *study);

/* Opens a study, runs it, writes its report, calls `then` unless it is NULL, and closes it; says what was done. In MPI
   ranks above 0, whose options have no folder, nothing is written, and `then` is not called. Returns the exit code. */
int cli_study_run(const cli_args *args, const koksma_study_options *options, cli_work *work, cli_of_study *then);

/* ---- The advice of `koksma rank` ---------------------------------------------------------------------- */

/* What stands before item i of n in a list such as "a, b and c". */
const char *cli_between(size_t i, size_t n);

/* Whether it is decided which pattern to use: the best, or one that exceeds it by at most KOKSMA_RANK_TIE. */
bool cli_rank_decided(const koksma_ranking *ranking);
/* Prints on stderr which pattern to use or what is undecided, and how many trials were made. process: the text of
   --filter-with, or NULL. */
void cli_rank_advise(const koksma_rank_options *options, const koksma_rank_row *rows, const koksma_ranking *ranking,
                     const char *process);
/* Prints what a koksma_rank_look gets, on stderr, the least error first. */
void cli_rank_say_look(const koksma_rank_options *options, const double *errors);

/* Prints how many samples of each pattern leave the error of --target-error. spp: N of a pattern SPEC@N, or 0. Returns the
   exit code. */
int cli_rank_to_error(const cli_args *args, const koksma_rank_options *options, uint64_t spp);

#endif
