// SPDX-License-Identifier: Apache-2.0
// Nanoseconds a draw by koksma/sampler.h, and by the samplers of OpenQMC: 512 pixels, 64 samples, 8 uses of each, a domain
// for each use and one draw in it, as a path tracer asks. An empty assembler statement after each draw keeps compilers from
// computing the draws of several uses side by side, which the code between draws of a renderer does, too. Programs take
// turns, and the median of 15 rounds counts. bench_sampler.sh compiles and runs this.
#ifdef WITH_OPENQMC
#include <oqmc/oqmc.h>
#endif
#include <koksma/keys.h>
#include <koksma/sampler.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

enum { PIXELS = 512, SPP = 64, USES = 8, ROUNDS = 15 };

static double seconds()
{
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

template <class T> static inline void keep(const T &x)
{
    __asm__ volatile("" : : "g"(&x) : "memory");
}

#ifdef WITH_OPENQMC
// The tables of a sampler.
template <class Sampler> static char *cache_of()
{
    char *cache = static_cast<char *>(std::malloc(Sampler::cacheSize));
    if (!cache) {
        std::exit(4);
    }
    Sampler::initialiseCache(cache);
    return cache;
}

template <class Sampler, int dim> static void theirs()
{
    static char *const cache = cache_of<Sampler>();
    for (int p = 0; p < PIXELS; p++) {
        for (int i = 0; i < SPP; i++) {
            const Sampler pixel(p % 64, p / 64, 0, i, cache);
            for (int use = 0; use < USES; use++) {
                float xs[dim];
                pixel.newDomain(use).template drawSample<dim>(xs);
                keep(xs);
            }
        }
    }
}
#endif

template <class Number, int dim, void draw(koksma_domain, uint32_t, Number *)> static void ours()
{
    for (uint32_t p = 0; p < PIXELS; p++) {
        const koksma_domain pixel = koksma_domain_of_pixel(0, p % 64, p / 64);
        for (uint32_t i = 0; i < SPP; i++) {
            for (uint32_t use = 0; use < USES; use++) {
                Number xs[dim];
                draw(koksma_domain_of_use(pixel, use), i, xs);
                keep(xs);
            }
        }
    }
}

template <int dim, void draw(const koksma_sobol *, uint32_t, double *)> static void with_kept_seeds()
{
    for (uint32_t p = 0; p < PIXELS; p++) {
        const koksma_domain pixel = koksma_domain_of_pixel(0, p % 64, p / 64);
        for (uint32_t use = 0; use < USES; use++) {
            const koksma_sobol sequence = koksma_sobol_of(koksma_domain_of_use(pixel, use));
            for (uint32_t i = 0; i < SPP; i++) {
                double xs[dim];
                draw(&sequence, i, xs);
                keep(xs);
            }
        }
    }
}

static void r_2d(koksma_domain domain, uint32_t i, double *xs)
{
    koksma_r_2d(domain, i, xs);
}

// Ranking keys: a pair of dimensions for each use.
static void with_keys()
{
    for (uint32_t p = 0; p < PIXELS; p++) {
        for (uint32_t use = 0; use < USES; use++) {
            const koksma_keys pixel = koksma_keys_of(0, p % 64, p / 64, use, SPP);
            for (uint32_t i = 0; i < SPP; i++) {
                float xs[2];
                koksma_keys_2f(&pixel, i, xs);
                keep(xs);
            }
        }
    }
}

struct row {
    const char *name;
    void (*run)();
    std::vector<double> times;
};

int main()
{
    row rows[] = {
#ifdef WITH_OPENQMC
        {"openqmc-sobol-2d", theirs<oqmc::SobolSampler, 2>, {}},
        {"openqmc-sobol-4d", theirs<oqmc::SobolSampler, 4>, {}},
        {"openqmc-pmj-2d", theirs<oqmc::PmjSampler, 2>, {}},
        {"openqmc-sobol-bn-2d", theirs<oqmc::SobolBnSampler, 2>, {}},
#endif
        {"koksma_sobol_2d", ours<double, 2, koksma_sobol_2d>, {}},
        {"koksma_sobol_4d", ours<double, 4, koksma_sobol_4d>, {}},
        {"koksma_pmj02_2d", ours<double, 2, koksma_pmj02_2d>, {}},
        {"koksma_r_2d", ours<double, 2, r_2d>, {}},
        {"koksma_sobol_at_2d", with_kept_seeds<2, koksma_sobol_at_2d>, {}},
        {"koksma_sobol_at_4d", with_kept_seeds<4, koksma_sobol_at_4d>, {}},
        {"koksma_keys_2f", with_keys, {}},
    };
    for (row &r : rows) { // the first call makes tables
        r.run();
    }
    for (int round = 0; round < ROUNDS; round++) {
        for (row &r : rows) {
            const double start = seconds();
            r.run();
            r.times.push_back((seconds() - start) * 1e9 / (PIXELS * SPP * USES));
        }
    }
    for (row &r : rows) {
        std::sort(r.times.begin(), r.times.end());
        std::printf("%s %.2f\n", r.name, r.times[ROUNDS / 2]);
    }
    return 0;
}
