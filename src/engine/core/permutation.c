/* SPDX-License-Identifier: Apache-2.0 */
/* A random permutation by the inside-out form of the Fisher-Yates shuffle. It takes O(n), with one random word for each
   element. */

#include "core/random.h"

void koksma__random_permutation(uint64_t seed, uint32_t lane, uint32_t n, uint32_t *permutation)
{
    koksma__words r = {{0}};
    for (uint32_t i = 0; i < n; i++) {
        if (i % 4 == 0) {
            r = koksma__random(seed, KOKSMA__PURPOSE_SHUFFLE, i / 4, lane);
        }
        const uint32_t j = koksma__below(r.w[i % 4], i + 1); /* the inside-out form needs no initial fill */
        permutation[i] = permutation[j];
        permutation[j] = i;
    }
}
