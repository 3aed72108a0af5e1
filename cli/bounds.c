/* SPDX-License-Identifier: Apache-2.0 */
/* Reports values that are only bounds because the search for the exact value was cut short. */
#include "bounds.h"

#include <stdio.h>

bool cli_is_cut_short(const koksma_spec *measure, const koksma_value *value)
{
    return measure->measure->answer == KOKSMA_ANSWER_EXACT && !value->exact;
}

void cli_tell_cuts(const cli_arguments *arguments, const char *what, size_t n_cut)
{
    if (n_cut > 0 && !cli_flag(arguments, "quiet")) {
        cli_say(arguments->command->name, "%s: %zu value%s lower bound%s, not exact: the search was cut short", what,
                n_cut, n_cut > 1 ? "s are" : " is a", n_cut > 1 ? "s" : "");
    }
}
