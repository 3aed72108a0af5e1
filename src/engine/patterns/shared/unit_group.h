/* SPDX-License-Identifier: Apache-2.0 */
/* The group of the units modulo m, with u and -u identified, as a product of cyclic groups. */
#ifndef KOKSMA_PATTERNS_SHARED_UNIT_GROUP_H
#define KOKSMA_PATTERNS_SHARED_UNIT_GROUP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { KOKSMA__MAX_PRIMES = 10 }; /* numbers below 2^32 have at most 9 different prime factors */

typedef struct koksma__unit_axis {
    size_t length;
    uint64_t generator;
    bool turns; /* true: generator^(order / 2) is -1 modulo its prime power */
} koksma__unit_axis;

/* Finds generators g_k such that each unit u modulo m, or its negative -u, has one representation as a product of
   powers g_k^(x_k), 0 <= x_k < length_k. The first axis is the longest. *cut receives whether the length of the first
   axis is half its order; g_0^length_0 is then, up to the sign, the product of g_k^(order_k / 2) over the other axes
   that have `turns` set. Returns the number of axes. 2 < m < 2^32. */
int koksma__unit_axes(uint64_t m, koksma__unit_axis axes[KOKSMA__MAX_PRIMES], bool *cut);

/* Lists the primes that divide n in ascending order; returns how many there are. 0 < n < 2^32. */
int koksma__primes_of(uint64_t n, uint64_t primes[KOKSMA__MAX_PRIMES]);

#endif
