/* SPDX-License-Identifier: Apache-2.0 */
/* min-distance and relative-radius in 2 dimensions and more: all pairs of points of every kind, lattices whose distances
   are known, and the densest packings by the determinants of their root lattices. */
#include <koksma/koksma.h>

#include "sets.h"
#include "test.h"

static double by_all_pairs(const koksma_points *p, bool torus)
{
    double least = HUGE_VAL;
    for (size_t i = 0; i < p->n; i++) {
        for (size_t j = 0; j < i; j++) {
            double sum = 0;
            for (size_t k = 0; k < (size_t)p->dim; k++) {
                double d = fabs(p->xs[i * (size_t)p->dim + k] - p->xs[j * (size_t)p->dim + k]);
                d = torus && d > 0.5 ? 1 - d : d;
                sum += d * d;
            }
            least = fmin(least, sqrt(sum));
        }
    }
    return least;
}

/* Root lattices with roots of length sqrt 2 have the centre density 2^(-dim/2) / sqrt(determinant): A2, D3, D4, D5, E6,
   E7, E8. */
static double packing_distance(size_t n, int dim)
{
    static const double determinants[] = {3, 4, 4, 4, 3, 2, 1};
    return 2 * pow(pow(2, -dim / 2.0) / sqrt(determinants[dim - 2]) / (double)n, 1.0 / dim);
}

TEST_CASE(distances_are_those_of_all_pairs)
{
    for (int t = 0; t < test_repeats(600, 120); t++) {
        const int dim = 2 + t % 9;
        const size_t n = 2 + (size_t)(t * t % 331);
        koksma_points p = sets_points(n, dim, t % SETS_KINDS, (uint64_t)t);
        const double on = by_all_pairs(&p, true), in = by_all_pairs(&p, false);
        assert_near(test_measure("min-distance", &p).value, on, 1e-15);
        assert_near(test_measure("min-distance:torus=0", &p).value, in, 1e-15);
        if (dim <= 8) {
            assert_near(test_measure("relative-radius", &p).value, on / packing_distance(n, dim), 1e-13);
            assert_near(test_measure("relative-radius:torus=0", &p).value, in / packing_distance(n, dim), 1e-13);
        } else {
            koksma_spec spec;
            koksma_value value;
            assert_ok(koksma_measure_spec("relative-radius", &spec));
            assert_int_equal(koksma_evaluate(&spec, &p, NULL, &value), KOKSMA_DIM);
        }
        koksma_points_fini(&p);
    }
}

/* Thousands of points, where most nodes of the tree are left out; and points in a corner, on a line, all at one place. */
TEST_CASE(many_points_too)
{
    static const char *const specs[] = {"random", "sobol", "halton"};
    for (int dim = 3; dim <= 6; dim++) {
        for (int s = 0; s < 3; s++) {
            koksma_points p = test_points(specs[s], test_repeats(3000, 1000), dim, (uint64_t)dim);
            for (int shape = 0; shape < 4; shape++) {
                assert_near(test_measure("min-distance", &p).value, by_all_pairs(&p, true), 1e-15);
                for (size_t c = 0; c < p.n * (size_t)dim; c++) {
                    p.xs[c] = shape == 0   ? p.xs[c] * p.xs[c] * p.xs[c]
                              : shape == 1 ? p.xs[c - c % (size_t)dim]
                                           : 0.25;
                }
            }
            koksma_points_fini(&p);
        }
    }
}

/* All points of (Z/m)^dim whose coordinates have the remainders modulo 2 of a linear code, from its generators (Conway &
   Sloane, construction A). m is even. */
static koksma_points of_code(int dim, const unsigned *generators, int count, size_t m)
{
    koksma_points p;
    size_t all = 1, n = 0;
    for (int k = 0; k < dim; k++) {
        all *= m;
    }
    assert_ok(koksma_points_init(&p, all >> (dim - count), dim));
    for (size_t i = 0; i < all; i++) {
        unsigned word = 0;
        size_t rest = i;
        bool in_code = false;
        for (int k = 0; k < dim; k++, rest /= m) {
            word |= (unsigned)(rest % m & 1) << k;
        }
        for (unsigned choice = 0; choice < 1u << count; choice++) {
            unsigned sum = 0;
            for (int g = 0; g < count; g++) {
                sum ^= choice >> g & 1 ? generators[g] : 0;
            }
            in_code = in_code || sum == word;
        }
        rest = i;
        for (int k = 0; k < dim && in_code; k++, rest /= m) {
            p.xs[n * (size_t)dim + (size_t)k] = (double)(rest % m) / (double)m;
        }
        n += in_code;
    }
    assert_int_equal(n, p.n);
    return p;
}

TEST_CASE(densest_lattices_have_one)
{
    static const unsigned even[] = {3, 6, 12, 24}; /* words of even weight */
    static const unsigned simplex[] = {0x55, 0x66, 0x78}, hamming[] = {0x55, 0x66, 0x78, 0xff};
    static const unsigned repeated[] = {15};
    const struct {
        int dim, count;
        const unsigned *generators;
        size_t m;
    } of[] = {{3, 2, even, 8}, {4, 1, repeated, 4}, {4, 3, even, 6},
              {5, 4, even, 4}, {7, 3, simplex, 4},  {8, 4, hamming, 4}};
    for (size_t c = 0; c < sizeof of / sizeof *of; c++) {
        koksma_points p = of_code(of[c].dim, of[c].generators, of[c].count, of[c].m);
        assert_near(test_measure("relative-radius", &p).value, 1, 1e-14);
        koksma_points_fini(&p);
    }
}
