/* SPDX-License-Identifier: Apache-2.0 */
/* Points of the torus in sorted cells: what is said to be near, against all points; the forces of gaussian-blue-noise
   from there, against the sum over all pairs by libm. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/torus_rows.h"
#include "core/vector.h"
#include "kernels/kernels.h"
#include "test.h"

static const size_t counts[] = {1, 2, 3, 5, 16, 37, 100, 257};
static const double radii[] = {0.003, 0.06, 0.1, 0.25, 0.37, 0.5};
enum { N_COUNTS = sizeof counts / sizeof *counts, N_RADII = sizeof radii / sizeof *radii };

/* Runs around (x, y): every point at most once, and each within the radius. */
static void assert_holds(const koksma__torus_rows *rows, const koksma_points *points, double x, double y,
                         double radius)
{
    int *seen = calloc(points->n, sizeof *seen);
    const size_t most = koksma__torus_rows_most(rows, radius);
    koksma__run_of_points *runs = malloc(most * sizeof *runs);
    assert_true(seen && runs);
    const size_t count = koksma__torus_rows_near(rows, x, y, radius, runs);
    assert_true(count <= most);
    for (size_t r = 0; r < count; r++) {
        for (uint32_t at = runs[r].first; at < runs[r].end; at++) {
            const uint32_t i = rows->order[at];
            assert_int_equal(seen[i]++, 0);
            assert_memory_equal(&rows->xs[at], &points->xs[2 * (size_t)i], sizeof(double));
            assert_memory_equal(&rows->ys[at], &points->xs[2 * (size_t)i + 1], sizeof(double));
        }
    }
    for (size_t i = 0; i < points->n; i++) {
        const double a = koksma__torus_difference(x, points->xs[2 * i]),
                     b = koksma__torus_difference(y, points->xs[2 * i + 1]);
        assert_true(seen[i] || a * a + b * b > radius * radius);
    }
    free(seen);
    free(runs);
}

TEST_CASE(all_within_the_radius)
{
    for (size_t c = 0; c < N_COUNTS; c++) {
        koksma_points points = test_points("random", counts[c], 2, c), places = test_points("random", 50, 2, 100 + c);
        koksma__torus_rows rows;
        assert_ok(koksma__torus_rows_init(&rows, counts[c], (size_t)ceil(sqrt((double)counts[c]))));
        koksma__torus_rows_sort(&rows, counts[c], points.xs, true);
        for (size_t r = 0; r < N_RADII; r++) {
            for (size_t i = 0; i < 50; i++) {
                const double *x = places.xs + 2 * i;
                assert_holds(&rows, &points, x[0], x[1], radii[r]);
                assert_holds(&rows, &points, floor(x[0] * rows.cells) / rows.cells, 0, radii[r]);
            }
        }
        koksma__torus_rows_fini(&rows);
        koksma_points_fini(&points);
        koksma_points_fini(&places);
    }
}

TEST_CASE(force_of_all_pairs)
{
    const double radius = 0.3, scale = -11 / (radius * radius);
    koksma_points points = test_points("random", 300, 2, 5);
    koksma__torus_rows rows;
    koksma__run_of_points runs[128];
    assert_ok(koksma__torus_rows_init(&rows, points.n, (size_t)ceil(sqrt((double)points.n))));
    koksma__torus_rows_sort(&rows, points.n, points.xs, true);
    assert_true(koksma__torus_rows_most(&rows, radius) <= 128);
    for (size_t i = 0; i < points.n; i++) {
        const double x = points.xs[2 * i], y = points.xs[2 * i + 1];
        double expected[2] = {0, 0}, force[2];
        for (size_t j = 0; j < points.n; j++) {
            const double a = koksma__torus_difference(x, points.xs[2 * j]),
                         b = koksma__torus_difference(y, points.xs[2 * j + 1]);
            const double w = a * a + b * b <= radius * radius ? exp(scale * (a * a + b * b)) : 0;
            expected[0] -= w * a;
            expected[1] -= w * b;
        }
        const size_t count = koksma__torus_rows_near(&rows, x, y, radius, runs);
        koksma__kernels()->gauss_force(count, &runs[0].first, rows.xs, rows.ys, x, y, scale, radius * radius, force);
        assert_near(force[0], expected[0], 1e-10);
        assert_near(force[1], expected[1], 1e-10);
    }
    koksma__torus_rows_fini(&rows);
    koksma_points_fini(&points);
}
