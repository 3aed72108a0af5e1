/* SPDX-License-Identifier: Apache-2.0 */
/* Writes the plan of `koksma study quick`. */
#ifndef CLI_STUDY_QUICK_H
#define CLI_STUDY_QUICK_H

#include "cli.h"

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

#endif
