/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of `koksma study` and `koksma rank` that have files of their own. */
#ifndef KOKSMA_CLI_STUDYING_H
#define KOKSMA_CLI_STUDYING_H

#include <stdatomic.h>

#include <koksma/study.h>

#include "cli.h"

/* ---- The plan of `koksma study quick` ----------------------------------------------------------------- */

enum { CLI_QUICK_PATH = 1024 };

typedef struct cli_quick_plan {
    char path[CLI_QUICK_PATH];
    bool new_file, new_folder; /* whether this run made the file or the folder */
    bool had_store;            /* whether the folder had results before */
    char *text; /* the plan of a rank other than 0 of mpirun, which the caller frees, or NULL: it is in the file */
} cli_quick_plan;

/* Checks the options, then makes the folder and writes plan.json into it. Fails if the folder has another plan.json.
   Ranks of mpirun other than 0 do not touch the folder: they get the text. Returns the exit code, which is not
   CLI_YES after an error; nothing is written then. */
int cli_write_quick_plan(const cli_arguments *arguments, const char *folder, cli_quick_plan *plan);

/* Removes what cli_write_quick_plan made: for a study that could not be opened. `plan` may be NULL. */
void cli_remove_quick_plan(const char *folder, const cli_quick_plan *plan);

/* ---- The options of `koksma study quick` -------------------------------------------------------------- */

/* The lists of the options, or their defaults. */
typedef struct cli_quick {
    const char *patterns, *measures, *points, *spp;
    const char *integrands, *scenes; /* NULL: none */
} cli_quick;

/* Checks each item of each list, and that some pattern can make a set. Writes nothing. Returns the exit code, which is
   not CLI_YES after an error that names the option. */
int cli_quick_check(const cli_arguments *arguments, const cli_quick *quick);

/* Tries the patterns that run code of others with the smallest number of points. Returns the exit code, which is not
   CLI_YES after an error: such code may not run, or fails. */
int cli_quick_try_code(const cli_arguments *arguments, const cli_quick *quick);

/* Size of a text with the names of all measures or integrands. */
enum { CLI_QUICK_LIST = 4096 };

/* Return the list of an option, or for "all" the measures that accept the numbers of points of the list `points`, or
   the integrands, in 2 dimensions; this list is written to `names`. A message lists the measures that are left out. */
const char *cli_quick_measures(const cli_arguments *arguments, const char *list, const char *points,
                               char names[CLI_QUICK_LIST]);
const char *cli_quick_integrands(const char *list, char names[CLI_QUICK_LIST]);

/* ---- The run of `koksma study` and `koksma reproduce` --------------------------------------------------- */

/* Prints something of a study that has run. */
typedef koksma_status cli_of_study(const cli_arguments *arguments, koksma_study *study, void *context);

/* Opens a study, runs it, writes its report, calls `then` unless it is NULL, and closes it; says what was done. The plan
   `made`, or NULL, is removed if the study can't be opened. In MPI ranks above 0, whose options have no folder, nothing is
   written, and `then` is not called. Returns the exit code. */
int cli_study_run(const cli_arguments *arguments, const koksma_study_options *options, const cli_quick_plan *made,
                  cli_work *work, cli_of_study *then, void *context);

/* ---- `koksma study audit` ----------------------------------------------------------------------------- */

/* Audits a study's folder and prints the result. Returns the exit code: CLI_NO if anything differs. */
int cli_study_audit(const cli_arguments *arguments);

/* ---- The advice of `koksma rank` ---------------------------------------------------------------------- */

/* Prints on stderr which pattern to use or what is undecided, and how many trials were made. */
/* Whether it is decided which pattern to use: the best, or one that exceeds it by at most KOKSMA_RANK_TIE. */
bool cli_rank_decided(const koksma_ranking *ranking);
void cli_rank_advise(const koksma_rank_options *options, const koksma_rank_row *rows, const koksma_ranking *ranking);

/* Prints how many samples of each pattern leave the error of --target-error. spp: N of a pattern SPEC@N, or 0. Returns the
   exit code. */
int cli_rank_to_error(const cli_arguments *arguments, const koksma_rank_options *options, uint64_t spp);

/* ---- `koksma rank --with` ------------------------------------------------------------------------------ */

/* The command of --with, and what its first picture tells of the time. */
typedef struct cli_outside {
    const char *command;
    size_t patterns;
    int spp;
    bool quiet, reference; /* reference: the first pictures are those of a reference */
    atomic_bool timed;     /* a picture of the full number of samples has been timed */
} cli_outside;

/* Renders a picture for a koksma_rank_renderer whose context is a cli_outside. */
koksma_status cli_render_outside(void *context, const koksma_rank_picture *picture, const koksma_run *run,
                                 koksma_image *image);

/* The text of --filter-with. text: room for "blur:sd=" and a number. */
enum { CLI_PROCESS_TEXT = CLI_NUMBER + 16 };
const char *cli_process_text(const koksma_rank_options *options, char text[CLI_PROCESS_TEXT]);

/* Blurs a trial's image for a koksma_rank_process whose context is a standard deviation (double). */
koksma_status cli_blur(void *context, const koksma_image *image, const koksma_run *run, koksma_image *out);

/* Whether the text of --reference names an image file, by its ending. */
bool cli_is_image(const char *text);

#endif
