/* SPDX-License-Identifier: Apache-2.0 */
/* The sets from which a search without a first set can start: those of the listed patterns. */
#ifndef KOKSMA_OPTIMISE_START_H
#define KOKSMA_OPTIMISE_START_H

#include <koksma/optimise.h>

/* Receives one set; NULL: run->keep_going has returned false while it was made. An error ends the walk. */
typedef koksma_status (*koksma__start_function)(void *context, const koksma_points *points);

/* Generates the set of the pattern that has the structure which the search preserves, and is made for any n. Errors:
   those of koksma_generate. */
koksma_status koksma__search_default(const koksma_optimise_options *options, const koksma_run *run,
                                     koksma_points *points);

/* Calls f with the set of each listed pattern that makes such sets with the structure which the search preserves: those
   of deterministic patterns, or those of random ones. Errors: MEMORY, INTERRUPTED, those of f. */
koksma_status koksma__search_starts(const koksma_spec *measure, const koksma_optimise_options *options, bool random,
                                    const koksma_run *run, koksma__start_function f, void *context);

#endif
