/* SPDX-License-Identifier: Apache-2.0 */
/* The plan of `koksma study quick`. */
#ifndef CLI_STUDY_QUICK_H
#define CLI_STUDY_QUICK_H

#include "cli.h"

enum { CLI_QUICK_PATH = 1024 };

/* Makes the folder and writes plan.json into it, whose path it gives; another plan that has results is left alone. The exit
   code; not CLI_YES: after an error message. */
int cli_write_quick_plan(const cli_arguments *arguments, const char *folder, char path[CLI_QUICK_PATH]);

#endif
