/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The L2 discrepancies of boxes, one table row for each. Each discrepancy is the norm of the signed measure (points -
 * volume) under a kernel K; its square is
 *
 *     c^d - (2/n) sum_i prod_k a(x_ik) + (1/n^2) sum_ij prod_k K(x_ik, x_jk),
 *     a(u) = int_0^1 K(u, v) dv,  c = int_0^1 a(u) du.
 *
 * The discrepancies differ only in the kernel K, whose coefficients are in the table row (see
 * measures/l2/l2.h); l2/l2_range.c chooses the method by n and dim. Limits: the three terms cancel. In one
 * and two dimensions the sums are exact or have 106 bits, and the relative error of the value is 1e-11 for 10^6
 * points. In more dimensions the error of the square is about 1e-16 times its terms (l2-star: 1e-17).
 */
#include "measures/l2/l2.h"
#include "measures/measures.h"

/* Defines koksma__measure_l2_KIND: its title and citations, whether it is a measure on the torus, and c12, a24, g, q
   and r of its kernel. */
#define L2(kind, title_, cite_, torus_, c12_, ...)                                                                   \
    const koksma__l2_row koksma__l2_##kind = {.name = "l2-" #kind, .c12 = (c12_), __VA_ARGS__};                      \
    static koksma_status eval_##kind(const koksma_points *points, const koksma_args *args, koksma_value *out)        \
    {                                                                                                                \
        return koksma__l2(&koksma__l2_##kind, points, args->run, out);                                               \
    }                                                                                                                \
    static koksma_status gradient_##kind(const koksma_points *points, const koksma_args *args, double *square,       \
                                         double *gradient)                                                           \
    {                                                                                                                \
        return koksma__l2_gradient(&koksma__l2_##kind, points, args->run, square, gradient);                         \
    }                                                                                                                \
    const koksma_measure koksma__measure_l2_##kind = {                                                               \
        .name = "l2-" #kind,                                                                                         \
        .title = (title_),                                                                                           \
        .cite = (cite_),                                                                                             \
        .cost = "n log n in 1D and 2D, n log^(d-1) n in 3D and 4D, else n^2 d",                                      \
        .family = KOKSMA_FAMILY_BOXES,                                                                               \
        .min_dim = 1,                                                                                                \
        .max_dim = KOKSMA_MAX_DIM,                                                                                   \
        .eval = eval_##kind,                                                                                         \
        .on_torus = (torus_),                                                                                        \
        .gradient = gradient_##kind,                                                                                 \
    }

/*
 * l2-star: the root mean square, over all boxes [0,y) with a corner at the origin, of the difference between the
 * share of points in the box and its volume. The value is S in Shirley 1991, and T with the L2 norm in Mitchell 1992.
 *
 * Formula: S^2 = 3^-d - (2/n) sum_i prod_k (1 - x_ik^2)/2 + (1/n^2) sum_ij prod_k (1 - max(x_ik, x_jk)).
 * Source: Warnock 1972; Shirley 1991, section 5.5.7; Mitchell 1992, section 2; in O(n log n) after Heinrich 1996.
 * Known exactly: one point at the centre of the unit square, S^2 = 23/288; random points, E(S^2) = (2^-d - 3^-d)/n; m
 * x m jittered, E(S^2) = ((m-1)/6 + 5/36)/m^4; 4 x 4 centres, S^2 = 1/9 - 2 (43/128)^2 + (11/32)^2.
 */
L2(star, "L2 star discrepancy (root mean square over anchored boxes; scipy's L2-star)",
   "warnock1972 zaremba1968 heinrich1996 shirley1991 mitchell1992", false, 4, .a24 = {9, -12, -12, 0},
   .g = {0.25, -0.5, 0, 0}, .q = -0.5, .r = 0);

/*
 * l2-extreme: the root of the integral, over all boxes [lo, hi) with lo < hi in every coordinate, of the squared
 * difference between the share of points in the box and its volume. The value multiplied by 2^(d/2) is the root mean
 * square over these boxes.
 *
 * Formula: 12^-d - (2/n) sum_i prod_k x(1-x)/2 + (1/n^2) sum_ij prod_k (1 - max) min, where x, max and min are taken
 * in coordinate k.
 * Source: Morokoff and Caflisch 1994, who call it T_N.
 * Known exactly: one point at the centre of the unit square, value^2 = 11/288; random points, E(value^2) = (6^-d -
 * 12^-d)/n.
 */
L2(extreme, "L2 discrepancy over all boxes [lo, hi): root of the integral, not of the mean",
   "morokoff1994 hickernell1998", false, 1, .a24 = {3, 0, -12, 0}, .g = {0.125, 0, -0.5, 0}, .q = -0.5, .r = 0.5);

/*
 * l2-periodic: the root mean square, over boxes on the torus whose start and length in each coordinate are uniform,
 * of the difference between the share of points in the box and its volume. Shifting all points on the torus does not
 * change the value.
 *
 * Formula: -(3^-d) + (1/n^2) sum_ij prod_k (1/2 - t + t^2), t = |x_ik - x_jk|.
 * Source: Lev 1995; Hinrichs, Kritzinger and Pillichshammer 2020, who call it periodic.
 * Known exactly: one point in the unit square, value^2 = 1/4 - 1/9 = 5/36; random points, E(value^2) = (2^-d -
 * 3^-d)/n.
 */
