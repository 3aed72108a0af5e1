/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The hashes of koksma/sampler.h that make domains and seeds. Of a random function each bit of the argument, flipped,
 * flips each bit of the value with probability 1/2: over N arguments the count is binomial. The worst of M such counts
 * stays within sqrt(2 log M) + 2 standard deviations, and the mean of their squares, in units of N/4, within 6 sqrt(2/M)
 * of 1, unless arguments in a narrow range leave the bits of the key related: for those the bound is 5 % per count.
 */
#include <koksma/sampler.h>

#include <string.h>

#include "core/random.h"
#include "test.h"

enum { N = test_repeats(4096, 1024), OUT = 160, SEEDS = 5 };

/* The five seeds of a draw. */
static void seeds_of(koksma_domain domain, uint32_t seeds[SEEDS])
{
    const koksma_sobol sequence = koksma_sobol_of(domain);
    memcpy(seeds, sequence.seeds, sizeof sequence.seeds);
    seeds[4] = sequence.order;
}

typedef struct arguments {
    uint64_t seed;
    uint32_t word[3]; /* x, y, use */
} arguments;

typedef void (*hash)(const arguments *a, uint32_t seeds[SEEDS]);

static void of_key(const arguments *a, uint32_t seeds[SEEDS])
{
    seeds_of(koksma_domain_of_use((koksma_domain){a->seed}, a->word[2]), seeds);
}

static void of_pixel(const arguments *a, uint32_t seeds[SEEDS])
{
    seeds_of(koksma_domain_of_pixel(a->seed, a->word[0], a->word[1]), seeds);
}

static void of_use(const arguments *a, uint32_t seeds[SEEDS])
{
    seeds_of(koksma_domain_of_use(koksma_domain_of_pixel(a->seed, a->word[0], a->word[1]), a->word[2]), seeds);
}

static void of_nested_use(const arguments *a, uint32_t seeds[SEEDS])
{
    const koksma_domain pixel = koksma_domain_of_pixel(a->seed, a->word[0], a->word[1]);
    seeds_of(koksma_domain_of_use(koksma_domain_of_use(pixel, a->word[2]), 3), seeds);
}

static void of_frame(const arguments *a, uint32_t seeds[SEEDS])
{
    seeds_of(koksma_domain_of_pixel(koksma_seed_of_frame(a->seed, a->word[0]), a->word[1], a->word[2]), seeds);
}

static void of_sample(const arguments *a, uint32_t seeds[SEEDS])
{
    seeds_of(koksma_domain_of_sample((koksma_domain){a->seed}, a->word[2]), seeds);
}

/* Four numbers of white noise, and one of another domain. */
static void of_white(const arguments *a, uint32_t seeds[SEEDS])
{
    double xs[4];
    koksma_white_4d((koksma_domain){a->seed}, a->word[2], xs);
    for (int k = 0; k < 4; k++) {
        seeds[k] = (uint32_t)(xs[k] * 0x1p32);
    }
    koksma_white_4d((koksma_domain){a->seed ^ a->word[2]}, 1, xs); /* another domain, so that there are five */
    seeds[4] = (uint32_t)(xs[0] * 0x1p32);
}

/* As programs have them: an image of 64 pixels a side, 5 uses; or any. */
static arguments arguments_of(uint32_t t, bool small)
{
    const koksma__words w = koksma__random(7, KOKSMA__PURPOSE_TEST, t, small);
    return small ? (arguments){w.w[0] % 4, {t % 64, t / 64, w.w[1] % 5}}
                 : (arguments){(uint64_t)w.w[0] << 32 | w.w[1], {w.w[2], w.w[3], w.w[0] ^ w.w[2]}};
}

