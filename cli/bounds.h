/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_BOUNDS_H
#define KOKSMA_CLI_BOUNDS_H

#include "cli.h"

/* Whether the result is a bound where an exact value was asked for. */
bool cli_is_cut_short(const koksma_spec *measure, const koksma_value *value);

/* A line on stderr that says of how many values of `what` it is so; none of 0, and with --quiet. */
void cli_tell_cuts(const cli_arguments *arguments, const char *what, size_t n_cut);

#endif
