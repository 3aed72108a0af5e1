/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_ORDER_H
#define KOKSMA_MEASURES_SHARED_ORDER_H

#include <koksma/koksma.h>

/* Sorts n < 2^32 numbers xs[0], xs[stride], .. >= 0 stably by a radix sort: order[r] receives the index of the number
   of rank r. The result does not depend on the number of threads. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__order(const koksma_run *run, size_t n, const double *xs, size_t stride, uint32_t *order);

#endif
