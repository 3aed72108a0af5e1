/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_permute for many elements at once by cycle walking: a bijection of 0 .. 2^k - 1, with 2^k >= n the next
   power of two, is applied to all elements; those that it maps to n or above are collected and mapped again. */
#include <koksma/sampler.h>

#include "kernels/kernels.h"

enum { ROUNDS = 6, BLOCK = 256 };

typedef struct bijection {
    uint32_t mask, near, far; /* the power of two minus 1; two distances by which upper bits are shifted down */
    uint32_t flip[ROUNDS], factor[ROUNDS], add[ROUNDS];
} bijection;

static bijection of_key(uint32_t n, uint64_t key)
{
    bijection b = {.near = 1};
    uint32_t k = (uint32_t)key;
    for (b.mask = n - 1; b.mask & (b.mask + 1);) {
        b.mask |= b.mask >> 1;
    }
    while (b.near < 16 && b.mask >> (2 * b.near)) {
        b.near++;
    }
    b.far = b.near + 1;
    for (int round = 0; round < ROUNDS; round++) {
        b.flip[round] = k;
        b.factor[round] = 2 * (k >> 7) + 0x2c1b3c6du;
        b.add[round] = k >> 16;
        k = (k ^ (uint32_t)(key >> 32)) * 0x9e3779b1u;
        k ^= k >> 15;
    }
    return b;
}

static void walk(const bijection *b, size_t count, uint32_t *v)
{
    for (int round = 0; round < ROUNDS; round++) {
        const uint32_t mask = b->mask, flip = b->flip[round], factor = b->factor[round], add = b->add[round];
        const uint32_t near = b->near, far = b->far;
        for (size_t i = 0; i < count; i++) {
            uint32_t x = (v[i] ^ flip) & mask;
            x = x * factor & mask;
            x ^= x >> near;
            x = (x + add) & mask;
            x = x * 0x297a2d39u & mask;
            v[i] = x ^ x >> far;
        }
    }
}

static void permute_block(const bijection *b, uint32_t n, size_t count, uint32_t *v)
{
    uint32_t place[BLOCK], value[BLOCK];
    size_t left = 0;
    walk(b, count, v);
    for (size_t i = 0; i < count; i++) {
        place[left] = (uint32_t)i;
        value[left] = v[i];
        left += v[i] >= n;
    }
    while (left) {
        size_t still = 0;
        walk(b, left, value);
        for (size_t i = 0; i < left; i++) {
            v[place[i]] = value[i];
            place[still] = place[i];
            value[still] = value[i];
            still += value[i] >= n;
        }
        left = still;
    }
}

void KERNEL_NAME(permute)(uint32_t first, size_t count, uint32_t n, uint64_t key, uint32_t *out)
{
    const bijection b = of_key(n, key);
    while (count) {
        const size_t some = count < BLOCK ? count : BLOCK;
        for (size_t i = 0; i < some; i++) {
            out[i] = first + (uint32_t)i;
        }
        permute_block(&b, n, some, out);
        first += (uint32_t)some;
        count -= some;
        out += some;
    }
}
