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

enum { MOST = 4096, MOST_DIM = 4, DOMAINS = 3, SPP = 4, PLACES = 4096, CELLS = 16, SAMPLES = 1024 };

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
    (void)n;
    koksma_white_4d(domain, i, xs);
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

/* ---- Functions ------------------------------------------------------------------------------------------ */

/* Where a sample is drawn: a use of a pixel of a frame. */
typedef struct place {
    uint64_t seed;
    uint32_t x, y, use, frame;
} place;

static uint64_t image_of(const place *p)
{
    return koksma_seed_of_frame(p->seed, p->frame);
}

static koksma_domain domain_of(const place *p)
{
    return koksma_domain_of_use(koksma_domain_of_pixel(image_of(p), p->x, p->y), p->use);
}

static double of_word(uint32_t word)
{
    return koksma_fraction(word);
}

static void permute(const place *p, uint32_t i, double *xs)
{
    xs[0] = (koksma_permute(i, SAMPLES, domain_of(p).key) + 0.5) / SAMPLES;
}

static void words(const place *p, uint32_t i, double *xs)
{
    uint32_t w[4];
    koksma_words(domain_of(p).key, KOKSMA_FOR_POINT, i, 0, w);
    for (int k = 0; k < 4; k++) {
        xs[k] = of_word(w[k]);
    }
}

static void seed_of(const place *p, uint32_t i, double *xs)
{
    for (uint32_t k = 0; k < 4; k++) {
        xs[k] = of_word(koksma_seed_of(domain_of(p).key, i + k));
    }
}

static void seed_of_order(const place *p, uint32_t i, double *xs)
{
    (void)i;
    xs[0] = of_word(koksma_seed_of_order(domain_of(p).key));
}

static void order(const place *p, uint32_t i, double *xs)
{
    xs[0] = of_word(koksma_order(domain_of(p).key, i));
    xs[1] = of_word(koksma_shuffled(i, koksma_order(domain_of(p).key, 0)));
}

/* Levels 2: the rank of a pixel is one of 16, in the image of a use. */
static void z_rank(const place *p, uint32_t i, double *xs)
{
    const koksma_domain image = {image_of(p)};
    xs[0] = (koksma_z_rank(koksma_domain_of_use(image, p->use), p->x + i % 4, p->y % 4, 2) + 0.5) / CELLS;
}

static void keys_2d(const place *p, uint32_t i, double *xs)
{
    const koksma_keys pixel = koksma_keys_of(image_of(p), p->x, p->y, p->use, SAMPLES);
    koksma_keys_2d(&pixel, i, xs);
}

static void keys_4d(const place *p, uint32_t i, double *xs)
{
    const koksma_keys pixel = koksma_keys_of_4d(image_of(p), p->x, p->y, p->use, SAMPLES);
    koksma_keys_4d(&pixel, i, xs);
}

/* A pixel of masks of 64 x 64 that are the same in all images; its sequence is that of a use of the image. */
static void mask_2d(const place *p, uint32_t i, double *xs)
{
    const koksma_domain image = {image_of(p)};
    mask(koksma_domain_of_use(image, p->use), i, SAMPLES, xs);
}

/* Functions that draw or hash: in a domain, and at a place where they take more than its domain. `image`: adjacent pixels
   of one image depend on each other, so the 4,096 numbers are those of one pixel in as many images. */
static const struct {
    const char *name;
    size_t dim, dim_at;
    void (*draw)(koksma_domain domain, uint32_t i, uint32_t n, double *xs);
    void (*draw_at)(const place *p, uint32_t i, double *xs);
    bool image;
} functions[] = {
    {"koksma_sobol_2d", 2, 0, sobol, NULL, false},
    {"koksma_sobol_4d", 4, 4, sobol4, NULL, false},
    {"koksma_pmj02_2d", 2, 2, pmj02, NULL, false},
    {"koksma_cmj_2d", 2, 2, cmj, NULL, false},
    {"koksma_r_2d", 2, 2, r, NULL, false},
    {"koksma_z_rank", 2, 1, z, z_rank, true},
    {"koksma_white_4d", 4, 4, white, NULL, false},
    {"koksma_domain_of_sample", 2, 2, parts, NULL, false},
    {"koksma_keys_2d", 2, 2, keys, keys_2d, true},
    {"koksma_mask_2d", 2, 2, mask, mask_2d, true},
    {"koksma_keys_4d", 4, 4, keys4, keys_4d, true},
    {"koksma_permute", 0, 1, NULL, permute, false},
    {"koksma_words", 0, 4, NULL, words, false},
    {"koksma_seed_of", 0, 4, NULL, seed_of, false},
    {"koksma_seed_of_order", 0, 1, NULL, seed_of_order, false},
    {"koksma_order", 0, 2, NULL, order, false},
};
enum { FUNCTIONS = sizeof functions / sizeof *functions, IN_DOMAINS = 11 };

/* ---- Pairs of domains ---------------------------------------------------------------------------------- */

enum { PRODUCT, UV, TORUS, ERRORS };

/* Of two functions in two domains: squared errors of the means, in units of independent ones, and more. */
typedef struct pairing {
    double squares[ERRORS]; /* sums of squares of the means */
    double sum, cells;      /* of all products; of cells filled */
    double fewest;          /* cells filled in one set */
    double sets, samples;
} pairing;