L2(periodic, "L2 discrepancy over boxes on the torus (root mean square)", "lev1995 hinrichs2020", true, 4,
   .a24 = {8, 0, 0, 0}, .g = {0.25, 0, 0, 0}, .q = -1, .r = 1);

/*
 * l2-wraparound: l2-periodic over all projections: its square is the sum, over the non-empty sets of coordinates, of
 * the square of l2-periodic of the points in these coordinates.
 *
 * Formula: -(4/3)^d + (1/n^2) sum_ij prod_k (3/2 - t + t^2), t = |x_ik - x_jk|.
 * Source: Hickernell 1998. SciPy's qmc.discrepancy(method='WD') is the square.
 * Known exactly: one point in the unit square, value^2 = 9/4 - 16/9 = 17/36.
 */
L2(wraparound, "wrap-around L2 discrepancy (the root; scipy's WD is its square)", "hickernell1998", true, 16,
   .a24 = {32, 0, 0, 0}, .g = {0.75, 0, 0, 0}, .q = -1, .r = 1);

/*
 * l2-modified: l2-star over all projections: its square is the sum, over the non-empty sets of coordinates, of the
 * square of l2-star of the points in these coordinates. The value is the worst-case integration error over functions
 * whose mixed first derivatives, anchored at 1, have norm 1.
 *
 * Formula: (4/3)^d - (2/n) sum_i prod_k (3 - x_ik^2)/2 + (1/n^2) sum_ij prod_k (2 - max(x_ik, x_jk)).
 * Source: Hickernell 1998.
 * Known exactly: one point at the centre of [0,1), value^2 = 1/12.
 */
L2(modified, "modified L2 discrepancy (root of the sum of squares of L2 star over all projections)", "hickernell1998",
   false, 16, .a24 = {33, -12, -12, 0}, .g = {0.75, -0.5, 0, 0}, .q = -0.5, .r = 0);

/*
 * l2-centered: like l2-modified, but each box extends from a point to the nearest corner of the cube instead of to
 * the origin. Reflecting the points about any plane x_k = 1/2 does not change the value.
 *
 * Formula: (13/12)^d - (2/n) sum_i prod_k (1 + h/2 - h^2/2) + (1/n^2) sum_ij prod_k (1 + (h_i + h_j - t)/2), with h =
 * |x_ik - 1/2|, t = |x_ik - x_jk|.
 * Source: Hickernell 1998. SciPy's method='CD' is the square.
 * Known exactly: one point at the centre of the unit square, value^2 = 25/144.
 */
L2(centered, "centered L2 discrepancy (the root; scipy's CD is its square)", "hickernell1998", false, 13,
   .a24 = {24, 0, -12, 12}, .g = {0.5, 0, 0, 0.5}, .q = -0.5, .r = 0);

/*
 * l2-mixture: a mixture of l2-centered and l2-wraparound, with equal parts of boxes that extend from a point to the
 * nearest corner and of boxes that wrap around.
 *
 * Formula: (19/12)^d - (2/n) sum_i prod_k (5/3 - h/4 - h^2/4)
 *          + (1/n^2) sum_ij prod_k (15/8 - (h_i + h_j)/4 - 3t/4 + t^2/2), h = |x_ik - 1/2|, t = |x_ik - x_jk|.
 * Source: Zhou, Fang and Ning 2013. SciPy's method='MD' is the square.
 * Known exactly: one point at the centre of [0,1), value^2 = 19/12 - 10/3 + 15/8 = 1/8.
 */
L2(mixture, "mixture L2 discrepancy (the root; scipy's MD is its square)", "zhou2013", false, 19,
   .a24 = {40, 0, -6, -6}, .g = {0.9375, 0, 0, -0.25}, .q = -0.75, .r = 0.5);

/*
 * l2-symmetric: l2-star averaged over all corners of the cube as anchors: its square is 4^d times the mean, over the
 * 2^d corners, of the square of l2-star with this corner as the anchor.
 *
 * Formula: (4/3)^d - (2/n) sum_i prod_k (1 + 2x - 2x^2) + (1/n^2) sum_ij prod_k 2 (1 - t), t = |x_ik - x_jk|.
 * Source: Hickernell 1998.
 * Known exactly: one point at the centre of the unit square, value^2 = 23/18.
 */
L2(symmetric, "symmetric L2 discrepancy (2^d times the root mean square over all corners as anchors)",
   "hickernell1998", false, 16, .a24 = {36, 0, -48, 0}, .g = {1, 0, 0, 0}, .q = -2, .r = 0);

const koksma__l2_row *koksma__l2_row_of(const koksma_measure *measure)
{
    static const struct {
        const koksma_measure *measure;
        const koksma__l2_row *row;
    } rows[] = {
#undef MEASURE_OF
#define MEASURE(name)
#define MEASURE_OF(name, file) {&koksma__measure_##name, &koksma__##name},
#include "measures/measures.def"
#undef MEASURE
#undef MEASURE_OF
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (rows[i].measure == measure) {
            return rows[i].row;
        }
    }
    return NULL;
}
