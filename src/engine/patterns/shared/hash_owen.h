/* SPDX-License-Identifier: Apache-2.0 */
/* Digital sequences scrambled by an Owen hash, for blocks of points. Results are bitwise equal to those of
   koksma_sobol_2d and similar functions of koksma/sampler.h. */
#ifndef KOKSMA_PATTERNS_SHARED_HASH_OWEN_H
#define KOKSMA_PATTERNS_SHARED_HASH_OWEN_H

#include <koksma/koksma.h>

/* Computes index[i], the index of the point at position first + i in the random order for this seed; indices and
   positions are counted from the beginning of the part (patterns/shared/parts.h). Each part has an order of its own;
   the parts are not shuffled. */
void koksma__hash_owen_order(uint64_t seed, uint64_t part, uint64_t first, size_t count, uint32_t *index);

/* Scrambles coordinate k of `count` points. v[i] has the first 32 digits within the part, with the bits reversed, and is
   overwritten; `sum` has the digits that the part adds to all of them (patterns/shared/parts.h), 0 for points below
   2^32; xs[i] receives the scrambled coordinate. Digits 33 to 53 are scrambled such that 21 zeros stay zeros after any
   first 32 digits. */
void koksma__hash_owen_scramble(uint64_t seed, int k, uint64_t sum, size_t count, uint32_t *v, double *xs);

/* Reverses the bits of the 32 direction numbers, because the hash takes words with bits reversed. */
void koksma__mirror_directions(const uint32_t *directions, uint32_t *mirrored);

#endif
