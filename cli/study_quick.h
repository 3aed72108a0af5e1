/* SPDX-License-Identifier: Apache-2.0 */
/* Writes the plan of `koksma study quick`. */
#ifndef CLI_STUDY_QUICK_H
#define CLI_STUDY_QUICK_H

#include "cli.h"

enum { CLI_QUICK_PATH = 1024 };

/* Makes the folder and writes plan.json into it. path: the path of that file. Fails if the folder has results of a
   different plan. Returns the exit code, which is not CLI_YES after an error. */
int cli_write_quick_plan(const cli_arguments *arguments, const char *folder, char path[CLI_QUICK_PATH]);

#endif
