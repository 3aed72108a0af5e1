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

#endif
