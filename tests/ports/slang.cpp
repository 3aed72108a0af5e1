// SPDX-License-Identifier: Apache-2.0
// The table of tests/ports/vectors.c by the Slang port, as C++ that slangc made of vectors.slang; with an argument, the
// errors of its example.
#include "slang_vectors.h"

#include <cmath>
#include <cstdio>

static uint32_t hashed(uint32_t h, const uint32_t *words, int count)
{
    for (int k = 0; k < count; k++) {
        h = (h ^ words[k]) * 16777619u;
    }
    return h;
}

static double rms(bool of_sobol)
{
    double square = 0;
    for (uint32_t p = 0; p < 1024; p++) {
        square += square_error(of_sobol, p) / 1024;
    }
    return std::sqrt(square);
}

int main(int argc, char **)
{
    if (argc > 1) {
        std::printf("white %.4f\nsobol %.4f\n", rms(false), rms(true));
        return 0;
    }
    std::printf("# Made by tests/ports/vectors.c, which says of what. block domain sobol pmj02 white keys\n");
    for (uint32_t block = 0; block < 64; block++) {
        uint32_t h[5] = {2166136261u, 2166136261u, 2166136261u, 2166136261u, 2166136261u};
        for (uint32_t k = block << 14; k < (block + 1) << 14; k++) {
            const Vector<uint32_t, 2> seed(0x89abcdefu ^ k >> 18, 0x01234567u);
            const Vector<uint32_t, 2> domain = domain_of(seed, k >> 16 & 3, k & 255, k >> 8 & 255, k % 5, k % 3);
            const uint32_t index = k * 2654435761u >> k % 25, spp = 1 + k % 130;
            const Vector<uint32_t, 4> s = sobol(domain, index), w = white(domain, index);
            const Vector<uint32_t, 2> p = pmj02(domain, index);
            const Vector<uint32_t, 4> q = keys(seed, k >> 16 & 3, k & 255, k >> 8 & 255, k % 5, spp, index % spp);
            h[0] = hashed(h[0], &domain.x, 2);
            h[1] = hashed(h[1], &s.x, 4);
            h[2] = hashed(h[2], &p.x, 2);
            h[3] = hashed(h[3], &w.x, 4);
            h[4] = hashed(h[4], &q.x, 4);
        }
        std::printf("%u %08x %08x %08x %08x %08x\n", block, h[0], h[1], h[2], h[3], h[4]);
    }
    return 0;
}
