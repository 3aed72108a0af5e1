/* SPDX-License-Identifier: Apache-2.0 */
/* poisson-disk-maximal and dart-throwing on a domain. */
#ifndef KOKSMA_DOMAINS_MAXIMAL_H
#define KOKSMA_DOMAINS_MAXIMAL_H

#include "domains/domain.h"

koksma_status koksma__choose_maximal(const koksma__choice *choice);

/* Makes the maximal set whose smallest distance is the parameter d, whatever number of points that is: sets choice->n and
   allocates choice->points. Errors: N (too many points), MEMORY, INTERRUPTED. */
koksma_status koksma__choose_by_distance(koksma__choice *choice);

/* Throws darts until there are n points, none closer than the parameter f times the distance of n points in the densest
   packing of the plane, times the root of the domain's area. */
koksma_status koksma__choose_fraction(const koksma__choice *choice);

#endif
