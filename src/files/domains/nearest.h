/* SPDX-License-Identifier: Apache-2.0 */
/* The nearest position on a set of triangles. */
#ifndef KOKSMA_DOMAINS_NEAREST_H
#define KOKSMA_DOMAINS_NEAREST_H

#include "domains/domain.h"

typedef struct koksma__nearest koksma__nearest;

/* Prepares searches on the parts of a domain of triangles. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__nearest_open(const koksma__point_domain *domain, const koksma_run *run, koksma__nearest **out);
void koksma__nearest_close(koksma__nearest *nearest);

/* Writes the position nearest to x to *found, which on entry has any position of the domain: the closer to x, the
   faster the search. */
void koksma__nearest_find(const koksma__nearest *nearest, const double x[3], koksma__domain_point *found);

#endif
