/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Domains of koksma/sampler.h are independent, for every function that draws and every pair of them. The expected
 * numbers are those of independent uniform u and v, of which N samples have
 *
 *     mean of (u - 1/2)(v - 1/2)       RMS error 1 / (12 sqrt(N)), because u - 1/2 has the variance 1/12
 *     mean of u v                      RMS error sqrt(7 / (144 N)): E(u^2 v^2) - E(u v)^2 = 1/9 - 1/16
 *     mean of B2(u - v on the torus)   RMS error 1 / sqrt(180 N): B2(t) = t^2 - t + 1/6 has mean 0, square 1/180
 *     cells of 16 x 16 with a sample   256 (1 - (1 - 1/256)^N) in the mean
 *
 * Two Owen-scrambled van der Corput sequences in orders of nested uniform shuffles have 1 / (12 sqrt(N)) times
 * sqrt(49 / 31) = 1.257: with s_p the sign of bit p, u - 1/2 is the sum of s_p 2^-(p+2), p = 0, 1 ... A pair of
 * indices that differ in bit p alone is flipped as a whole, so the mean of s_p s'_p has the variance (1 + 2^-p) / N,
 * and that of s_p s'_q with p != q has 1/N as for independent numbers. Then 144 N times the variance of the mean is
 * 1 + 144 (the sum of 2^-(4p+8) 2^-p) = 1 + (144 / 256)(32 / 31) = 49 / 31.
 */
#include <koksma/keys.h>
#include <koksma/mask.h>
#include <koksma/sampler.h>

#include "test.h"

enum { MOST = 4096, MOST_DIM = 4, DOMAINS = 3, SPP = 4 };

static void sobol(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    (void)n;
    koksma_sobol_2d(domain, i, xs);
}

static void sobol4(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    (void)n;
    koksma_sobol_4d(domain, i, xs);
}

static void pmj02(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    (void)n;
    koksma_pmj02_2d(domain, i, xs);
}

static void cmj(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    uint32_t columns = 1;
    while (columns * columns < n) {
        columns *= 2;
    }
    koksma_cmj_2d(domain, i, columns, n / columns, xs);
}

static void r(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    (void)n;
    koksma_r_2d(domain, i, xs);
}

/* Index i along the samples of an image of n / SPP pixels, row by row. */
static uint32_t z_index(koksma_domain domain, uint32_t i, uint32_t n)
{
    int levels = 0;
    while (n / SPP >> (2 * levels) > 1) {
        levels++;
    }
    return koksma_z_rank(domain, i / SPP & ((1u << levels) - 1), i / SPP >> levels, levels) * SPP + i % SPP;
}

static void z(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    koksma_sobol_2d(domain, z_index(domain, i, n), xs);
}

static void white(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    double four[4];
    (void)n;
    koksma_white_4d(domain, i, four);
    xs[0] = four[0];
    xs[1] = four[3];
}

/* Sample i is part i % 4 of sample i / 4, whose domain has its parts alone. */
static void parts(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    (void)n;
    koksma_sobol_2d(koksma_domain_of_sample(domain, i / 4), i % 4, xs);
}

/* A pixel of an image whose seed is the domain's key, in pair 1. */
static void keys(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    const koksma_keys pixel = koksma_keys_of(domain.key, 3, 5, 1, n);
    koksma_keys_2d(&pixel, i, xs);
}

static void keys4(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    const koksma_keys pixel = koksma_keys_of_4d(domain.key, 3, 5, 1, n);
    koksma_keys_4d(&pixel, i, xs);
}

/* Pixel 17 of an image with masks of 64 x 64 pixels, which are the same for all domains. */
static void mask(koksma_domain domain, uint32_t i, uint32_t n, double *xs)
{
    const koksma_sobol sequence = koksma_sobol_of(domain);
    const uint32_t ranks[3] = {1234, 77, 3001};
    uint32_t values[3];
    for (uint32_t k = 0; k < 3; k++) {
        values[k] = koksma_mask_value(ranks[k], 64 * 64, 0x9e3779b9u * (k + 1));
    }
    koksma_mask_2d(&sequence, values, i, n, xs);
}

static const struct {
    const char *name;
    size_t dim;
    void (*draw)(koksma_domain domain, uint32_t i, uint32_t n, double *xs);
} functions[] = {
    {"koksma_sobol_2d", 2, sobol}, {"koksma_sobol_4d", 4, sobol4},
    {"koksma_pmj02_2d", 2, pmj02}, {"koksma_cmj_2d", 2, cmj},
    {"koksma_r_2d", 2, r},         {"koksma_z_rank", 2, z},
    {"koksma_white_4d", 2, white}, {"koksma_domain_of_sample", 2, parts},
    {"koksma_keys_2d", 2, keys},   {"koksma_mask_2d", 2, mask},
    {"koksma_keys_4d", 4, keys4},
};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

/* ---- Pairs of domains ---------------------------------------------------------------------------------- */

enum { PRODUCT, UV, TORUS, ERRORS };