/* At IN_DOMAINS f + g: different coordinates of functions f <= g; and after all those, the same coordinate of both. */
enum { PAIRINGS = 2 * IN_DOMAINS * IN_DOMAINS };
static pairing pairings[PAIRINGS];
static double drawn[DOMAINS][IN_DOMAINS][MOST_DIM][MOST];

static void forget_pairings(void)
{
    for (size_t c = 0; c < PAIRINGS; c++) {
        pairings[c] = (pairing){.fewest = 256};
    }
}

static void draw(koksma_domain domain, int d, uint32_t n)
{
    for (size_t f = 0; f < IN_DOMAINS; f++) {
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
    for (size_t f = 0; f < IN_DOMAINS; f++) {
        for (size_t g = f; g < IN_DOMAINS; g++) {
            for (size_t k = 0; k < functions[f].dim * functions[g].dim; k++) {
                const size_t ku = k / functions[g].dim, kv = k % functions[g].dim;
                pair_columns(drawn[a][f][ku], drawn[b][g][kv], n,
                             &pairings[(ku == kv) * IN_DOMAINS * IN_DOMAINS + f * IN_DOMAINS + g]);
            }
        }
    }
}

/* Whether both functions of a pairing are stratified in each domain. */
static bool even(size_t c)
{
    const size_t f = c / IN_DOMAINS % IN_DOMAINS, g = c % IN_DOMAINS;
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
        const char *f = functions[c / IN_DOMAINS % IN_DOMAINS].name, *g = functions[c % IN_DOMAINS].name;
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
                         functions[k / IN_DOMAINS % IN_DOMAINS].name, functions[k % IN_DOMAINS].name, n,
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

/* ---- Places --------------------------------------------------------------------------------------------- */

/* Every function that draws or hashes, in two uses of a pixel, in adjacent pixels, in two frames and with adjacent seeds:
   the same sample here and there is uniform in the 16 x 16 cells of each coordinate here and each there, by chi-squared
   over 4,096 pixels or seeds. A function that forgets a part of its domain draws the same numbers twice and fills 16.

   The others of these headers have no domain, make one, or are forms with the same numbers (test_sampler_blocks.c,
   test_keys.c). Adjacent pixels of masks, keys and z_rank depend on each other by purpose: test_masks.c and test_keys.c
   measure how their errors do. */

typedef struct relation {
    const char *name;
    place step; /* what is added to a place */
    bool pixels;
} relation;

/* Fails unless the cells of coordinate a here and b there are as full as independent uniform numbers make them. */
static void assert_uniform(size_t f, const relation *r, uint32_t i, size_t a, size_t b, double here[][MOST_DIM],
                           double there[][MOST_DIM])
{
    int counts[CELLS * CELLS] = {0};
    double squared = 0;
    for (size_t k = 0; k < PLACES; k++) {
        counts[(size_t)(here[k][a] * CELLS) * CELLS + (size_t)(there[k][b] * CELLS)]++;
    }
    for (int c = 0; c < CELLS * CELLS; c++) {
        const double expected = (double)PLACES / (CELLS * CELLS), off = counts[c] - expected;
        squared += off * off / expected;
    }
    const double free = CELLS * CELLS - 1; /* degrees of freedom: the mean; the variance is twice that */
    assert_that(fabs(squared - free) < 6 * sqrt(2 * free),
                "%s, %s, sample %u, coordinates %zu and %zu: chi-squared is %.0f in place of %.0f", functions[f].name,
                r->name, i, a, b, squared, free);
}

static void draw_at(size_t f, const place *p, uint32_t i, double *xs)
{
    if (functions[f].draw_at) {
        functions[f].draw_at(p, i, xs);
    } else {
        functions[f].draw(domain_of(p), i, SAMPLES, xs);
    }
}

static void compare(size_t f, const relation *r, uint32_t i)
{
    static double here[PLACES][MOST_DIM], there[PLACES][MOST_DIM];
    for (uint32_t k = 0; k < PLACES; k++) {
        place p = {.seed = 1, .x = k % 64, .y = k / 64};
        if (functions[f].image) {
            p = (place){.seed = k, .x = 3, .y = 5};
        }
        draw_at(f, &p, i, here[k]);
        p.seed += r->step.seed;
        p.x += r->step.x;
        p.y += r->step.y;
        p.use += r->step.use;
        p.frame += r->step.frame;
        draw_at(f, &p, i, there[k]);
    }
    for (size_t a = 0; a < functions[f].dim_at; a++) {
        for (size_t b = 0; b < functions[f].dim_at; b++) {
            assert_uniform(f, r, i, a, b, here, there);
        }
    }
}

TEST_CASE(draws_are_independent)
{
    static const relation related[] = {
        {"uses", {.use = 1}, false},     {"columns", {.x = 1}, true},   {"rows", {.y = 1}, true},
        {"frames", {.frame = 1}, false}, {"seeds", {.seed = 1}, false},
    };
    static const uint32_t indices[] = {0, 3, 100, SAMPLES - 1};
    for (size_t f = 0; f < FUNCTIONS; f++) {
        for (size_t r = 0; r < sizeof related / sizeof *related; r++) {
            for (size_t i = 0; i < sizeof indices / sizeof *indices; i++) {
                if (!(functions[f].image && related[r].pixels)) {
                    compare(f, &related[r], indices[i]);
                }
            }
        }
    }
}
