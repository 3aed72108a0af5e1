/* SPDX-License-Identifier: Apache-2.0 */
/* An upper bound of the edge discrepancy. */
#ifndef KOKSMA_MEASURES_SHARED_EDGE_COVER_H
#define KOKSMA_MEASURES_SHARED_EDGE_COVER_H

#include "measures/shared/edge_domain.h"

/* Cuts the directions into intervals until the deadline. Sets *upper to an upper bound of the values of all lines.
   Replaces *best, the best line known before, by the best line in the middle direction of any interval if that has a
   larger value. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__edge_cover(const koksma__domain *domain, size_t n, const double *xs, const koksma_run *run,
                                 double deadline_s, koksma__edge_line *best, double *upper);

#endif
