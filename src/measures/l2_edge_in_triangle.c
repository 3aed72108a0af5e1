/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-edge-in-triangle: the points are mapped to an equilateral triangle; the root mean square, over isotropic random
 * lines that hit it, of the difference between the share of points on a side and its share of the area.
 *
 * Formula: with side 1, a line separates x and y with probability 2|x - y|/3 (Cauchy-Crofton), so the square is
 * (2/3) ((1/n) sum P(x_i) - (1/n^2) sum_{i<j} |x_i - x_j| - C/2); P, the mean distance of x from the triangle, is a
 * sum over the sides of (h/6)(t sqrt(h^2 + t^2) + h^2 asinh(t/h)) between their ends, over the area; C = (4 + 3 ln
 * 3)/20. Source: Santalo 1976 for the line measure; Alexander 1990 for the energy. Known exactly: random points, the
 * mean of the square is C/(3n). Limits: sums are compensated; the square is good to about 1e-16.
 */
#include <math.h>

#include "measures/measures.h"
#include "measures/parts/energy.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const koksma__energy energy = {koksma__triangle_potential, NULL, KOKSMA__TRIANGLE_SELF, 2.0 / 3};
    koksma__warped w;
    koksma_status status = koksma__warped_init(&w, points, koksma__warps_to_triangle, args->params[0]);
    if (!status) {
        for (size_t i = 0; i < w.n; i++) {
            w.xs[i] += w.xs[w.n + i] / 2;
            w.xs[w.n + i] *= sqrt(0.75);
        }
        status = koksma__energy_measure(&w, &energy, args->run, out);
    }
    koksma__warped_fini(&w);
    return status;
}

static const koksma_param params[] = {KOKSMA__WARP_PARAM(koksma__warps_to_triangle, 1), {0}};

const koksma_measure koksma__measure_l2_edge_in_triangle = {
    .name = "l2-edge-in-triangle",
    .title = "L2 over lines on the points mapped to an equilateral triangle",
    .cite = "santalo1976 alexander1990 turk1990",
    .cost = "n^2",
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
};
