/* SPDX-License-Identifier: Apache-2.0 */
/* What the mutators share: the functions that libFuzzer calls and offers, and random choices, which depend on the
   seed that it gives for each mutation. */
#ifndef KOKSMA_FUZZ_MUTATE_H
#define KOKSMA_FUZZ_MUTATE_H

#include <stddef.h>
#include <stdint.h>

size_t LLVMFuzzerMutate(uint8_t *bytes, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size, size_t max_size, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *first, size_t first_size, const uint8_t *second, size_t second_size,
                                 uint8_t *out, size_t max_size, unsigned seed);

/* The state of the choices, which is set to the seed. */
static inline uint64_t *mutate_state(void)
{
    static uint64_t state;
    return &state;
}

/* A number below n, by a linear congruential generator. */
static inline size_t below(size_t n)
{
    *mutate_state() = *mutate_state() * 6364136223846793005U + 1442695040888963407U;
    return (size_t)(*mutate_state() >> 33) % n;
}

#endif