static void assert_avalanche(const char *name, hash f, int first_bit, int bits, bool small)
{
    static uint32_t flips[160][OUT];
    memset(flips, 0, sizeof flips);
    for (uint32_t t = 0; t < N; t++) {
        const arguments a = arguments_of(t, small);
        uint32_t before[SEEDS], after[SEEDS];
        f(&a, before);
        for (int bit = first_bit; bit < first_bit + bits; bit++) {
            arguments b = a;
            if (bit < 64) {
                b.seed ^= (uint64_t)1 << bit;
            } else {
                b.word[bit / 32 - 2] ^= 1u << bit % 32;
            }
            f(&b, after);
            for (int o = 0; o < OUT; o++) {
                flips[bit][o] += (before[o / 32] ^ after[o / 32]) >> o % 32 & 1;
            }
        }
    }
    const double counts = (double)bits * OUT, deviation = sqrt(N / 4.0);
    double worst = 0, square = 0;
    for (int bit = first_bit; bit < first_bit + bits; bit++) {
        for (int o = 0; o < OUT; o++) {
            const double z = (flips[bit][o] - N / 2.0) / deviation;
            worst = fmax(worst, fabs(z));
            square += z * z / counts;
        }
    }
    if (worst > (small ? test_repeats(0.05, 0.1) * N / deviation : sqrt(2 * log(counts)) + 2) ||
        (!small && fabs(square - 1) > 6 * sqrt(2 / counts))) {
        fail_msg("%s, %s arguments: worst count %g deviations off, mean square %g", name, small ? "small" : "any",
                 worst, square);
    }
}

static void every_bit_reaches_every_seed(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        hash f;
        int first_bit, bits;
    } cases[] = {
        {"a use of a domain, by its key", of_key, 0, 64}, {"a use of a domain, by the use", of_key, 128, 32},
        {"a pixel, by the seed", of_pixel, 0, 64},        {"a pixel, by x and y", of_pixel, 64, 64},
        {"a use of a pixel, by all", of_use, 0, 160},     {"a nested use, by all", of_nested_use, 0, 160},
        {"a pixel of a frame, by all", of_frame, 0, 160}, {"a sample, by the domain's key", of_sample, 0, 64},
        {"a sample, by its number", of_sample, 128, 32},  {"white noise, by its number", of_white, 128, 32},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        assert_avalanche(cases[c].name, cases[c].f, cases[c].first_bit, cases[c].bits, false);
        if (cases[c].f != of_key && cases[c].f != of_sample &&
            cases[c].f != of_white) { /* those have 20 small arguments */
            assert_avalanche(cases[c].name, cases[c].f, cases[c].first_bit, cases[c].bits, true);
        }
    }
}

/* The upper 4 bits of two seeds: of two dimensions, uses, pixels or images that follow one another, by chi-square: with
   255 degrees of freedom the mean is 255 and the deviation sqrt(510); 6 of them. */
static void seeds_in_pairs_are_independent(void **state)
{
    (void)state;
    enum { PIXELS = test_repeats(1 << 16, 1 << 14), RELATIONS = 5 };
    static int counts[RELATIONS][SEEDS][SEEDS][256];
    for (uint32_t p = 0; p < PIXELS; p++) {
        uint32_t s[1 + RELATIONS][SEEDS];
        const uint32_t x = p % 256, y = p / 256;
        const koksma_domain pixel = koksma_domain_of_pixel(1, x, y);
        seeds_of(koksma_domain_of_use(pixel, 0), s[0]);
        seeds_of(koksma_domain_of_use(pixel, 1), s[1]);
        seeds_of(koksma_domain_of_use(koksma_domain_of_pixel(1, x + 1, y), 0), s[2]);
        seeds_of(koksma_domain_of_use(koksma_domain_of_pixel(1, x, y + 1), 0), s[3]);
        seeds_of(koksma_domain_of_use(koksma_domain_of_pixel(2, x, y), 0), s[4]);
        seeds_of(pixel, s[5]);
        for (int r = 0; r < RELATIONS; r++) {
            for (int a = 0; a < SEEDS; a++) {
                for (int b = 0; b < SEEDS; b++) {
                    counts[r][a][b][(s[0][a] >> 28) * 16 + (s[1 + r][b] >> 28)]++;
                }
            }
        }
    }
    for (int t = 0; t < RELATIONS * SEEDS * SEEDS; t++) {
        double chi = 0;
        for (int c = 0; c < 256; c++) {
            const double off = counts[t / 25][t / 5 % 5][t % 5][c] - PIXELS / 256.0;
            chi += off * off / (PIXELS / 256.0);
        }
        assert_near(chi, 255, 6 * sqrt(510));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_bit_reaches_every_seed),
        cmocka_unit_test(seeds_in_pairs_are_independent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
