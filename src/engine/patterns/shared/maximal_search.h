/* SPDX-License-Identifier: Apache-2.0 */
/* Maximal Poisson-disk sets of a given number of points. */
#ifndef KOKSMA_PATTERNS_SHARED_MAXIMAL_SEARCH_H
#define KOKSMA_PATTERNS_SHARED_MAXIMAL_SEARCH_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Keeps the first `kept` points of a set, lowers its distance to d and adds points until no point fits or it has n
   points; writes the number of its points to *found. */
typedef koksma_status (*koksma__maximal_try)(void *set, size_t kept, double d, size_t n, const koksma_run *run,
                                             size_t *found);

/* Extends a maximal set of `kept` < n points with the distance d to one of n points by lowering the distance. dim: the
   free volume grows as the power dim of a length (2 on a surface). Errors: IMPOSSIBLE (the search has ended without n
   points; another seed would do), and the errors of `attempt`. */
KOKSMA__LAB koksma_status koksma__maximal_shrink(int dim, double d, size_t kept, size_t n, const koksma_run *run,
                                                 koksma__maximal_try attempt, void *set);

#endif
