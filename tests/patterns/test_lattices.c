/* SPDX-License-Identifier: Apache-2.0 */
/* The searched lattices: their multipliers against a search of all in long double, and that none comes twice.
   test_lattice_errors.c has more points. */
#include <stdlib.h>
#include <string.h>

#include "lattices.h"
#include "pattern_sets.h"

enum { MAX_DIM = 256 };

static bool is_among(size_t z, size_t n, const size_t *taken, int count)
{
    for (int k = 0; k < count; k++) {
        if (z == taken[k] || z == n - taken[k]) {
            return true;
        }
    }
    return false;
}

/* The sum over i > 0 of prod_k (1 + 3/4 B_2({i z_k / n})): a multiple of the error, but for a constant. */
static long double error_of(size_t n, const size_t *z, int dim)
{
    long double sum = 0;
    for (size_t i = 1; i < n; i++) {
        long double product = 1;
        for (int k = 0; k < dim; k++) {
            const long double x = (long double)(i * z[k] % n) / (long double)n;
            product *= 1 + 0.75L * (x * x - x + 1.0L / 6);
        }
        sum += product;
    }
    return sum;
}

/* In 256 dimensions the origin's term is 10^13, and all others together about n. */
TEST_CASE(powers_are_the_best)
{
    static const int dims[] = {2, 3, 5, 12, 60, 256};
    for (size_t n = 29; n <= 61; n += 16) {
        for (size_t d = 0; d < sizeof dims / sizeof *dims; d++) {
            size_t z[MAX_DIM], other[MAX_DIM] = {1};
            lattices_multipliers("korobov", n, dims[d], z);
            long double least = HUGE_VALL;
            for (size_t a = 1; a < n; a++) {
                for (int k = 1; k < dims[d]; k++) {
                    other[k] = other[k - 1] * a % n;
                }
                least = lattices_common_divisor(a, n) == 1 ? fminl(least, error_of(n, other, dims[d])) : least;
            }
            const double error = (double)error_of(n, z, dims[d]);
            assert_near(error, (double)least, 1e-12 * error);
        }
    }
}

/* The mean over i of those products, the origin's too, less 1 is the square of l2-wraparound over (4/3)^dim. */
TEST_CASE(error_is_wraparound)
{
    for (int dim = 1; dim <= 6; dim++) {
        size_t z[6];
        koksma_points points = test_points("lattice-rank1", 55, dim, 0);
        lattices_multipliers("lattice-rank1", 55, dim, z);
        const long double mean = (error_of(55, z, dim) + powl(1.125L, dim)) / 55;
        const double value = test_measure("l2-wraparound", &points).value;
        assert_near(value * value, (double)(powl(4.0L / 3, dim) * (mean - 1)), 1e-13);
        koksma_points_fini(&points);
    }
}

/* None comes twice, as itself or mirrored, while there are others: phi(n)/2 of them. No rule says so: with the
   weights of this criterion a diagonal is never the least bad. */
TEST_CASE(multipliers_are_distinct)
{
    static const struct {
        const char *pattern;
        size_t n;
        int dim, distinct;
    } cases[] = {
        {"lattice-rank1", 16, 12, 4},      {"lattice-rank1", 61, 60, 30},     {"lattice-rank1", 64, 256, 16},
        {"lattice-rank1", 256, 64, 64},    {"lattice-rank1", 1021, 256, 256}, {"lattice-rank1", 4096, 64, 64},
        {"lattice-rank1", 262144, 24, 24}, {"korobov", 61, 30, 30},           {"korobov", 256, 32, 32},
        {"korobov", 1021, 12, 12},         {"korobov", 1021, 64, 64},         {"korobov", 4096, 12, 12},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        size_t z[MAX_DIM];
        lattices_multipliers(cases[c].pattern, cases[c].n, cases[c].dim, z);
        for (int k = 0; k < cases[c].dim; k++) {
            const int first = k - k % cases[c].distinct;
            assert_that(!is_among(z[k], cases[c].n, z + first, k - first),
                        "%s, n = %zu: multiplier %zu comes again at %d", cases[c].pattern, cases[c].n, z[k], k);
        }
    }
}

/* The first 2^m points are {i z / 2^m}; none of the multipliers comes twice. */
TEST_CASE(embedded_lattices)
{
    const int dim = koksma_pattern_find("lattice-sequence")->max_dim;
    size_t z[MAX_DIM];
    lattices_sequence_multipliers(dim, z);
    for (int k = 0; k < dim; k++) {
        assert_false(is_among(z[k], 1 << 20, z, k));
    }
    for (size_t n = 1; n <= 1024; n *= 2) {
        koksma_points points = test_points("lattice-sequence", n, dim, 0);
        bool *seen = calloc(n, sizeof *seen);
        assert_non_null(seen);
        for (size_t p = 0; p < n; p++) {
            const double *x = points.xs + p * (size_t)dim;
            const size_t i = (size_t)(x[0] * (double)n);
            assert_false(seen[i]);
            seen[i] = true;
            for (int k = 0; k < dim; k++) {
                assert_true(x[k] == (double)(i * z[k] % n) / (double)n);
            }
        }
        free(seen);
        koksma_points_fini(&points);
    }
}

