/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_OWEN_SEQUENCE_H
#define KOKSMA_PATTERNS_SHARED_OWEN_SEQUENCE_H

#include <koksma/koksma.h>

enum { KOKSMA__OWEN_DIGITS = 32 };

/* Computes digits[c] < base, c < level, for coordinate k of a sequence. For r < base^level and d < base, point r and
   point base^level * d + r' have the first `level` digits of coordinate k in common, where digit c of r' is digit c
   of r plus d * digits[c] modulo base. */
typedef void (*koksma__owen_relatives)(const void *context, int k, int level, uint32_t *digits);

/* Fills `out` with a digital sequence in a prime base whose coordinates are (0,1)-sequences, with Owen's nested uniform
   scrambling: every node of the tree of digits has its own permutation, drawn exactly. base <= KOKSMA_MAX_DIM. A point
   does not depend on n. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__owen_sequence(uint64_t seed, uint32_t base, koksma__owen_relatives relatives,
                                    const void *context, const koksma_run *run, koksma_points *out);

#endif
