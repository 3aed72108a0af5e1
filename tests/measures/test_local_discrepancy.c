/* SPDX-License-Identifier: Apache-2.0 */
/* The local discrepancy against its definition: by counting, and as what the star discrepancies are made of. */
#include <koksma/koksma.h>

#include <math.h>
#include <stdlib.h>

#include "test.h"

static double counted(const koksma_points *points, const double *x)
{
    double volume = 1, inside = 0;
    for (int k = 0; k < points->dim; k++) {
        volume *= x[k];
    }
    for (size_t i = 0; i < points->n; i++) {
        double in = 1;
        for (int k = 0; k < points->dim; k++) {
            in *= points->xs[i * (size_t)points->dim + (size_t)k] < x[k];
        }
        inside += in;
    }
    return inside / (double)points->n - volume;
}

TEST_CASE(grids_are_corners_counted_one_by_one)
{
    enum { SIDE = 23 };
    static double grid[SIDE * SIDE];
    static const char *const patterns[] = {"random", "regular", "zaremba", "hammersley"};
    for (size_t p = 0; p < sizeof patterns / sizeof *patterns; p++) {
        koksma_points points = test_points(patterns[p], 64, 2, 5);
        assert_int_equal(koksma_local_discrepancy_grid(&points, SIDE, grid), KOKSMA_OK);
        for (int j = 0; j < SIDE; j++) {
            for (int k = 0; k < SIDE; k++) {
                const double x[2] = {(k + 0.5) / SIDE, (j + 0.5) / SIDE};
                double at;
                assert_int_equal(koksma_local_discrepancy(&points, x, &at), KOKSMA_OK);
                assert_near(at, counted(&points, x), 1e-15);
                assert_near(grid[j * SIDE + k], at, 1e-15);
            }
        }
        koksma_points_fini(&points);
    }
}

/* |D| never exceeds the star discrepancy, and its mean square over a fine grid is that of l2-star. */
TEST_CASE(star_discrepancies_are_its_supremum_and_mean_square)
{
    enum { SIDE = 1024 };
    koksma_spec star, l2;
    koksma_value supremum, mean_square;
    double *grid = malloc(sizeof(double) * SIDE * SIDE), largest = 0, sum = 0;
    assert_non_null(grid);
    assert_int_equal(koksma_measure_spec("star", &star), KOKSMA_OK);
    assert_int_equal(koksma_measure_spec("l2-star", &l2), KOKSMA_OK);
    koksma_points points = test_points("n-rooks", 32, 2, 1);
    assert_int_equal(koksma_evaluate(&star, &points, NULL, &supremum), KOKSMA_OK);
    assert_int_equal(koksma_evaluate(&l2, &points, NULL, &mean_square), KOKSMA_OK);
    assert_int_equal(koksma_local_discrepancy_grid(&points, SIDE, grid), KOKSMA_OK);
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        largest = fmax(largest, fabs(grid[i]));
        sum += grid[i] * grid[i];
    }
    assert_true(largest <= supremum.value + 1e-12 && largest > supremum.value - 3.0 / SIDE);
    assert_near(sqrt(sum / SIDE / SIDE), mean_square.value, 0.002 * mean_square.value);
    koksma_points_fini(&points);
    free(grid);
}

TEST_CASE(nonsense_is_refused)
{
    double out[4];
    const double x[2] = {0.5, 1.5};
    koksma_points plane = test_points("random", 4, 2, 0), space = test_points("random", 4, 3, 0);
    assert_int_equal(koksma_local_discrepancy(&plane, x, out), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_local_discrepancy(NULL, x, out), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_local_discrepancy(&plane, NULL, out), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_local_discrepancy_grid(&space, 2, out), KOKSMA_DIM);
    assert_int_equal(koksma_local_discrepancy_grid(&plane, 0, out), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_local_discrepancy_grid(&plane, KOKSMA_MAX_LOCAL_GRID + 1, out), KOKSMA_ARGUMENT);
    koksma_points_fini(&plane);
    koksma_points_fini(&space);
}
