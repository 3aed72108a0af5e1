/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_ORDER_H
#define KOKSMA_MEASURES_SHARED_ORDER_H

#include <koksma/koksma.h>

/* The stable order of n < 2^32 numbers xs[0], xs[stride], .. >= 0: order[r] is the index of the r-th smallest. By a
   radix sort, whose result does not depend on the number of threads. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__order(const koksma_run *run, size_t n, const double *xs, size_t stride, uint32_t *order);

#endif
