/* SPDX-License-Identifier: Apache-2.0 */
/* The star discrepancy in any dimension, exactly. */
#ifndef KOKSMA_MEASURES_SHARED_STAR_PARTITION_H
#define KOKSMA_MEASURES_SHARED_STAR_PARTITION_H

#include <koksma/koksma.h>

enum { KOKSMA__STAR_MAX_DIM = 64 };

/* Computes the exact value in any dimension by the partition of Dobkin, Eppstein and Mitchell, in O(n^(1 + d/2)). If
   the deadline passes, *complete becomes false and out receives the best value found. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__star_partition(const koksma_points *points, const koksma_run *run, double deadline_s,
                                     koksma_value *out, bool *complete);

#endif
