/* SPDX-License-Identifier: Apache-2.0 */
/* Prime numbers. */
#ifndef KOKSMA_PATTERNS_SHARED_PRIMES_H
#define KOKSMA_PATTERNS_SHARED_PRIMES_H

#include <koksma/koksma.h>

/* Returns the k-th prime, counted from 0: koksma__prime(0) = 2. k < KOKSMA_MAX_DIM. */
uint32_t koksma__prime(int k);

#endif
