/* SPDX-License-Identifier: Apache-2.0 */
/* Known discrepancies of patterns: Mitchell's (1992) table rows to all printed digits, and values of exact algorithms
   that were checked independently, to 1e-9. */
#include <koksma/verify.h>

#include <string.h>

#include "core/random.h"
#include "patterns/nets/nets.h"
#include "test.h"

typedef struct row {
    const char *pattern;
    size_t n;
    int dim;
    double star, l2_star; /* 0: not listed */
} row;

static const row rows[] = {
    {"hammersley", 16, 2, 0.171875000, 0.069290839},
    {"hammersley", 64, 2, 0.053710938, 0.021205108},
    {"hammersley", 256, 2, 0.016052246, 0.006277231},
    {"hammersley", 1024, 2, 0.004665375, 0.001813240},
    {"hammersley", 4096, 2, 0.001329184, 0.000514284},
    {"hammersley:offset=0.5", 16, 2, 0.152343750, 0.055013021},
    {"hammersley:offset=0.5", 256, 2, 0.014755249, 0.005349201},
    {"hammersley:offset=0.5", 4096, 2, 0.001247823, 0.000455385},
    {"halton", 16, 2, 0.201388889, 0.068247792},
    {"halton", 64, 2, 0.052083333, 0.016409436},
    {"halton", 256, 2, 0.018759645, 0.005306370},
    {"halton", 1024, 2, 0.006835938, 0.001645495},
    {"halton", 4096, 2, 0.001863484, 0.000426572},
    {"halton", 16, 3, 0, 0.079364407},
    {"halton", 128, 3, 0, 0.011277426},
    {"halton", 512, 3, 0, 0.003530837},
    {"sobol", 16, 2, 0.171875000, 0.047766231},
    {"sobol", 64, 2, 0.053710938, 0.012869850},
    {"sobol", 256, 2, 0.014587402, 0.003307470},
    {"sobol", 1024, 2, 0.004299164, 0.000867928},
    {"sobol", 4096, 2, 0.001329184, 0.000234269},
    {"r-sequence", 16, 2, 0.243477007, 0.067755940},
    {"r-sequence", 256, 2, 0.025818076, 0.006090249},
    {"r-sequence", 4096, 2, 0.002424837, 0.000481883},
    {"zaremba", 16, 2, 0.125000000, 0.035833915},
    {"zaremba", 64, 2, 0.037760417, 0.009575714},
    {"zaremba", 256, 2, 0.010986328, 0.002550635},
    {"zaremba", 1024, 2, 0.003138224, 0.000675254},
    {"zaremba", 4096, 2, 0.000882149, 0.000177757},
    {"larcher-pillichshammer", 16, 2, 0.140625000, 0.047945583},
    {"larcher-pillichshammer", 64, 2, 0.041015625, 0.012391156},
    {"larcher-pillichshammer", 256, 2, 0.011901855, 0.003216577},
    {"larcher-pillichshammer", 1024, 2, 0.003337860, 0.000834039},
    {"larcher-pillichshammer", 4096, 2, 0.000939131, 0.000215800},
    {"fibonacci", 13, 2, 0.165680473, 0.065208186},
    {"fibonacci", 55, 2, 0.044958678, 0.015151575},
    {"fibonacci", 233, 2, 0.012930796, 0.003963653},
    {"fibonacci", 987, 2, 0.003535321, 0.000922239},
    {"golden", 16, 2, 0.148558813, 0.052896127},
    {"golden", 256, 2, 0.012184473, 0.003488300},
    {"golden", 4096, 2, 0.000941220, 0.000230716},
};

static void discrepancies_are_known(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const row *r = &rows[i];
        koksma_points points = test_points(r->pattern, r->n, r->dim, 0);
        assert_near(test_measure("l2-star", &points).value, r->l2_star, 6e-10);
        if (r->star > 0) {
            assert_near(test_measure("star", &points).value, r->star, 6e-10);
        }
        koksma_points_fini(&points);
    }
}

