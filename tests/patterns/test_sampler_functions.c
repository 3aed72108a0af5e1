/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Every public function of koksma/sampler.h, keys.h and mask.h that draws or hashes, in two uses of a pixel, in adjacent
 * pixels, in two frames and with adjacent seeds: the same sample here and there is uniform in the 16 x 16 cells of each
 * coordinate here and each there, by chi-squared over 4,096 pixels or seeds. A function that forgets a part of its domain
 * draws the same numbers twice and fills 16 cells.
 *
 * The others of these headers have no domain, make one, or are forms with the same numbers (test_sampler_blocks.c,
 * test_keys_4d.c); test_sampler_domains.c has the errors of sets of samples in two domains. Adjacent pixels of masks, keys
 * and z_rank depend on each other by purpose: test_masks.c and test_keys.c measure how their errors do, test_sampler.c
 * that ranks are a permutation.
 */
#include <koksma/keys.h>
#include <koksma/mask.h>
#include <koksma/sampler.h>

#include "test.h"

enum { PLACES = 4096, CELLS = 16, MOST_DIM = 4, SPP = 1024 };

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

static void sobol_4d(const place *p, uint32_t i, double *xs)
{
    koksma_sobol_4d(domain_of(p), i, xs);
}

static void white_4d(const place *p, uint32_t i, double *xs)
{
    koksma_white_4d(domain_of(p), i, xs);
}

static void pmj02_2d(const place *p, uint32_t i, double *xs)
{
    koksma_pmj02_2d(domain_of(p), i, xs);
}

static void cmj_2d(const place *p, uint32_t i, double *xs)
{
    koksma_cmj_2d(domain_of(p), i, 32, SPP / 32, xs);
}

static void r_2d(const place *p, uint32_t i, double *xs)
{
    koksma_r_2d(domain_of(p), i, xs);
}

static void domain_of_sample(const place *p, uint32_t i, double *xs)
{
    koksma_sobol_2d(koksma_domain_of_sample(domain_of(p), i), koksma_part_of_sample(i, 4, 1), xs);
}

static void permute(const place *p, uint32_t i, double *xs)
{
    xs[0] = (koksma_permute(i, SPP, domain_of(p).key) + 0.5) / SPP;
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
    const koksma_keys pixel = koksma_keys_of(image_of(p), p->x, p->y, p->use, SPP);
    koksma_keys_2d(&pixel, i, xs);
}

static void keys_4d(const place *p, uint32_t i, double *xs)
{
    const koksma_keys pixel = koksma_keys_of_4d(image_of(p), p->x, p->y, p->use, SPP);
    koksma_keys_4d(&pixel, i, xs);
}

/* A pixel of masks of 64 x 64 that are the same in all images; its sequence is that of a use of the image. */
static void mask_2d(const place *p, uint32_t i, double *xs)
{
    const koksma_domain image = {image_of(p)};
    const koksma_sobol sequence = koksma_sobol_of(koksma_domain_of_use(image, p->use));
    const uint32_t ranks[3] = {1234, 77, 3001};
    uint32_t values[3];
    for (uint32_t k = 0; k < 3; k++) {
        values[k] = koksma_mask_value(ranks[k], 64 * 64, 0x9e3779b9u * (k + 1));
    }
    koksma_mask_2d(&sequence, values, i, SPP, xs);
}

/* Functions that draw or hash. `image`: adjacent pixels of one image depend on each other, so the 4,096 numbers are those
   of one pixel in as many images. */
static const struct {
    const char *name;
    size_t dim;
    void (*draw)(const place *p, uint32_t i, double *xs);
    bool image;
} functions[] = {
    {"koksma_sobol_4d", 4, sobol_4d, false}, {"koksma_white_4d", 4, white_4d, false},
    {"koksma_pmj02_2d", 2, pmj02_2d, false}, {"koksma_cmj_2d", 2, cmj_2d, false},
    {"koksma_r_2d", 2, r_2d, false},         {"koksma_domain_of_sample", 2, domain_of_sample, false},
    {"koksma_permute", 1, permute, false},   {"koksma_words", 4, words, false},
    {"koksma_seed_of", 4, seed_of, false},   {"koksma_seed_of_order", 1, seed_of_order, false},
    {"koksma_order", 2, order, false},       {"koksma_z_rank", 1, z_rank, true},
    {"koksma_keys_2d", 2, keys_2d, true},    {"koksma_mask_2d", 2, mask_2d, true},
    {"koksma_keys_4d", 4, keys_4d, true},
};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

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

static void compare(size_t f, const relation *r, uint32_t i)
{
    static double here[PLACES][MOST_DIM], there[PLACES][MOST_DIM];
    for (uint32_t k = 0; k < PLACES; k++) {
        place p = {.seed = 1, .x = k % 64, .y = k / 64};
        if (functions[f].image) {
            p = (place){.seed = k, .x = 3, .y = 5};
        }
        functions[f].draw(&p, i, here[k]);
        p.seed += r->step.seed;
        p.x += r->step.x;
        p.y += r->step.y;
        p.use += r->step.use;
        p.frame += r->step.frame;
        functions[f].draw(&p, i, there[k]);
    }
    for (size_t a = 0; a < functions[f].dim; a++) {
        for (size_t b = 0; b < functions[f].dim; b++) {
            assert_uniform(f, r, i, a, b, here, there);
        }
    }
}

TEST_CASE(draws_are_independent)
{
    static const relation relations[] = {
        {"uses", {.use = 1}, false},     {"columns", {.x = 1}, true},   {"rows", {.y = 1}, true},
        {"frames", {.frame = 1}, false}, {"seeds", {.seed = 1}, false},
    };
    static const uint32_t indices[] = {0, 3, 100, SPP - 1};
    for (size_t f = 0; f < FUNCTIONS; f++) {
        for (size_t r = 0; r < sizeof relations / sizeof *relations; r++) {
            for (size_t i = 0; i < sizeof indices / sizeof *indices; i++) {
                if (!(functions[f].image && relations[r].pixels)) {
                    compare(f, &relations[r], indices[i]);
                }
            }
        }
    }
}
