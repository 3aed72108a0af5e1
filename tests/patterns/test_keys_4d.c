/* SPDX-License-Identifier: Apache-2.0 */
/* Keys over quadruples: cells and pixels have the strata of the Sobol' sequence, a
   pixel is unbiased with the error of an independent pixel, and errors are blue whatever four coordinates couple. */
#include <koksma/integrate.h>
#include <koksma/keys.h>

#include <math.h>
#include <string.h>

#include "claims/claims.h"
#include "test.h"

/* Owen scrambling keeps the strata of a digital net. Without a tile the pixels of a cell have the first points of Sobol's
   sequence in another order, scrambled, so their t is that of the sequence; the points of a pixel with 2^m samples are an
   aligned block, whose t is that of the first 2^m. */
TEST_CASE(cells_and_pixels_have_the_strata_of_sobol)
{
    enum { AROUND = 3 * KOKSMA_KEYS_SIZE, CELL = KOKSMA_KEYS_SIZE * KOKSMA_KEYS_SIZE };
    static double xs[4 * CELL * 16];
    for (uint32_t spp = 8; spp <= 16; spp *= 2) {
        const koksma_keys middle = koksma_keys_of_4d(spp, AROUND / 2, AROUND / 2, spp % 3, spp);
        koksma_points all = {0, 4, xs}, first = test_points("sobol", (size_t)CELL * spp, 4, 0);
        koksma_points few = {spp, 4, first.xs};
        for (uint32_t p = 0; p < AROUND * AROUND; p++) {
            const koksma_keys keys = koksma_keys_of_4d(spp, p % AROUND, p / AROUND, spp % 3, spp);
            if (keys.seeds[2] == middle.seeds[2] && keys.seeds[3] == middle.seeds[3]) {
                const koksma_points own = {spp, 4, xs + 4 * all.n};
                assert_true(all.n < (size_t)CELL * spp);
                for (uint32_t s = 0; s < spp; s++) {
                    koksma_keys_4d(&keys, s, xs + 4 * all.n++);
                }
                assert_true(test_measure("t-value", &own).value == test_measure("t-value", &few).value);
            }
        }
        assert_int_equal(all.n, (size_t)CELL * spp);
        assert_true(test_measure("t-value", &all).value == test_measure("t-value", &first).value);
        koksma_points_fini(&first);
    }
}

/* With one sample the tiles have 64 x 64 pixels, with four 32 x 32, and a cell has one sample in each box of 1/8 in every
   coordinate; the points of two cells differ. Samples 0 and 1 of a pixel are in different halves of every coordinate, the
   four in different quarters. */
TEST_CASE(a_cell_of_a_tile_has_one_sample_in_each_box)
{
    for (uint32_t spp = 1; spp <= 4; spp += 3) {
        const uint32_t cell = spp == 1 ? KOKSMA_KEYS_SINGLE_SIZE : KOKSMA_KEYS_SIZE, around = 3 * cell;
        bool seen[4096] = {false};
        size_t inside = 0, others = 0;
        double first[4];
        const koksma_keys middle = koksma_keys_of_4d(8, around / 2, around / 2, 1, spp);
        koksma_keys_4d(&middle, 0, first);
        for (uint32_t p = 0; p < around * around; p++) {
            const koksma_keys keys = koksma_keys_of_4d(8, p % around, p / around, 1, spp);
            uint32_t halves[4] = {0}, quarters[4] = {0};
            for (uint32_t i = 0; i < spp; i++) {
                size_t box = 0;
                double xs[4];
                koksma_keys_4d(&keys, i, xs);
                for (int k = 0; k < 4; k++) {
                    box = 8 * box + (size_t)(8 * xs[k]);
                    halves[k] |= i < 2 ? 1u << (int)(2 * xs[k]) : 0;
                    quarters[k] |= 1u << (int)(4 * xs[k]);
                }
                if (memcmp(keys.seeds, middle.seeds, sizeof keys.seeds) != 0) {
                    others += memcmp(xs, first, sizeof xs) == 0;
                } else {
                    assert_true(!seen[box]);
                    seen[box] = true;
                    inside++;
                }
            }
            for (int k = 0; k < 4 && spp == 4; k++) {
                assert_int_equal(halves[k], 3);
                assert_int_equal(quarters[k], 15);
            }
        }
        assert_int_equal(inside, 4096);
        assert_int_equal(others, 0);
    }
}

