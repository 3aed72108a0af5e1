/* SPDX-License-Identifier: Apache-2.0 */
/* Our direction numbers, sobol:numbers=groups: the columns follow from primitive polynomials in order and odd initial
   numbers; coordinates are permutations; and t of the consecutive pairs and quadruples is what the search reached and
   below that of Joe & Kuo's numbers. */
#include <string.h>

#include "claims/claims.h"
#include "patterns/nets/nets.h"

enum { DIM = 128, LEAST_M = 4, MOST_M = 12, MOST_N = 1 << MOST_M };

/* The order of x modulo the polynomial is 2^degree - 1: x generates all nonzero residues. */
static bool is_primitive(unsigned polynomial, int degree)
{
    unsigned power = 1, order = 0;
    do {
        power <<= 1;
        power ^= power >> degree & 1 ? polynomial : 0;
    } while (++order < 1u << degree && power != 1);
    return order == (1u << degree) - 1;
}

static int degree_of(unsigned polynomial)
{
    int degree = 0;
    while (polynomial >> (degree + 1)) {
        degree++;
    }
    return degree;
}

/* Column i is m_i 2^(32 - i) with m_i = 2 a_1 m_(i-1) ^ ... ^ 2^s m_(i-s) ^ m_(i-s), in whole numbers of 64 bits. */
TEST_CASE(columns_follow_from_primitive_polynomials)
{
    unsigned polynomial = 1;
    assert_int_equal(koksma__sobol_dim(KOKSMA__GROUPS), DIM);
    for (int k = 1; k < DIM; k++) {
        const uint32_t *columns = koksma__sobol_directions(k, KOKSMA__GROUPS);
        uint64_t m[33];
        int degree;
        do {
            polynomial += 2;
            degree = degree_of(polynomial);
        } while (!is_primitive(polynomial, degree));
        for (int i = 1; i <= 32; i++) {
            m[i] = columns[i - 1] >> (32 - i);
            assert_int_equal(m[i] << (32 - i), columns[i - 1]);
            assert_true(m[i] % 2 == 1 && m[i] < (uint64_t)1 << i);
            if (i > degree) {
                uint64_t expected = m[i - degree];
                for (int j = 1; j <= degree; j++) {
                    expected ^= (polynomial >> (degree - j) & 1 ? m[i - j] : 0) << j;
                }
                assert_int_equal(m[i], expected);
            }
        }
    }
}

TEST_CASE(coordinates_are_permutations)
{
    static unsigned char seen[MOST_N];
    koksma_points points = test_points("sobol:numbers=groups", MOST_N, DIM, 0);
    for (size_t n = 1; n <= MOST_N; n *= 2) {
        for (size_t k = 0; k < DIM; k++) {
            memset(seen, 0, n);
            for (size_t i = 0; i < n; i++) {
                const size_t cell = (size_t)(points.xs[i * DIM + k] * (double)n);
                assert_true(points.xs[i * DIM + k] == (double)cell / (double)n && !seen[cell]);
                seen[cell] = 1;
            }
        }
    }
    koksma_points_fini(&points);
}

static void sum_of_t(const koksma_points *points, int m, int dims, int *sum, int *worst)
{
    *sum = *worst = 0;
    for (size_t first = 0; first < (size_t)points->dim; first += (size_t)dims) {
        koksma_points group = projection_of(points, (int)first, dims);
        group.n = (size_t)1 << m;
        const int t = (int)test_measure("t-value", &group).value;
        koksma_points_fini(&group);
        *sum += t;
        *worst = t > *worst ? t : *worst;
    }
}

/* Over the 64 pairs and 32 quadruples of 128 dimensions, for 2^4 .. 2^12 points. */
TEST_CASE(groups_have_small_t)
{
    static const struct {
        int dims, sums[MOST_M - LEAST_M + 1], worst[MOST_M - LEAST_M + 1];
    } cases[] = {{2, {36, 43, 50, 56, 64, 64, 68, 90, 94}, {2, 2, 2, 2, 2, 2, 3, 3, 3}},
                 {4, {56, 65, 81, 93, 99, 114, 119, 129, 137}, {3, 3, 4, 4, 4, 5, 5, 6, 5}}};
    koksma_points ours = test_points("sobol:numbers=groups", MOST_N, DIM, 0);
    koksma_points theirs = test_points("sobol", MOST_N, DIM, 0);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        for (int m = LEAST_M; m <= MOST_M; m++) {
            int sum, worst, their_sum, their_worst;
            sum_of_t(&ours, m, cases[c].dims, &sum, &worst);
            sum_of_t(&theirs, m, cases[c].dims, &their_sum, &their_worst);
            assert_int_equal(sum, cases[c].sums[m - LEAST_M]);
            assert_int_equal(worst, cases[c].worst[m - LEAST_M]);
            assert_true(sum < their_sum && worst <= their_worst);
        }
    }
    koksma_points_fini(&ours);
    koksma_points_fini(&theirs);
}
