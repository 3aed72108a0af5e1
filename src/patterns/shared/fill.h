/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_FILL_H
#define KOKSMA_PATTERNS_SHARED_FILL_H

#include <koksma/koksma.h>

/* Fills xs with count independent uniform doubles in [0,1): xs[2i], xs[2i+1] are the pair of index i, lane 0.
   Over threads when there are many; the bits are the same. */
koksma_status koksma__fill_uniform(uint64_t seed, uint32_t purpose, const koksma_run *run, size_t count, double *xs);

/* The numbers first .. first + count - 1 of those. */
koksma_status koksma__range_uniform(uint64_t seed, uint32_t purpose, const koksma_run *run, uint64_t first,
                                    size_t count, double *xs);

/* koksma__random_permutation, the same bits, faster. n >= 1. */
void koksma__fill_permutation(uint64_t seed, uint32_t lane, uint32_t n, uint32_t *permutation);

#endif
