/* SPDX-License-Identifier: Apache-2.0 */
/* interlaced-sobol, from Dick's definition digit by digit, and the orders of its errors for a smooth integrand: 2 and 3
   where Sobol' has 1, and half an order more when scrambled. */
#include <stdlib.h>

#include "test.h"

static unsigned digit_of(double x, int digit)
{
    return (unsigned)(ldexp(x, digit) - 2 * floor(ldexp(x, digit - 1)));
}

TEST_CASE(digits_alternate)
{
    for (int order = 1; order <= 5; order++) {
        char text[64];
        snprintf(text, sizeof text, "interlaced-sobol:order=%d", order);
        koksma_points points = test_points(text, 300, 4, 0), base = test_points("sobol", 300, 4 * order, 0);
        for (size_t c = 0; c < 300 * 4; c++) {
            for (int digit = 1; digit <= 53; digit++) {
                const int r = (digit - 1) % order, l = (digit - 1) / order + 1;
                assert_int_equal(digit_of(points.xs[c], digit), digit_of(base.xs[c * (size_t)order + (size_t)r], l));
            }
        }
        koksma_points_fini(&points);
        koksma_points_fini(&base);
    }
}

/* prod_k (1 + exp(x_k) - e + 1), whose integral is 1. */
static double error_of(const char *text, size_t n, int dim, uint64_t seed)
{
    koksma_points points = test_points(text, n, dim, seed);
    long double mean = 0;
    for (size_t i = 0; i < n; i++) {
        long double product = 1;
        for (int k = 0; k < dim; k++) {
            product *= 1 + (expl(points.xs[i * (size_t)dim + (size_t)k]) - expl(1) + 1);
        }
        mean += (product - 1) / (long double)n;
    }
    koksma_points_fini(&points);
    return (double)mean;
}

static double rmse(const char *text, size_t n, int dim, int seeds)
{
    double square = 0;
    for (int s = 0; s < seeds; s++) {
        square += pow(error_of(text, n, dim, (uint64_t)s), 2) / seeds;
    }
    return sqrt(square);
}

/* The least squares slope from 2^5 to 2^13 points. In more dimensions powers of log n hide it for more points. */
TEST_CASE(errors_have_their_order)
{
    static const struct {
        const char *text;
        int dim, seeds;
        double least, most;
    } cases[] = {{"sobol", 1, 1, 0.95, 1.05},          {"interlaced-sobol:order=1", 2, 1, 0.9, 1.1},
                 {"interlaced-sobol", 1, 1, 1.9, 2.2}, {"interlaced-sobol:order=3", 1, 1, 2.8, 3.3},
                 {"interlaced-sobol", 2, 1, 1.8, 2.6}, {"interlaced-sobol:scramble=owen", 1, 16, 2.3, 2.7}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        double order = 0;
        for (int m = -4; m <= 4; m++) {
            order -= m * log2(rmse(cases[c].text, (size_t)1 << (9 + m), cases[c].dim, cases[c].seeds)) / 60;
        }
        assert_that(order >= cases[c].least && order <= cases[c].most, "%s, dim = %d: errors fall as n^-%.2f",
                    cases[c].text, cases[c].dim, order);
    }
}

/* Of each subset of the first order * m rows of one coordinate's generator matrix, the first row in bit 0: the sum of the
   rows, and the sum of the numbers of its `order` last rows, counted from 1: the weight of Dick 2008. */
static void weigh(const koksma_points *points, int k, int m, int order, uint32_t *sums, uint32_t *weights)
{
    const int rows = order * m;
    for (uint32_t set = 0; set < 1u << rows; set++) {
        sums[set] = weights[set] = 0;
        for (int row = rows, used = 0; row > 0; row--) {
            if (set >> (row - 1) & 1) {
                for (int c = 0; c < m; c++) { /* column c is point 2^c */
                    sums[set] ^= digit_of(points->xs[((size_t)1 << c) * (size_t)points->dim + (size_t)k], row) << c;
                }
                weights[set] += used++ < order ? (uint32_t)row : 0;
            }
        }
    }
}

/* The least t for which the first 2^m points are a digital (t, order, order * m x m, dim)-net: rows whose weights sum to at
   most order * m - t are independent. The least weight of a set of rows whose sum is 0 is one more. */
static int counted_t(const koksma_points *points, int m, int order)
{
    const size_t sets = (size_t)1 << (order * m);
    uint32_t *sums = malloc(2 * sizeof *sums * 2 * sets), *weights = sums + 2 * sets, least = UINT32_MAX;
    assert_non_null(sums);
    for (int k = 0; k < points->dim; k++) {
        weigh(points, k, m, order, sums + (size_t)k * sets, weights + (size_t)k * sets);
    }
    for (size_t a = 0; a < sets; a++) {
        for (size_t b = 0; b < (points->dim == 2 ? sets : 1); b++) {
            const uint32_t sum = sums[a] ^ (points->dim == 2 ? sums[sets + b] : 0);
            const uint32_t weight = weights[a] + (points->dim == 2 ? weights[sets + b] : 0);
            least = (a || b) && sum == 0 && weight < least ? weight : least;
        }
    }
    free(sums);
    const int t = order * m + 1 - (int)least;
    return t > 0 ? t : 0;
}

/* Interlacing a digital (t, m, order dim)-net gives a net of higher order (Dick 2008). Its t, as above, is at most order
   t + (order - 1) (dim order / 2 - 1): rows l_r of the coordinates r = 1 .. order become rows order (l_r - 1) + r of
   one, so that a dependent set of the weight W, the sum of its largest l_r, of which each net has W > m - t, has a
   weight of at least order W - (order - r) summed over all r and coordinates. */
TEST_CASE(nets_are_of_higher_order)
{
    static const struct {
        int order, dim, most;
    } rows[] = {{1, 2, 8}, {2, 1, 8}, {2, 2, 5}, {3, 1, 6}, {3, 2, 3}, {4, 1, 4}, {5, 1, 3}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const int order = rows[r].order, dim = rows[r].dim;
        char text[64];
        snprintf(text, sizeof text, "interlaced-sobol:order=%d", order);
        for (int m = 1; m <= rows[r].most; m++) {
            koksma_points points = test_points(text, (size_t)1 << m, dim, 0);
            koksma_points base = test_points("sobol", (size_t)1 << m, order * dim, 0);
            const int t = (int)test_measure("t-value", &base).value, found = counted_t(&points, m, order);
            const int most = order * t + (order - 1) * dim * order / 2 - (order - 1);
            assert_that(found <= most,
                        "order %d, %d dimensions, 2^%d points: t = %d, more than the %d of the theorem", order, dim,
                        m, found, most);
            koksma_points_fini(&points);
            koksma_points_fini(&base);
        }
    }
    /* Sobol' points are no such nets: 5 rows of small numbers are dependent */
    koksma_points points = test_points("sobol", 32, 2, 0);
    assert_true(counted_t(&points, 5, 2) > 2);
    koksma_points_fini(&points);
}
