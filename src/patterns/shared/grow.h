/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Stochastic generation (Helmer, Christensen & Kensler 2021): a digital sequence in base 2 with Owen's nested uniform
 * scrambling, exact and without looking at a bit twice. Point 2^l + i goes into the empty half of the stratum of
 * width 2^-l of an earlier point, i ^ partner, at a random place. The fraction of point p in coordinate k ends in the
 * word p % 4 of koksma__random(seed, purpose, p / 4, k).
 */
#ifndef KOKSMA_PATTERNS_SHARED_GROW_H
#define KOKSMA_PATTERNS_SHARED_GROW_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* partners[32 k + l] for coordinate k < dim and level l. */
koksma_status koksma__grow(uint64_t seed, uint32_t purpose, const uint32_t *partners, const koksma_run *run,
                           koksma_points *out);

/* Points args->first .. of those, up to 2^32 - 1. */
koksma_status koksma__grow_range(uint64_t seed, uint32_t purpose, const uint32_t *partners, const koksma_args *args,
                                 koksma_points *out);

/* The partners of pmj02: its two coordinates are the matrices of the Stirling numbers of the first kind modulo 2, and the
   same shifted by a row and a column. */
extern KOKSMA__LAB const uint32_t koksma__pmj02_partners[2 * 32];

/* Computes coordinate 0 of the first n points as 32-bit fractions: v[i] is 2^32 times that of point i. partners has the
   partner of each of the 32 levels. */
koksma_status koksma__grow_column(uint64_t seed, uint32_t purpose, const uint32_t *partners, const koksma_run *run,
                                  size_t n, uint32_t *v);

#endif
