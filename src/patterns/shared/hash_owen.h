/* SPDX-License-Identifier: Apache-2.0 */
/* Digital sequences scrambled by Owen hashing, in bulk: the bits of koksma_sobol_2d and its kin in koksma/sampler.h. */
#ifndef KOKSMA_PATTERNS_SHARED_HASH_OWEN_H
#define KOKSMA_PATTERNS_SHARED_HASH_OWEN_H

#include <koksma/koksma.h>

/* index[i] = the index at position first + i of the order that the seed chooses: that of koksma__digital. */
void koksma__hash_owen_order(uint64_t seed, size_t first, size_t count, uint32_t *index);

/* Scrambles coordinate k in place: v[i] with bits reversed; xs[i] becomes the fraction. */
void koksma__hash_owen_scramble(uint64_t seed, int k, size_t count, uint32_t *v, double *xs);

/* mirrored[b] = directions[b] with bits reversed, b < 32: the hash takes words with bits reversed. */
void koksma__mirror_directions(const uint32_t *directions, uint32_t *mirrored);

#endif
