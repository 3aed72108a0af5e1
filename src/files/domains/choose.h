/* SPDX-License-Identifier: Apache-2.0 */
/* Makes points on a domain with the method of a pattern. */
#ifndef KOKSMA_DOMAINS_CHOOSE_H
#define KOKSMA_DOMAINS_CHOOSE_H

#include "domains/domain.h"

/* Makes *n points of a domain by the method of the pattern that the spec names. If *n is 0, the pattern's d decides how
   many there are, and *n receives their number. The caller frees *points, also after an error; it is NULL on entry.
   Errors: ARGUMENT, UNSUPPORTED, N, IMPOSSIBLE, MEMORY, INTERRUPTED. */
koksma_status koksma__domain_choose(const koksma__point_domain *domain, const koksma_spec *spec, uint64_t seed,
                                    const koksma_run *run, size_t *n, koksma__domain_point **points);

#endif