/* Of two functions in two domains: squared errors of the means, in units of independent ones, and more. */
typedef struct pairing {
    double squares[ERRORS]; /* sums of squares of the means */
    double sum, cells;      /* of all products; of cells filled */
    double fewest;          /* cells filled in one set */
    double sets, samples;
} pairing;

/* At FUNCTIONS f + g: different coordinates of functions f <= g; and after all those, the same coordinate of both. */
enum { PAIRINGS = 2 * FUNCTIONS * FUNCTIONS };
static pairing pairings[PAIRINGS];
static double drawn[DOMAINS][FUNCTIONS][MOST_DIM][MOST];

static void forget_pairings(void)
{
    for (size_t c = 0; c < PAIRINGS; c++) {
        pairings[c] = (pairing){.fewest = 256};
    }
}

static void draw(koksma_domain domain, int d, uint32_t n)
{
    for (size_t f = 0; f < FUNCTIONS; f++) {
        for (uint32_t i = 0; i < n; i++) {
            double xs[MOST_DIM];
            functions[f].draw(domain, i, n, xs);
            for (size_t k = 0; k < functions[f].dim; k++) {
                drawn[d][f][k][i] = xs[k];
            }
        }
    }
}

static void pair_columns(const double *us, const double *vs, uint32_t n, pairing *p)
{
    double sums[ERRORS] = {0};
    unsigned char seen[256] = {0};
    for (uint32_t i = 0; i < n; i++) {
        const double u = us[i], v = vs[i], t = u < v ? u - v + 1 : u - v;
        sums[PRODUCT] += (u - 0.5) * (v - 0.5);
        sums[UV] += u * v - 0.25;
        sums[TORUS] += t * t - t + 1.0 / 6;
        seen[(size_t)(u * 16) * 16 + (size_t)(v * 16)] = 1;
    }
    const double units[ERRORS] = {1.0 / 144, 7.0 / 144, 1.0 / 180};
    int filled = 0;
    for (int k = 0; k < ERRORS; k++) {
        p->squares[k] += sums[k] * sums[k] / n / units[k];
    }
    for (int c = 0; c < 256; c++) {
        filled += seen[c];
    }
    p->sum += 12 * sums[PRODUCT];
    p->cells += filled;
    p->fewest = filled < p->fewest ? filled : p->fewest;
    p->sets++;
    p->samples += n;
}

/* All functions in domain a against all in domain b. */
static void pair_domains(int a, int b, uint32_t n)
{
    for (size_t f = 0; f < FUNCTIONS; f++) {
        for (size_t g = f; g < FUNCTIONS; g++) {
            for (size_t k = 0; k < functions[f].dim * functions[g].dim; k++) {
                const size_t ku = k / functions[g].dim, kv = k % functions[g].dim;
                pair_columns(drawn[a][f][ku], drawn[b][g][kv], n,
                             &pairings[(ku == kv) * FUNCTIONS * FUNCTIONS + f * FUNCTIONS + g]);
            }
        }
    }
}

/* Whether both functions of a pairing are stratified in each domain. */
static bool even(size_t c)
{
    const size_t f = c / FUNCTIONS % FUNCTIONS, g = c % FUNCTIONS;
    return functions[f].draw != white && functions[f].draw != parts && functions[g].draw != white &&
           functions[g].draw != parts;
}

/* The RMS of the errors is below 1.3 of independent numbers', beside 4.5 standard errors of an RMS of so many; u v
   has less, if each domain is stratified; if not, its errors in one set are alike, as it holds the mean of u. The
   correlation of all samples is 0 within 4.5 standard errors. */
static void assert_independent(const char *what, double n)
{
    static const char *const names[ERRORS] = {"(u - 1/2)(v - 1/2)", "u v", "B2(u - v)"};
    for (size_t c = 0; c < PAIRINGS; c++) {
        const pairing *p = &pairings[c];
        const char *f = functions[c / FUNCTIONS % FUNCTIONS].name, *g = functions[c % FUNCTIONS].name;
        const double error = 1 / sqrt(2 * p->sets), uv = even(c) ? 1.0 : 1.3, limits[ERRORS] = {1.3, uv, 1.3};
        for (int k = 0; k < ERRORS && p->sets > 0; k++) {
            const double rms = sqrt(p->squares[k] / p->sets);
            assert_that(rms < limits[k] * (1 + 4.5 * error),
                        "%s, %s and %s, N = %g: the mean of %s has %.3f times the error of independent numbers", what,
                        f, g, n, names[k], rms);
        }
        const double correlation = p->sum / p->samples;
        assert_that(p->sets <= 0 || fabs(correlation) < 4.5 * 1.3 / sqrt(p->samples),
                    "%s, %s and %s, N = %g: correlation %.4f", what, f, g, n, correlation);
    }
}

