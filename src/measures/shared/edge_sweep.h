/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_EDGE_SWEEP_H
#define KOKSMA_MEASURES_SHARED_EDGE_SWEEP_H

#include "measures/shared/edge_domain.h"

/* Computes the largest |count/n - mass| over half-planes whose border goes through a point, with its witness. If
   run's time limit passes, out is not exact: it receives the best value found and an upper bound. Errors: N, MEMORY,
   INTERRUPTED. */
koksma_status koksma__edge_sweep(const koksma__domain *domain, size_t n, const double *xs, const koksma_run *run,
                                 koksma_value *out);

#endif
