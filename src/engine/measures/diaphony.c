/* SPDX-License-Identifier: Apache-2.0 */
/*
 * diaphony: the weighted norm, over all frequencies, of the difference between the trigonometric sums of the points
 * and those of the uniform distribution.
 *
 * Formula: F^2 = sum over h in Z^d, h != 0, of |(1/n) sum_i exp(2 pi i h.x_i)|^2 / prod_k max(1, |h_k|)^2
 *              = (1/n^2) sum_ij prod_k (1 + 2 pi^2 (t^2 - t + 1/6)) - 1,  t = |x_ik - x_jk|.
 * Source: Zinterhof 1976.
 * Known exactly: one point, F^2 = (1 + pi^2/3)^d - 1; m points i/m on the line, F = pi/(m sqrt 3).
 * Limits: the terms are near 1 and cancel, so the square has an absolute error of about 1e-15. In one and two
 * dimensions with 1,024 points or more the sums are computed with 106 bits, and the relative error of the square is
 * 1e-11. With about 970 dimensions or more the measure fails, because its square is beyond the range of doubles.
 */
#include <math.h>

#include "core/elementary.h"
#include "measures/l2/l2.h"
#include "measures/measures.h"

static koksma_status gradient(const koksma_points *points, const koksma_args *args, double *square, double *out)
{
    static const double q = 2 * M_PI * M_PI;
    const koksma__l2_row row = {12, {24, 0, 0, 0}, {(1 + q / 6) / 2, 0, 0, 0}, -q, q, "diaphony"};
    return koksma__l2_gradient(&row, points, args->run, square, out);
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    /* The kernel is K = 1 + q (1/6 - t + t^2) with q = 2 pi^2. The sorting method evaluates 6 K / q instead of K,
       because the coefficients of 6 K / q are exact in doubles and no digits are lost to cancellation. */
    static const double q = 2 * M_PI * M_PI;
    const koksma__l2_row row = {12, {24, 0, 0, 0}, {(1 + q / 6) / 2, 0, 0, 0}, -q, q, "diaphony"};
    const double one = (1 + 6 / q) - 1;
    const koksma__l2_row divided = {12 * one, {24 * one, 0, 0, 0}, {(one + 1) / 2, 0, 0, 0}, -6, 6, "diaphony"};
    if (!(points->dim <= 2 && points->n >= 1024 && points->n < (size_t)1 << 28)) {
        return koksma__l2_value_by_pairs(&row, points, args->run, out);
    }
    const koksma_status status = koksma__l2_by_sorting(&divided, points, args->run, &out->square);
    out->square = koksma__not_below_0(out->square * koksma__pow(q / 6, points->dim));
    out->value = sqrt(out->square);
    return status;
}

const koksma_measure koksma__measure_diaphony = {
    .name = "diaphony",
    .title = "diaphony (root of the weighted sum of squared trigonometric sums)",
    .cite = "zinterhof1976",
    .cost = "n log n in 2D, n^2 d",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .eval = eval,
    .on_torus = true,
    .gradient = gradient,
};
