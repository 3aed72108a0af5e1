/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_OWEN_DIGITS_H
#define KOKSMA_PATTERNS_SHARED_OWEN_DIGITS_H

#include <koksma/koksma.h>

/* Fills `out` with the Owen-scrambled Halton sequence; the base of coordinate k is the k-th prime. */
koksma_status koksma__owen_digits(uint64_t seed, const koksma_run *run, koksma_points *out);

#endif
