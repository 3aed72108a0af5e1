/* SPDX-License-Identifier: Apache-2.0 */
/* What koksma/sampler.h promises inside a domain, for every function that draws: nets, and that all forms have the same
   numbers. test_sampler.c has that they are the library's, whose claims are tested; test_sampler_domains.c has what it
   promises between domains. */
#include <koksma/sampler.h>

#include "test.h"

enum { BLOCK = 256, MOST_DIM = 4 };

static void sobol(koksma_domain domain, uint32_t i, double *xs)
{
    koksma_sobol_2d(domain, i, xs);
}

static void sobol4(koksma_domain domain, uint32_t i, double *xs)
{
    koksma_sobol_4d(domain, i, xs);
}

static void pmj02(koksma_domain domain, uint32_t i, double *xs)
{
    koksma_pmj02_2d(domain, i, xs);
}

typedef void (*sample)(koksma_domain domain, uint32_t i, double *xs);

static bool one_in_each(const double *xs, size_t dim, uint32_t n, uint32_t columns)
{
    unsigned char seen[BLOCK] = {0};
    const uint32_t rows = n / columns;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t cell = (uint32_t)(xs[dim * i] * columns) * rows + (uint32_t)(xs[dim * i + 1] * rows);
        if (seen[cell]) {
            return false;
        }
        seen[cell] = 1;
    }
    return true;
}

static void assert_is_net(const char *name, const double *xs, size_t dim, uint32_t first, uint32_t n)
{
    for (uint32_t columns = 1; columns <= n; columns *= 2) {
        assert_that(one_in_each(xs, dim, n, columns),
                    "%s: samples %u and the next %u are no net: not one in each of %u columns and %u rows", name,
                    first, n, columns, n / columns);
    }
}

static void assert_block_is_net(const char *name, sample f, size_t dim, uint32_t first, uint32_t n)
{
    double xs[MOST_DIM * BLOCK];
    for (uint32_t i = 0; i < n; i++) {
        f(koksma_domain_of_pixel(3, first, n), first + i, xs + dim * i);
    }
    assert_is_net(name, xs, dim, first, n);
}

TEST_CASE(aligned_blocks_are_nets)
{
    for (uint32_t n = 1; n <= BLOCK; n *= 2) {
        const uint32_t firsts[] = {0, n, 5 * n, 11 * n, 1u << 31, 0x12345600u & (0u - n), 0u - n};
        for (size_t b = 0; b < sizeof firsts / sizeof *firsts; b++) {
            assert_block_is_net("koksma_sobol_2d", sobol, 2, firsts[b], n);
            assert_block_is_net("koksma_sobol_4d", sobol4, 4, firsts[b], n);
            assert_block_is_net("koksma_pmj02_2d", pmj02, 2, firsts[b], n);
        }
    }
}

/* The Z-curve gives each quad of 4^k pixels consecutive ranks: the samples of its pixels are a net. */
TEST_CASE(quads_of_an_image_are_nets)
{
    enum { LEVELS = 4, SIDE = 1 << LEVELS, SPP = 4 };
    const koksma_domain image = koksma_domain_of_pixel(7, 0, 0);
    for (uint32_t side = 1; side * side * SPP <= BLOCK; side *= 2) {
        for (uint32_t quad = 0; quad < SIDE / side * (SIDE / side); quad++) {
            const uint32_t left = quad % (SIDE / side) * side, top = quad / (SIDE / side) * side,
                           n = side * side * SPP;
            double xs[2 * BLOCK];
            for (uint32_t i = 0; i < n; i++) {
                const uint32_t x = left + i / SPP % side, y = top + i / SPP / side;
                koksma_sobol_2d(image, koksma_z_rank(image, x, y, LEVELS) * SPP + i % SPP, xs + 2 * (size_t)i);
            }
            assert_is_net("koksma_z_rank", xs, 2, quad * n, n);
        }
    }
}

