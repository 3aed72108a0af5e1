/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_FILL_H
#define KOKSMA_PATTERNS_SHARED_FILL_H

#include <koksma/koksma.h>

/* Fills xs with `count` independent uniform doubles in [0,1): xs[2i] and xs[2i+1] are the random pair of index i and
   lane 0. Large arrays are filled on several threads; the result does not depend on their number. */
koksma_status koksma__fill_uniform(uint64_t seed, uint32_t purpose, const koksma_run *run, size_t count, double *xs);

/* Fills xs with the numbers first .. first + count - 1 of the array that koksma__fill_uniform makes. */
koksma_status koksma__range_uniform(uint64_t seed, uint32_t purpose, const koksma_run *run, uint64_t first,
                                    size_t count, double *xs);

/* Computes the permutation of koksma__random_permutation, but faster. n >= 1. */
void koksma__fill_permutation(uint64_t seed, uint32_t lane, uint32_t n, uint32_t *permutation);

#endif