TEST_CASE(vectors_of_specs)
{
    koksma_points points = test_points("lattice-vector:1:182667:0:77", 55, 4, 0);
    static const size_t z[] = {1, 182667, 0, 77};
    for (size_t c = 0; c < 4 * 55; c++) {
        assert_true(points.xs[c] == (double)(c / 4 * z[c % 4] % 55) / 55);
    }
    koksma_points_fini(&points);
    static const char *const wrong[] = {":", "1:", "1::2", "x", "1:-2", "1: 2", "1;2", "4503599627370496"};
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
        char text[64];
        snprintf(text, sizeof text, "lattice-vector:%s", wrong[w]);
        assert_int_equal(status_of(text, 5, 1), KOKSMA_ARGUMENT);
    }
    assert_int_equal(status_of("lattice-vector:1:5", 5, 3), KOKSMA_DIM);
}

/* n P_2 from its definition: the sum over i > 0 of the elementary symmetric polynomials of 2 pi^2 B_2({i z_k / n}) up to
   degree `dim`, that of degree l times weights[l]. */
static long double error_of_weights(size_t n, const size_t *z, int dim, const double weights[9])
{
    const long double pi = acosl(-1);
    long double sum = 0;
    for (size_t i = 1; i < n; i++) {
        long double e[9] = {1};
        for (int k = 0; k < dim; k++) {
            const long double x = (long double)(i * z[k] % n) / (long double)n;
            for (int l = k + 1; l > 0; l--) {
                e[l] += 2 * pi * pi * (x * x - x + 1.0L / 6) * e[l - 1];
            }
        }
        for (int l = 1; l <= dim; l++) {
            sum += weights[l] * e[l];
        }
    }
    return sum;
}

/* Each component is the best of all: with the default weights, the powers of 3 / (8 pi^2), of all orders or of the first,
   and with those of Cools, Kuo & Nuyens 2006 by order, as LatNet Builder writes them (order-dependent:0:1,0.1,0.01):
   falling, equal, rising, and some 0. */
TEST_CASE(components_are_the_best)
{
    enum { DIM = 7 };
    static const double a = 0.0379954438, b = a * a;
    static const struct {
        const char *spec;
        double weights[9]; /* [l]: of projections of l coordinates */
    } cases[] = {{"lattice-rank1", {0, 1, a, b, a * b, b * b, a * b * b, b * b * b}},
                 {"lattice-rank1:order=2", {0, 1, a}},
                 {"lattice-rank1:order=3", {0, 1, a, b}},
                 {"lattice-rank1:order=3,gamma2=0.1,gamma3=0.01", {0, 1, 0.1, 0.01}},
                 {"lattice-rank1:order=4,gamma2=1,gamma3=1,gamma4=1", {0, 1, 1, 1, 1}},
                 {"lattice-rank1:order=2,gamma2=7.5", {0, 1, 7.5}},
                 {"lattice-rank1:order=3,gamma2=0.2,gamma3=5", {0, 1, 0.2, 5}},
                 {"lattice-rank1:order=4,gamma2=0.3,gamma3=0,gamma4=2", {0, 1, 0.3, 0, 2}}};
    for (size_t t = 0; t < sizeof cases / sizeof *cases; t++) {
        for (size_t n = 5; n <= (t ? test_repeats(101, 64) : 80); n += t == 0 && n < 40 ? 1 : n < 60 ? 11 : 7) {
            size_t z[DIM], other[DIM];
            lattices_multipliers(cases[t].spec, n, DIM, z);
            assert_int_equal(z[0], 1);
            for (int k = 1; k < DIM; k++) {
                long double least = HUGE_VALL;
                assert_int_equal(lattices_common_divisor(z[k], n), 1);
                memcpy(other, z, sizeof z);
                for (other[k] = 1; other[k] <= n / 2; other[k]++) {
                    least = lattices_common_divisor(other[k], n) == 1
                                ? fminl(least, error_of_weights(n, other, k + 1, cases[t].weights))
                                : least;
                }
                const double own = (double)error_of_weights(n, z, k + 1, cases[t].weights);
                assert_that(own <= (double)least + 1e-11 * fabs((double)least),
                            "%s, n = %zu: with %d coordinates %.15g, the best has %.15g", cases[t].spec, n, k + 1,
                            own, (double)least);
            }
        }
    }
    size_t all[5], limited[5];
    lattices_multipliers("lattice-rank1", 1021, 5, all);
    lattices_multipliers("lattice-rank1:order=8", 1021, 5, limited);
    assert_memory_equal(all, limited, sizeof all);
}

/* The defaults are powers of 3 / (8 pi^2), and weights without effect are refused. */
TEST_CASE(weights_of_orders)
{
    static const char *const wrong[] = {"gamma2=1", "order=2,gamma3=0.1", "order=3,gamma2=0,gamma3=0",
                                        "order=2,gamma2=0", "order=2,gamma2=-0.5"};
    size_t own[6], other[6];
    lattices_multipliers("lattice-rank1:order=3", 251, 6, own);
    lattices_multipliers("lattice-rank1:order=3,gamma2=0.037995443,gamma3=0.0014436537", 251, 6, other);
    assert_memory_equal(own, other, sizeof own);
    lattices_multipliers("lattice-rank1:order=3,gamma2=0.001,gamma3=50", 251, 6, other);
    assert_memory_not_equal(own, other, sizeof own);
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
        char text[64];
        snprintf(text, sizeof text, "lattice-rank1:%s", wrong[w]);
        assert_int_equal(status_of(text, 8, 3), KOKSMA_ARGUMENT);
    }
}