/* The forms for fewer dimensions, floats, loops over one domain and lanes have the numbers of koksma_sobol_4d. */
TEST_CASE(all_forms_are_equal)
{
    enum { LANES = 1000 };
    static koksma_domain domains[LANES];
    static uint32_t indices[LANES];
    static double xs[LANES][4], lanes[4 * LANES];
    static float floats[4 * LANES];
    for (uint32_t i = 0; i < LANES; i++) {
        domains[i] = koksma_domain_of_use(koksma_domain_of_pixel(6, i, 1), i);
        indices[i] = i % 2 ? i : 2654435761u * i;
        koksma_sobol_4d(domains[i], indices[i], xs[i]);
    }
    for (uint32_t i = 0; i < LANES; i++) {
        const koksma_sobol sequence = koksma_sobol_of(domains[i]);
        double two[2], three[3], four[4];
        float two_floats[2], three_floats[3], four_floats[4];
        assert_true(koksma_sobol_1d(domains[i], indices[i]) == xs[i][0]);
        koksma_sobol_2d(domains[i], indices[i], two);
        assert_memory_equal(two, xs[i], sizeof two);
        koksma_sobol_3d(domains[i], indices[i], three);
        assert_memory_equal(three, xs[i], sizeof three);
        koksma_sobol_at_2d(&sequence, indices[i], two);
        assert_memory_equal(two, xs[i], sizeof two);
        koksma_sobol_at_4d(&sequence, indices[i], four);
        assert_memory_equal(four, xs[i], sizeof four);
        koksma_sobol_2f(domains[i], indices[i], two_floats);
        koksma_sobol_3f(domains[i], indices[i], three_floats);
        koksma_sobol_4f(domains[i], indices[i], four_floats);
        assert_true(koksma_sobol_1f(domains[i], indices[i]) == four_floats[0]);
        assert_memory_equal(two_floats, four_floats, sizeof two_floats);
        assert_memory_equal(three_floats, four_floats, sizeof three_floats);
        for (int k = 0; k < 4; k++) {
            assert_true(four_floats[k] == koksma_to_float(xs[i][k]));
        }
    }
    for (int dim = 1; dim <= 4; dim++) {
        koksma_sobol_lanes(LANES, domains, indices, dim, lanes);
        koksma_sobol_lanes_float(LANES, domains, indices, dim, floats);
        for (int k = 0; k < LANES * dim; k++) {
            assert_true(lanes[k] == xs[k / dim][k % dim] && floats[k] == koksma_to_float(lanes[k]));
        }
        const uint32_t first = dim % 2 ? 70000 : 65000; /* the latter on both sides of 2^16 */
        koksma_sobol_range(domains[0], first, LANES, dim, lanes);
        koksma_sobol_range_float(domains[0], first, LANES, dim, floats);
        for (uint32_t i = 0; i < LANES; i++) {
            double four[4];
            koksma_sobol_4d(domains[0], first + i, four);
            assert_memory_equal(lanes + (uint32_t)dim * i, four, (size_t)dim * sizeof *four);
            for (int k = 0; k < dim; k++) {
                assert_true(floats[dim * (int)i + k] == koksma_to_float(four[k]));
            }
        }
    }
}

/* The forms of white noise have the numbers of koksma_white_4d; test_keys.c has those of keys. */
TEST_CASE(forms_of_other_draws_are_equal)
{
    for (uint32_t i = 0; i < 1000; i++) {
        const koksma_domain domain = koksma_domain_of_use(koksma_domain_of_pixel(7, i, 1), i);
        double xs[4];
        float floats[4];
        koksma_white_4d(domain, i, xs);
        koksma_white_4f(domain, i, floats);
        assert_true(koksma_white_1d(domain, i) == xs[0]);
        assert_true(koksma_white_1f(domain, i) == floats[0]);
        for (int k = 0; k < 4; k++) {
            assert_true(floats[k] == koksma_to_float(xs[k]));
        }
    }
}

/* Parts of samples: those of one sample, and of all samples of an aligned block, are nets. */
TEST_CASE(parts_of_samples_are_nets)
{
    enum { SAMPLES = 32, PARTS = 8 };
    const koksma_domain domain = koksma_domain_of_use(koksma_domain_of_pixel(7, 5, 6), 2);
    static double xs[2 * SAMPLES * PARTS];
    for (uint32_t i = 0; i < SAMPLES; i++) {
        double alone[2 * PARTS];
        for (uint32_t s = 0; s < PARTS; s++) {
            koksma_sobol_2d(domain, koksma_part_of_sample(i, PARTS, s), xs + 2 * (PARTS * i + s));
            koksma_sobol_2d(koksma_domain_of_sample(domain, i), s, alone + 2 * s);
        }
        assert_is_net("the parts of a sample", xs + 2 * PARTS * (size_t)i, 2, 0, PARTS);
        assert_is_net("the domain of a sample", alone, 2, 0, PARTS);
    }
    assert_is_net("all parts", xs, 2, 0, SAMPLES * PARTS);
}
