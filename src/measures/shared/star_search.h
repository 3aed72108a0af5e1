/* SPDX-License-Identifier: Apache-2.0 */
/* Lower bounds of the star discrepancy. */
#ifndef KOKSMA_MEASURES_SHARED_STAR_SEARCH_H
#define KOKSMA_MEASURES_SHARED_STAR_SEARCH_H

#include <koksma/koksma.h>

/* Computes a lower bound by threshold accepting: the best value of `restarts` walks of `steps` steps for the excess
   and as many for the deficit. After the deadline no further walks are started. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__star_search(const koksma_points *points, const koksma_run *run, uint64_t seed, size_t steps,
                                  size_t restarts, double deadline_s, koksma_value *out);

#endif
