/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Two samplers as a shared library, for the patterns plugin:./rank1.so and plugin:./rank1.so:shifted: the rank-1 lattice
 * with the vector (1, 17, 17^2, ...), and the same shifted by a hash of the seed.
 *
 *     cc -shared -fPIC -O2 -o rank1.so rank1.c
 *     koksma measure plugin:./rank1.so@64 plugin:./rank1.so:shifted@64 -m l2-star --allow-exec
 */
#include <koksma/plugin.h>

#include <stdio.h>

static uint64_t hash(uint64_t x)
{
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U; /* splitmix64 */
    x = (x ^ x >> 27) * 0x94d049bb133111ebU;
    return x ^ x >> 31;
}

static int points(uint64_t n, int dim, double *xs, const double *shift, char *reason)
{
    if (n > UINT64_C(1) << 32) {
        snprintf(reason, KOKSMA_PLUGIN_REASON, "it takes up to 2^32 points");
        return 1;
    }
    uint64_t z = 1;
    for (int k = 0; k < dim; k++, z = z * 17 % n) {
        for (uint64_t i = 0; i < n; i++) {
            const double x = (double)(i * z % n) / (double)n + shift[k % 16];
            xs[i * (uint64_t)dim + (uint64_t)k] = x < 1 ? x : x - 1;
        }
    }
    return 0;
}

static int plain(uint64_t seed, size_t n, int dim, double *xs, char *reason)
{
    static const double none[16];
    (void)seed;
    return points(n, dim, xs, none, reason);
}

static int shifted(uint64_t seed, size_t n, int dim, double *xs, char *reason)
{
    double shift[16];
    for (uint64_t k = 0; k < 16; k++) {
        shift[k] = (double)(hash(seed + (k + 1) * 0x9e3779b97f4a7c15U) >> 11) * 0x1p-53;
    }
    return points(n, dim, xs, shift, reason);
}

static const koksma_plugin samplers[] = {
    {KOKSMA_PLUGIN_VERSION, "plain", 1, 16, plain},
    {KOKSMA_PLUGIN_VERSION, "shifted", 1, 16, shifted},
};

KOKSMA_PLUGIN_EXPORT const koksma_plugin *koksma_plugin_at(size_t i)
{
    return i < sizeof samplers / sizeof *samplers ? &samplers[i] : NULL;
}
