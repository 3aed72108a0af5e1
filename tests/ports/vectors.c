/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The test vectors of the ports of koksma/sampler.h and keys.h: prints ports/vectors.txt. Draw k of 0 .. 2^20 - 1 takes
 *
 *     seed      koksma_seed_of_frame(0x0123456789abcdef ^ (k >> 18), k >> 16 & 3)
 *     domain    koksma_domain_of_sample(koksma_domain_of_use(pixel, k % 5), k % 3),
 *               pixel = koksma_domain_of_pixel(seed, k & 255, k >> 8 & 255)
 *     index     (k * 2654435761 mod 2^32) >> k % 25
 *     keys      koksma_keys_of_4d(seed, k & 255, k >> 8 & 255, k % 5, spp), spp = 1 + k % 130, for sample index % spp
 *
 * and gives 16 words: the key of the domain (lower, upper), the four of koksma_sobol_4d times 2^32, two of koksma_pmj02_2d,
 * four of koksma_white_4d, four of koksma_keys_4d. Each block of 2^14 draws has one hash for each of the five:
 * h = (h ^ word) * 16777619 modulo 2^32 over its words, from h = 2166136261.
 */
#include <koksma/keys.h>

#include <stdio.h>

enum { DRAWS = 1 << 20, BLOCK = 1 << 14 };

static uint32_t hashed(uint32_t h, const double *xs, int count)
{
    for (int k = 0; k < count; k++) {
        h = (h ^ (uint32_t)(xs[k] * 4294967296.0)) * 16777619u;
    }
    return h;
}

int main(void)
{
    uint32_t h[5] = {0};
    printf("# Made by tests/ports/vectors.c, which says of what. block domain sobol pmj02 white keys\n");
    for (uint32_t k = 0; k < DRAWS; k++) {
        const uint64_t seed = koksma_seed_of_frame(0x0123456789abcdefu ^ k >> 18, k >> 16 & 3);
        const koksma_domain use = koksma_domain_of_use(koksma_domain_of_pixel(seed, k & 255, k >> 8 & 255), k % 5);
        const koksma_domain domain = koksma_domain_of_sample(use, k % 3);
        const uint32_t index = k * 2654435761u >> k % 25;
        const uint32_t spp = 1 + k % 130;
        const koksma_keys pixel = koksma_keys_of_4d(seed, k & 255, k >> 8 & 255, k % 5, spp);
        double sobol[4], pmj02[2], white[4], keys[4];
        koksma_sobol_4d(domain, index, sobol);
        koksma_pmj02_2d(domain, index, pmj02);
        koksma_white_4d(domain, index, white);
        koksma_keys_4d(&pixel, index % spp, keys);
        for (int f = 0; f < 5 && k % BLOCK == 0; f++) {
            h[f] = 2166136261u;
        }
        h[0] = (h[0] ^ (uint32_t)domain.key) * 16777619u;
        h[0] = (h[0] ^ (uint32_t)(domain.key >> 32)) * 16777619u;
        h[1] = hashed(h[1], sobol, 4);
        h[2] = hashed(h[2], pmj02, 2);
        h[3] = hashed(h[3], white, 4);
        h[4] = hashed(h[4], keys, 4);
        if (k % BLOCK == BLOCK - 1) {
            printf("%u %08x %08x %08x %08x %08x\n", (unsigned)(k / BLOCK), h[0], h[1], h[2], h[3], h[4]);
        }
    }
    return 0;
}
