/* SPDX-License-Identifier: Apache-2.0 */
/* Maximal Poisson disk sets: exactly n points, for many n and seeds, and by distance. */
#include <koksma/verify.h>

#include <math.h>

#include "pattern_sets.h"
#include "patterns/spacing/spacing.h"

static double least_distance(const koksma_points *p)
{
    double d;
    assert_ok(koksma_smallest_distance(p, true, NULL, &d));
    return d;
}

TEST_CASE(exactly_n_points)
{
    static const size_t counts[] = {1, 2, 3, 4, 5, 6, 7, 10, 13, 33, 100, 317, 1000, 1001};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        for (uint64_t seed = 0; seed < 8; seed++) {
            koksma_points p = test_points("poisson-disk-maximal", counts[c], 2, seed);
            if (counts[c] > 3) {
                const double rho = least_distance(&p) / koksma__packing_distance(counts[c], 2, true);
                assert_true(rho > 0.6 && rho < 1);
            }
            koksma_points_fini(&p);
        }
    }
}

/* Of a set like this there is one in twenty thousand: where the search had found more than 16 points, 15 others leave
   no room for another. */
TEST_CASE(searches_start_again)
{
    koksma_points p = test_points("poisson-disk-maximal", 16, 2, 24996);
    assert_true(least_distance(&p) > 0.15);
    koksma_points_fini(&p);
}

TEST_CASE(by_distance)
{
    static const double distances[] = {0.5, 0.3, 0.1, 0.05, 0.02};
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
        char text[64];
        koksma_spec spec;
        koksma_points p;
        snprintf(text, sizeof text, "poisson-disk-maximal:d=%g", distances[i]);
        assert_ok(koksma_pattern_spec(text, &spec));
        assert_ok(koksma_generate_whole(&spec, 3, NULL, 2, &p));
        assert_true(least_distance(&p) >= distances[i] * (1 - 1e-12));
        const double expected = 0.6965 / distances[i] / distances[i];
        assert_near((double)p.n, expected, 1.5 + 1.5 * sqrt(expected));
        koksma_points same = test_points(text, p.n, 2, 3);
        assert_memory_equal(same.xs, p.xs, 2 * p.n * sizeof *p.xs);
        koksma_points_fini(&same);
        assert_int_equal(status_of(text, 2 * p.n, 2), KOKSMA_N);
        koksma_points_fini(&p);
    }
    koksma_spec spec;
    koksma_points p;
    assert_ok(koksma_pattern_spec("poisson-disk-maximal", &spec));
    assert_int_equal(koksma_generate_whole(&spec, 3, NULL, 2, &p), KOKSMA_N);
    assert_ok(koksma_pattern_spec("random", &spec));
    assert_int_equal(koksma_generate_whole(&spec, 3, NULL, 2, &p), KOKSMA_N);
}

/* Cells are a little smaller than the distance asks for, so that points of cells that touch at a corner's corner can
   be too near: one set in thousands shows it. */
TEST_CASE(many_small_sets_keep_their_distance)
{
    static const double distances[] = {0.6, 0.3, 0.29, 0.21};
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
        char text[64];
        koksma_spec spec;
        snprintf(text, sizeof text, "poisson-disk-maximal:d=%g", distances[i]);
        assert_ok(koksma_pattern_spec(text, &spec));
        for (uint64_t seed = 0; seed < 5000; seed++) {
            koksma_points p;
            assert_ok(koksma_generate_whole(&spec, seed, NULL, 2, &p));
            assert_true(least_distance(&p) >= distances[i] * (1 - 1e-12));
            koksma_points_fini(&p);
        }
    }
}

/* Sets of more than 128 x 128 cells are thrown tile by tile, here 2 x 2 tiles of 65 x 65 cells. Points are as many
   near the tiles' borders as elsewhere, and as many as on grids of one tile. If darts did not wait for earlier ones
   that wait, there would be 6 % fewer. */
TEST_CASE(tiles_leave_no_trace)
{
    enum { SETS = 24, SIDE = 65, CELLS = 2 * SIDE };
    const double d = 0.0109, fraction = 1 - (SIDE - 4.0) * (SIDE - 4.0) / SIDE / SIDE;
    double sum = 0, squares = 0, points = 0;
    koksma_spec spec;
    assert_ok(koksma_pattern_spec("poisson-disk-maximal:d=0.0109", &spec));
    for (uint64_t seed = 0; seed < SETS; seed++) {
        koksma_points p;
        double border = 0;
        assert_ok(koksma_generate_whole(&spec, seed, NULL, 2, &p));
        assert_true(least_distance(&p) >= d * (1 - 1e-12));
        for (size_t i = 0; i < p.n; i++) {
            const int x = (int)(CELLS * p.xs[2 * i]) % SIDE, y = (int)(CELLS * p.xs[2 * i + 1]) % SIDE;
            border += x < 2 || x >= SIDE - 2 || y < 2 || y >= SIDE - 2;
        }
        const double ratio = border / (double)p.n / fraction;
        sum += ratio / SETS;
        squares += ratio * ratio / SETS;
        points += (double)p.n / SETS;
        koksma_points_fini(&p);
    }
    assert_near(sum, 1, 4 * sqrt((squares - sum * sum) / (SETS - 1)));
    assert_near(points, 0.6965 / d / d, 0.002 * points);
}

/* Darts at a grid of several tiles stop at the n-th of a round by time, wherever it is. */
TEST_CASE(tiles_end_at_n)
{
    static const char *const specs[] = {"dart-throwing", "dart-throwing:f=0.5", "poisson-disk-maximal"};
    for (size_t i = 0; i < sizeof specs / sizeof *specs; i++) {
        koksma_points p = test_points(specs[i], 12345, 2, 9);
        double quarter = 0;
        const double f = least_distance(&p) / koksma__packing_distance(p.n, 2, true);
        assert_true(f >= (i == 0 ? 0.75 : i == 1 ? 0.5 : 0.73) * (1 - 1e-12));
        for (size_t k = 0; k < p.n; k++) {
            quarter += p.xs[2 * k] < 0.5 && p.xs[2 * k + 1] < 0.5;
        }
        assert_near(quarter, 12345 / 4.0, 4 * sqrt(12345 * 3 / 16.0));
        koksma_points_fini(&p);
    }
}

TEST_CASE(fractions_of_the_densest)
{
    static const double fractions[] = {0.01, 0.1, 0.39, 0.4, 0.7};
    static const size_t counts[] = {1, 2, 3, 10, 1000, 20000};
    for (size_t i = 0; i < sizeof fractions / sizeof *fractions; i++) {
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            char text[64];
            snprintf(text, sizeof text, "dart-throwing:f=%g", fractions[i]);
            koksma_points p = test_points(text, counts[c], 2, 5);
            assert_true(counts[c] == 1 || least_distance(&p) >= fractions[i] * (1 - 1e-12) *
                                                                    koksma__packing_distance(counts[c], 2, true));
            koksma_points_fini(&p);
        }
    }
}
