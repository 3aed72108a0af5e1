/* SPDX-License-Identifier: Apache-2.0 */
/* every-n: the rule that continues its tables, and how even its prefixes are. */
#include <koksma/optimise.h>

#include <math.h>
#include <string.h>

#include "test.h"

static double measured(const char *measure, const koksma_points *points, size_t n)
{
    return test_measure(measure, &(koksma_points){n, points->dim, points->xs}).value;
}

/* Block b is block 0 shifted by b (1/g, 1/g^2, ..) on the torus, g^(dim+1) = g + 1. */
TEST_CASE(blocks_are_shifted_by_the_additive_recurrence)
{
    for (int dim = 2; dim <= 4; dim++) {
        koksma_points points = test_points("every-n", 5000, dim, 0);
        double g = 1.3;
        for (int s = 0; s < 100; s++) {
            g -= (pow(g, dim + 1) - g - 1) / ((dim + 1) * pow(g, dim) - 1);
        }
        for (size_t c = 0; c < points.n * (size_t)dim; c++) {
            const size_t i = c / (size_t)dim, k = c % (size_t)dim;
            const double first = points.xs[i % 1024 * (size_t)dim + k],
                         moved = (double)(i / 1024) * pow(g, -(double)k - 1);
            const double gap = points.xs[c] - first - moved;
            assert_true(fabs(gap - nearbyint(gap)) < 1e-13);
        }
        koksma_points_fini(&points);
    }
}

/* The aim of the search in the plane: the price of being progressive, over n = 8 .. 128. */
TEST_CASE(prefixes_are_near_the_records)
{
    koksma_points points = test_points("every-n", 128, 2, 0);
    const koksma_record *r;
    double sum = 0, worst = 0, count = 0;
    for (size_t i = 0; (r = koksma_record_at(i)); i++) {
        if (!strcmp(r->measure, "star") && r->dim == 2 && r->n >= 8 && r->n <= 128) {
            const double ratio = measured("star", &points, r->n) / r->value;
            sum += ratio;
            count++;
            worst = fmax(worst, ratio);
        }
    }
    assert_int_equal(count, 121);
    assert_true(sum / count < 1.8);
    assert_true(worst < 2.3);
    koksma_points_fini(&points);
}

/* In each number of dimensions the prefixes have smaller L2 star discrepancies than those of Sobol' points on average, and
   at most numbers of points. */
TEST_CASE(prefixes_have_less_discrepancy_than_sobol)
{
    for (int dim = 2; dim <= 4; dim++) {
        koksma_points points = test_points("every-n", 1024, dim, 0), sobol = test_points("sobol", 1024, dim, 0);
        double logs = 0;
        int better = 0, count = 0;
        for (size_t n = 8; n <= 1024; n += 1 + n / 8, count++) {
            const double ratio = measured("l2-star", &points, n) / measured("l2-star", &sobol, n);
            logs += log(ratio);
            better += ratio < 1;
        }
        assert_true(logs / count < log(0.9));
        assert_true(better * 10 > count * 9);
        koksma_points_fini(&points);
        koksma_points_fini(&sobol);
    }
}
