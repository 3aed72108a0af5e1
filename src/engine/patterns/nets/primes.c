/* SPDX-License-Identifier: Apache-2.0 */
/* The first 4,096 primes, computed once by the sieve of Eratosthenes. */
#include "patterns/nets/nets.h"

#include <pthread.h>

enum { LIMIT = 38880 }; /* above the 4,096th prime, 38,873 */

static pthread_once_t once = PTHREAD_ONCE_INIT;
static uint16_t primes[KOKSMA_MAX_DIM];

static void sieve(void)
{
    static unsigned char composite[LIMIT];
    int count = 0;
    for (uint32_t p = 2; p < LIMIT && count < KOKSMA_MAX_DIM; p++) {
        if (composite[p]) {
            continue;
        }
        primes[count++] = (uint16_t)p;
        for (uint32_t q = p * p; p < 256 && q < LIMIT; q += p) {
            composite[q] = 1;
        }
    }
}

uint32_t koksma__prime(int k)
{
    static const uint8_t first[] = {2, 3, 5, 7, 11, 13, 17, 19};
    if (k < 8) {
        return first[k];
    }
    pthread_once(&once, sieve);
    return primes[k];
}
