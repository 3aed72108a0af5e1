/* SPDX-License-Identifier: Apache-2.0 */
/* Checks the options of `koksma study quick`. */
#ifndef CLI_STUDY_QUICK_CHECK_H
#define CLI_STUDY_QUICK_CHECK_H

#include "cli.h"

/* The lists of the options, or their defaults. */
typedef struct cli_quick {
    const char *patterns, *measures, *points, *spp;
    const char *integrands, *scenes; /* NULL: none */
} cli_quick;

/* Checks each item of each list, and that some pattern can make a set. Writes nothing. Returns the exit code, which is
   not CLI_YES after an error that names the option. */
int cli_quick_check(const cli_arguments *arguments, const cli_quick *quick);

#endif