/* Mitchell 1992, tables 1 and 2, the Zaremba rows. */
static void zaremba_has_mitchells_numbers(void **state)
{
    (void)state;
    static const struct {
        size_t n;
        int dim;
        double value, half_digit;
    } printed[] = {
        {16, 2, 0.0358, 5e-5}, {256, 2, 0.00255, 5e-6}, {1600, 2, 0.000438, 5e-7},
        {16, 3, 0.0393, 5e-5}, {256, 3, 0.00376, 5e-6}, {1600, 3, 0.000761, 5e-7},
    };
    for (size_t i = 0; i < sizeof printed / sizeof *printed; i++) {
        koksma_points points = test_points("zaremba", printed[i].n, printed[i].dim, 0);
        assert_near(test_measure("l2-star", &points).value, printed[i].value, printed[i].half_digit);
        koksma_points_fini(&points);
    }
}

static void first_points(void **state)
{
    (void)state;
    koksma_points p = test_points("zaremba", 4, 2, 0);
    const double third = 1.0 / 3, zaremba[] = {0, third, 0.25, 0.5 + third, 0.5, third - 0.25, 0.75, 0.25 + third};
    for (int i = 0; i < 8; i++) {
        assert_near(p.xs[i], zaremba[i], 1e-15);
    }
    koksma_points_fini(&p);
    p = test_points("halton", 7, 2, 0);
    const double halton[] = {0,       0,     0.5,     1.0 / 3, 0.25,    2.0 / 3, 0.75,
                             1.0 / 9, 0.125, 4.0 / 9, 0.625,   7.0 / 9, 0.375,   2.0 / 9};
    for (int i = 0; i < 14; i++) {
        assert_near(p.xs[i], halton[i], 0);
    }
    koksma_points_fini(&p);
    p = test_points("faure", 4, 3, 0);
    const double faure[] = {0, 0, 0, 1.0 / 3, 1.0 / 3, 1.0 / 3, 2.0 / 3, 2.0 / 3, 2.0 / 3, 1.0 / 9, 4.0 / 9, 7.0 / 9};
    for (int i = 0; i < 12; i++) {
        assert_near(p.xs[i], faure[i], 0);
    }
    koksma_points_fini(&p);
}

/* Mean squares of L2 star over 400 sets against the exact expectations. */
static void mean_squares_are_known(void **state)
{
    (void)state;
    static const struct {
        const char *pattern;
        size_t n;
        int dim;
        double mean_square;
    } known[] = {
        {"random", 16, 2, (0.25 - 1.0 / 9) / 16},
        {"jittered", 16, 2, (3.0 / 6 + 5.0 / 36) / 256},
        {"n-rooks", 16, 2, (16 + 5 - 1.0 / 16) / (36.0 * 256)},
        {"poisson-time", 16, 3, (9.0 / 24 + 15.0 / 36 + 19.0 / 216) / 256},
        {"latin-hypercube", 25, 2, (25 + 5 - 1.0 / 25) / (36.0 * 625)},
    };
    enum { SETS = 400 };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        double sum = 0, squares = 0;
        for (uint64_t seed = 0; seed < SETS; seed++) {
            koksma_points points = test_points(known[i].pattern, known[i].n, known[i].dim, seed);
            const double s = test_measure("l2-star", &points).value, square = s * s;
            sum += square;
            squares += square * square;
            koksma_points_fini(&points);
        }
        const double mean = sum / SETS, error = sqrt((squares / SETS - mean * mean) / SETS);
        assert_near(mean, known[i].mean_square, 4 * error);
    }
}

