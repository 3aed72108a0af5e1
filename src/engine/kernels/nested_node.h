/* SPDX-License-Identifier: Apache-2.0 */
/* The random bits of nested uniform scrambling in base 2 (the modifier owen): one for each node of the tree of the 53
   binary digits, which flips the next digit. One call of the generator at a node gives the 127 bits of the node and of
   the nodes in the six levels below it: level j has 2^j of them. */
#ifndef KOKSMA_KERNELS_NESTED_NODE_H
#define KOKSMA_KERNELS_NESTED_NODE_H

#include "core/random.h"

enum {
    KOKSMA__NESTED_DIGITS = 53,
    KOKSMA__NESTED_LEVELS = 7,
    KOKSMA__NESTED_SPARE = 3 /* DIGITS + SPARE is a multiple of LEVELS */
};

/* The random bits at a node: bit 2^j + (the j digits after the node) of the two words, low and high, flips the digit
   that follows these j digits. flips: the flips of the 7 digits before the node, for the kernel nested_bits. */
typedef struct koksma__nested_node {
    uint64_t low, high, flips;
} koksma__nested_node;

/* Returns the random words of the node of the first `top` of the 53 digits of x. */
static inline koksma__words koksma__nested_words(uint64_t seed, uint64_t x, int top, uint32_t lane)
{
    return koksma__random(seed, KOKSMA__PURPOSE_NESTED, (uint64_t)1 << top | x >> (KOKSMA__NESTED_DIGITS - top),
                          lane);
}

static inline koksma__nested_node koksma__nested_node_of(koksma__words r)
{
    return (koksma__nested_node){r.w[0] | (uint64_t)r.w[1] << 32, r.w[2] | (uint64_t)r.w[3] << 32, 0};
}

/* Returns the flips of the 7 digits after a node, which are the lowest 7 bits of `path`. */
static inline uint64_t koksma__nested_flips(koksma__nested_node node, uint64_t path)
{
    const uint64_t p = path & 127;
    return (node.low >> 1 & 1) << 6 | (node.low >> (2 | p >> 6) & 1) << 5 | (node.low >> (4 | p >> 5) & 1) << 4 |
           (node.low >> (8 | p >> 4) & 1) << 3 | (node.low >> (16 | p >> 3) & 1) << 2 |
           (node.low >> (32 | p >> 2) & 1) << 1 | (node.high >> (p >> 1) & 1);
}

#endif
