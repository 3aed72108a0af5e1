/* SPDX-License-Identifier: Apache-2.0 */
/* Digital nets, hashed Owen scrambling and fractions: loops with independent iterations, which the compiler
   vectorises. All arithmetic on 32-bit words is exact; each division and each product of doubles is rounded once. */
#include <koksma/sampler.h>

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "kernels/kernels.h"

/* Returns whether `whole` is a power of two, so that x / whole equals x * (1 / whole) for all x. */
static bool is_power_of_two(double whole)
{
    int exponent;
    return frexp(whole, &exponent) == 0.5 && exponent > -1000 && exponent < 1000;
}

void KERNEL_NAME(quotients)(size_t count, const double *xs, double add, double whole, double *out)
{
    const double scale = 1 / whole;
    if (is_power_of_two(whole)) {
        for (size_t i = 0; i < count; i++) {
            out[i] = (xs[i] + add) * scale;
        }
        return;
    }
    for (size_t i = 0; i < count; i++) {
        out[i] = (xs[i] + add) / whole;
    }
}

void KERNEL_NAME(steps)(size_t count, double first, double add, double whole, double *out)
{
    const double scale = 1 / whole;
    if (is_power_of_two(whole)) {
        for (uint32_t i = 0; i < (uint32_t)count; i++) {
            out[i] = (first + (double)(int32_t)i + add) * scale;
        }
        return;
    }
    for (uint32_t i = 0; i < (uint32_t)count; i++) {
        out[i] = (first + (double)(int32_t)i + add) / whole;
    }
}

/* Converts a word through a signed integer, which every processor does in one instruction: v ^ 2^31 is v - 2^31 as a
   signed integer, and adding 2^31 as a double is exact. */
static inline double fraction(uint32_t v)
{
    return ((double)(int32_t)(v ^ 0x80000000u) + 0x1p31) * 0x1p-32;
}

void KERNEL_NAME(fractions)(size_t count, const uint32_t *restrict v, double *restrict out)
{
    for (size_t i = 0; i < count; i++) {
        out[i] = fraction(v[i]);
    }
}

/* The block is built by doubling: the second half of an aligned block is the first half xor one direction number. */
void KERNEL_NAME(digital)(size_t count, const uint32_t *restrict directions, uint32_t start, uint32_t *restrict out)
{
    if (count) {
        out[0] = start;
    }
    size_t done = 1;
    for (int b = 0; done < count; b++, done *= 2) {
        const size_t some = count - done < done ? count - done : done;
        const uint32_t direction = directions[b];
        for (size_t i = 0; i < some; i++) {
            out[done + i] = out[i] ^ direction;
        }
    }
}

void KERNEL_NAME(owen_hash)(size_t count, const uint32_t *v, bool mirror_in, bool mirror_out, uint32_t seed,
                            uint32_t *out)
{
    if (mirror_in && mirror_out) {
        for (size_t i = 0; i < count; i++) {
            out[i] = koksma_mirror(koksma_owen_hash(koksma_mirror(v[i]), seed));
        }
    } else if (mirror_out) {
        for (size_t i = 0; i < count; i++) {
            out[i] = koksma_mirror(koksma_owen_hash(v[i], seed));
        }
    } else {
        for (size_t i = 0; i < count; i++) {
            out[i] = koksma_owen_hash(mirror_in ? koksma_mirror(v[i]) : v[i], seed);
        }
    }
}

void KERNEL_NAME(pascal)(size_t count, const uint32_t *v, uint32_t *out)
{
    for (size_t i = 0; i < count; i++) {
        out[i] = koksma_pascal(v[i]);
    }
}

/* Handles eight points at a time. The partners of an aligned group of eight points also form an aligned group; the
   lowest three bits of `partner` permute their order. */
typedef uint32_t octet __attribute__((vector_size(32)));

#define GROW_OCTETS(p)                                                                                               \
    case p:                                                                                                          \
        for (size_t i = 0; i < count; i += 8) {                                                                      \
            octet old, new;                                                                                          \
            memcpy(&old, v + ((first + i) ^ (partner & ~7u)), sizeof old);                                           \
            memcpy(&new, word + i, sizeof new);                                                                      \
            old = __builtin_shufflevector(old, old, 0 ^ p, 1 ^ p, 2 ^ p, 3 ^ p, 4 ^ p, 5 ^ p, 6 ^ p, 7 ^ p);         \
            old = ((old & ~low) ^ flip) | (new >> level >> 1);                                                       \
            memcpy(out + i, &old, sizeof old);                                                                       \
        }                                                                                                            \
        break;

void KERNEL_NAME(grow)(uint32_t *v, int level, size_t first, size_t count, uint32_t partner, const uint32_t *word)
{
    uint32_t *out = v + ((size_t)1 << level) + first;
    const uint32_t low = level < 31 ? 0xffffffffu >> (level + 1) : 0, flip = low + 1;
    if (level < 3 || first % 8 || count % 8) {
        for (size_t i = 0; i < count; i++) {
            out[i] = ((v[(first + i) ^ partner] & ~low) ^ flip) | (word[i] >> level >> 1);
        }
        return;
    }
    switch (partner % 8) {
        GROW_OCTETS(0)
        GROW_OCTETS(1)
        GROW_OCTETS(2)
        GROW_OCTETS(3)
        GROW_OCTETS(4)
        GROW_OCTETS(5)
        GROW_OCTETS(6)
        GROW_OCTETS(7)
    }
}