/* The points of Kollig & Keller's function, and n D* = m / 5 + O(1) for n = 2^m: 1.30 to 1.45 more up to m = 13. */
static void larcher_pillichshammers_net(void **state)
{
    (void)state;
    for (uint32_t m = 1; m <= 13; m++) {
        const size_t n = (size_t)1 << m;
        koksma_points points = test_points("larcher-pillichshammer", n, 2, 0);
        for (uint32_t i = 0; i < n; i++) {
            uint32_t y = 0, v = 1u << 31;
            for (uint32_t rest = i; rest; rest >>= 1, v |= v >> 1) {
                y ^= rest & 1 ? v : 0;
            }
            assert_near(points.xs[2 * i], i / (double)n, 0);
            assert_near(points.xs[2 * i + 1], y * 0x1p-32, 0);
        }
        const double more = (double)n * test_measure("star", &points).value - m / 5.0;
        assert_true(more > 1.29 && more < 1.46);
        koksma_points_fini(&points);
    }
}

static uint32_t mirrored(const void *context, uint32_t base, int j, uint32_t a)
{
    (void)context, (void)j;
    return base - 1 - a;
}

/* The digits of 0 become base - 1 without end, whose value is 1; the largest that is below 1 stands for it. */
static void mapped_radicals_stay_below_one(void **state)
{
    (void)state;
    enum { BASES = 1111 };
    koksma__radicals r;
    assert_ok(koksma__radicals_init(&r, BASES, 3, mirrored, NULL));
    for (int k = 0; k < BASES; k++) {
        double xs[3];
        koksma__radical_column(&r.columns[k], 0, 3, xs);
        assert_true(xs[0] < 1 && xs[0] > 1 - 0x1p-36 && xs[1] < xs[0] && xs[1] > 0 && xs[2] < xs[0] && xs[2] > 0);
    }
    koksma__radicals_fini(&r);
}

/* In eight dimensions squares of distances go up to 2. */
static void the_furthest_candidate_is_taken(void **state)
{
    (void)state;
    enum { DIM = 8, N = 4 };
    for (uint64_t seed = 0; seed < 5; seed++) {
        koksma_points points = test_points("best-candidate:candidates=100", N, DIM, seed);
        for (size_t k = 1; k < N; k++) {
            double furthest = -1, best[DIM];
            for (size_t c = 0; c < 100 * k + 1; c++) {
                double x[DIM], nearest = INFINITY;
                for (uint32_t j = 0; j < DIM / 2; j++) {
                    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, (uint64_t)k << 24 | c, j, x + 2 * j);
                }
                for (size_t i = 0; i < k; i++) {
                    double square = 0;
                    for (size_t j = 0; j < DIM; j++) {
                        const double t = fabs(x[j] - points.xs[i * DIM + j]);
                        square += fmin(t, 1 - t) * fmin(t, 1 - t);
                    }
                    nearest = fmin(nearest, square);
                }
                if (nearest > furthest) {
                    furthest = nearest;
                    memcpy(best, x, sizeof best);
                }
            }
            for (size_t j = 0; j < DIM; j++) {
                assert_near(points.xs[k * DIM + j], best[j], 0);
            }
        }
        koksma_points_fini(&points);
    }
}

/* Two and five points on the torus are a square lattice at best (Dickinson et al. 2011), and these forces find it. */
static void few_points_repel_each_other_all_around(void **state)
{
    (void)state;
    static const struct {
        size_t n;
        double square;
    } best[] = {{2, 0.5}, {5, 0.2}};
    for (int i = 0; i < 2; i++) {
        for (uint64_t seed = 0; seed < 5; seed++) {
            koksma_points points = test_points("gaussian-blue-noise", best[i].n, 2, seed);
            double distance;
            assert_ok(koksma_smallest_distance(&points, true, NULL, &distance));
            assert_near(distance, sqrt(best[i].square), 1e-3);
            koksma_points_fini(&points);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(discrepancies_are_known),
        cmocka_unit_test(zaremba_has_mitchells_numbers),
        cmocka_unit_test(first_points),
        cmocka_unit_test(mean_squares_are_known),
        cmocka_unit_test(larcher_pillichshammers_net),
        cmocka_unit_test(the_furthest_candidate_is_taken),
        cmocka_unit_test(mapped_radicals_stay_below_one),
        cmocka_unit_test(few_points_repel_each_other_all_around),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
