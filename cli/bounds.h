/* SPDX-License-Identifier: Apache-2.0 */
/* Reports values that are only bounds because the search for the exact value was cut short. */
#ifndef KOKSMA_CLI_BOUNDS_H
#define KOKSMA_CLI_BOUNDS_H

#include "cli.h"

/* Returns whether a value is only a bound although its measure gives exact values, because the search was cut
   short. */
bool cli_is_cut_short(const koksma_spec *measure, const koksma_value *value);

/* Prints a line on stderr with the number of values of `what` that are only bounds because a search was cut short.
   Prints nothing if there are none, or with --quiet. */
void cli_tell_cuts(const cli_arguments *arguments, const char *what, size_t n_cut);

#endif
