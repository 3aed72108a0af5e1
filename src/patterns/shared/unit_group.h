/* SPDX-License-Identifier: Apache-2.0 */
/* The group of the units modulo m as a product of cyclic groups, u and -u being one. */
#ifndef KOKSMA_PATTERNS_SHARED_UNIT_GROUP_H
#define KOKSMA_PATTERNS_SHARED_UNIT_GROUP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { KOKSMA__MAX_PRIMES = 10 }; /* more than any n below 2^32 has */

typedef struct koksma__unit_axis {
    size_t length;
    uint64_t generator;
    bool turns; /* half-way around it is -1 */
} koksma__unit_axis;

/* Every unit modulo m, itself or as its negative, is once the product of powers g_k^(x_k), 0 <= x_k < length_k. The
   first axis is the longest. *cut: it goes half-way around, and g_0^length_0 is the product, but for the sign, of the
   other axes' half-way points, where they turn. Returns the number of axes. 2 < m < 2^32. */
int koksma__unit_axes(uint64_t m, koksma__unit_axis axes[KOKSMA__MAX_PRIMES], bool *cut);

/* The primes that divide n, upward; returns how many. 0 < n < 2^32. */
int koksma__primes_of(uint64_t n, uint64_t primes[KOKSMA__MAX_PRIMES]);

#endif
