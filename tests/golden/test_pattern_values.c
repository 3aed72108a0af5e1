/* SPDX-License-Identifier: Apache-2.0 */
/* Points and mean values of patterns that are known in closed form; values of measures are in values.txt. */
#include <koksma/verify.h>

#include <string.h>

#include "core/random.h"
#include "patterns/nets/nets.h"
#include "test.h"

TEST_CASE(first_points)
{
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

/* The points of Kollig & Keller's function, and n D* = m / 5 + O(1) for n = 2^m: 1.30 to 1.45 more up to m = 13. */
TEST_CASE(larcher_pillichshammers_net)
{
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
TEST_CASE(mapped_radicals_stay_below_one)
{
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
TEST_CASE(the_furthest_candidate_is_taken)
{
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
TEST_CASE(few_points_repel_each_other_all_around)
{
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
