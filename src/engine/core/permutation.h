/* SPDX-License-Identifier: Apache-2.0 */
/* Random permutations. */
#ifndef KOKSMA_CORE_PERMUTATION_H
#define KOKSMA_CORE_PERMUTATION_H

#include <stdint.h>

#include "core/visibility.h"

/* Fills permutation with a random order of 0 .. n-1, n < 2^32 (Fisher-Yates; Durstenfeld 1964). */
KOKSMA__LAB void koksma__random_permutation(uint64_t seed, uint32_t lane, uint32_t n, uint32_t *permutation);

#endif