/* Three uses of a pixel. The error falls as N^-1/2, and the pairs fill the square. */
TEST_CASE(uses_are_independent)
{
    static const uint32_t counts[] = {2, 8, 16, 64, 256, 1024, MOST};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        const uint32_t n = counts[c], sets = test_repeats(n < 256 ? 1u << 14 : 1u << 16, 1u << 12) / n;
        forget_pairings();
        for (uint32_t set = 0; set < sets; set++) {
            const koksma_domain pixel = koksma_domain_of_pixel(n, set % 64, set / 64);
            for (int d = 0; d < DOMAINS; d++) {
                draw(koksma_domain_of_use(pixel, (uint32_t)d), d, n);
                for (int other = 0; other < d; other++) {
                    pair_domains(other, d, n);
                }
            }
        }
        assert_independent("uses", n);
        for (size_t k = 0; k < PAIRINGS && n >= 1024; k++) {
            const pairing *p = &pairings[k];
            const double expected = 256 * (1 - pow(255.0 / 256, n));
            if (p->sets > 0 && (!(p->cells / p->sets > expected - 1) || (n == MOST && p->fewest < 255))) {
                fail_msg("%s and %s, N = %u: %.1f of 256 cells filled, at least %.0f",
                         functions[k / FUNCTIONS % FUNCTIONS].name, functions[k % FUNCTIONS].name, n,
                         p->cells / p->sets, p->fewest);
            }
        }
    }
}

/* ---- Domains that are alike ---------------------------------------------------------------------------- */

typedef struct couple {
    koksma_domain a, b;
} couple;

static const char *const relations[] = {
    "adjacent uses",   "uses that differ in a bit", "uses i and i << 16",       "adjacent columns",
    "adjacent rows",   "transposed pixels",         "adjacent seeds",           "seeds that differ in a bit",
    "seed and column", "adjacent frames",           "frame and column swapped", "adjacent samples",
    "a sample, a use", "a domain and its use 0",    "use 0 and its use 0",      "uses 1, 2 and 2, 1",
    "adjacent keys",   "keys that differ in a bit", "key and use swapped",
};

/* Two domains of that relation, of which there is one pair for each i. */
static couple related(size_t relation, uint32_t i)
{
#define PIXEL koksma_domain_of_pixel
#define USE koksma_domain_of_use
#define FRAME koksma_seed_of_frame
    const koksma_domain at = PIXEL(relation, i, 2), key = {i}, next = {i + 1};
    switch (relation) {
    case 0:
        return (couple){USE(at, i), USE(at, i + 1)};
    case 1:
        return (couple){USE(at, i), USE(at, i ^ 1u << i % 32)};
    case 2:
        return (couple){USE(at, i + 1), USE(at, (i + 1) << 16)};
    case 3:
        return (couple){USE(PIXEL(4, i, 9), 1), USE(PIXEL(4, i + 1, 9), 1)};
    case 4:
        return (couple){USE(PIXEL(5, 9, i), 1), USE(PIXEL(5, 9, i + 1), 1)};
    case 5:
        return (couple){PIXEL(6, i, i + 7), PIXEL(6, i + 7, i)};
    case 6:
        return (couple){USE(PIXEL(i, 8, 9), 1), USE(PIXEL(i + 1, 8, 9), 1)};
    case 7:
        return (couple){PIXEL(i, 8, 10), PIXEL(i ^ (uint64_t)1 << i % 64, 8, 10)};
    case 8:
        return (couple){PIXEL(i, 77, 1), PIXEL(77, i, 1)};
    case 9:
        return (couple){USE(PIXEL(FRAME(10, i), 8, 9), 1), USE(PIXEL(FRAME(10, i + 1), 8, 9), 1)};
    case 10:
        return (couple){PIXEL(FRAME(11, i), 77, 1), PIXEL(FRAME(11, 77), i, 1)};
    case 11:
        return (couple){koksma_domain_of_sample(at, i), koksma_domain_of_sample(at, i + 1)};
    case 12:
        return (couple){koksma_domain_of_sample(at, i), USE(at, i)};
    case 13:
        return (couple){PIXEL(7, i, i), USE(PIXEL(7, i, i), 0)};
    case 14:
        return (couple){USE(PIXEL(8, i, i), 0), USE(USE(PIXEL(8, i, i), 0), 0)};
    case 15:
        return (couple){USE(USE(PIXEL(9, i, i), 1), 2), USE(USE(PIXEL(9, i, i), 2), 1)};
    case 16:
        return (couple){{2 * i}, {2 * i + 1}};
    case 17:
        return (couple){key, {i ^ (uint64_t)1 << i % 64}};
    default:
        return (couple){USE(key, i + 1), USE(next, i)};
    }
#undef PIXEL
#undef USE
#undef FRAME
}

TEST_CASE(domains_that_are_alike_are_independent)
{
    enum { SETS = 64, N = 256 };
    for (size_t r = 0; r < sizeof relations / sizeof *relations; r++) {
        forget_pairings();
        for (uint32_t set = 0; set < SETS; set++) {
            const couple c = related(r, set);
            assert_true(c.a.key != c.b.key);
            draw(c.a, 0, N);
            draw(c.b, 1, N);
            pair_domains(0, 1, N);
        }
        assert_independent(relations[r], N);
    }
}