/* Over the seeds, which move the tile and turn the order of samples, each sample of a pixel has all boxes equally often. */
TEST_CASE(each_sample_of_a_tile_has_all_boxes_equally_often)
{
    const int seeds = test_repeats(65536, 16384);
    for (uint32_t i = 0; i < 4; i++) {
        static int counts[4096];
        double chi2 = 0;
        memset(counts, 0, sizeof counts);
        for (int seed = 0; seed < seeds; seed++) {
            const koksma_keys keys = koksma_keys_of_4d((uint64_t)seed, 7, 3, 0, 4);
            double xs[4];
            koksma_keys_4d(&keys, i, xs);
            counts[(int)(8 * xs[0]) << 9 | (int)(8 * xs[1]) << 6 | (int)(8 * xs[2]) << 3 | (int)(8 * xs[3])]++;
        }
        for (int b = 0; b < 4096; b++) {
            const double mean = seeds / 4096.0;
            chi2 += (counts[b] - mean) * (counts[b] - mean) / mean;
        }
        assert_true(fabs(chi2 - 4095) < 5 * sqrt(2 * 4095.0));
    }
}

/* Over the seeds, the error of a function of four coordinates has mean 0, and the mean square of an independent pixel's. */
TEST_CASE(a_pixel_is_unbiased_and_as_good_as_independent_ones)
{
    const int seeds = test_repeats(3000, 600);
    for (uint32_t spp = 1; spp <= 100; spp = spp < 4 ? spp + 1 : spp == 64 ? 100 : 4 * spp) {
        double mean = 0, square[2] = {0}, fourth[2] = {0};
        for (int seed = 0; seed < seeds; seed++) {
            const koksma_keys keys = koksma_keys_of_4d((uint64_t)seed, 5, 9, spp % 3, spp);
            const koksma_domain domain = koksma_domain_of_pixel((uint64_t)seed, 5, 9);
            double f[2] = {0};
            for (uint32_t s = 0; s < spp; s++) {
                double xs[2][4];
                koksma_keys_4d(&keys, s, xs[0]);
                koksma_sobol_4d(domain, s, xs[1]);
                for (int k = 0; k < 2; k++) {
                    f[k] += (xs[k][0] + xs[k][1] + xs[k][2] + xs[k][3] < 2 ? 0.5 : -0.5) / spp;
                }
            }
            mean += f[0] / seeds;
            for (int k = 0; k < 2; k++) {
                square[k] += f[k] * f[k] / seeds;
                fourth[k] += f[k] * f[k] * f[k] * f[k] / seeds;
            }
        }
        const double spread = fourth[0] + fourth[1] - square[0] * square[0] - square[1] * square[1];
        const double error = sqrt(fmax(spread, 0) / seeds);            /* 0 with one sample, whose error is 1/2 */
        const double tile = spp == 3 || spp == 4 ? square[1] / 10 : 0; /* a tile's samples are not Owen's */
        assert_true(fabs(mean) < 4 * sqrt(square[0] / seeds));
        assert_true(fabs(square[0] - square[1]) <= 4 * error + tile + 1e-12);
    }
}

/* On integrands that took no part in the design. Pairs have .84 for four coordinates at 4 samples, .94 at 16; keys with
   Owen scrambling have .65 at 1 sample, .62 at 4. */
TEST_CASE(errors_are_blue_whatever_four_coordinates_couple)
{
    static const size_t spps[] = {1, 4, 16, 64};
    koksma_spec pattern;
    assert_ok(koksma_pattern_spec("ranking-keys:dims=4", &pattern));
    for (size_t i = 0; i < sizeof spps / sizeof *spps; i++) {
        koksma_screen_row rows[4];
        koksma_screen_options o = {.dim = 4, .side = 64, .spp = spps[i], .trials = 2};
        o.filter = (koksma_mask_filter){.width = 13, .height = 13};
        for (int k = 0; k < 169; k++) {
            const int u = k % 13 - 6, v = k / 13 - 6;
            o.filter.weights[k] = exp(-(u * u + v * v) / 4.5);
        }
        assert_ok(koksma_screen_errors(&pattern, &o, NULL, rows));
        for (int k = 0; k < 4; k++) {
            if (!(rows[k].blurred < (spps[i] <= 4 ? 0.58 : 0.75))) {
                fail_msg("%zu samples, %d coordinates: %.3f of white noise", spps[i], k + 1, rows[k].blurred);
            }
        }
    }
}
