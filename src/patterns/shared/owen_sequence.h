/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_OWEN_SEQUENCE_H
#define KOKSMA_PATTERNS_SHARED_OWEN_SEQUENCE_H

#include <koksma/koksma.h>

enum { KOKSMA__OWEN_DIGITS = 32 };

/* Of coordinate k: digits[c] < base, c < level, such that the points base^level d + r and r' have the first `level`
   digits in common, d < base, the digits of r' being those of r < base^level plus d digits[c], modulo base. */
typedef void (*koksma__owen_relatives)(const void *context, int k, int level, uint32_t *digits);

/* Fills out with a digital sequence in a prime base whose coordinates are (0,1)-sequences, with Owen's nested uniform
   scrambling: every node of the tree of digits has its own permutation, drawn exactly. base <= KOKSMA_MAX_DIM. The
   first points of n are those of any other n. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__owen_sequence(uint64_t seed, uint32_t base, koksma__owen_relatives relatives,
                                    const void *context, const koksma_run *run, koksma_points *out);

#endif
