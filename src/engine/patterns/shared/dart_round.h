/* SPDX-License-Identifier: Apache-2.0 */
/* One round of dart throwing. */
#ifndef KOKSMA_PATTERNS_SHARED_DART_ROUND_H
#define KOKSMA_PATTERNS_SHARED_DART_ROUND_H

#include "patterns/shared/dart_tiles.h"

/* Throws a round of darts, on average `mean` at each square; stops at n points. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__darts_throw(koksma__disks *disks, double mean, size_t n, const koksma_run *run);

#endif
