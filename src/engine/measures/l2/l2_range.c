/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The value of an L2 discrepancy by the method that suits n and dim, which is chosen at the end, and by sums over pairs
 * in hundreds of dimensions, where terms may be beyond the range of doubles. With the formula and the letters of
 * l2_pairs.h, let M be the larger of c^d and max_i prod_k K(x_ik, x_ik). Then no term exceeds M: as K is positive
 * definite, |K(x, y)|^2 <= K(x, x) K(y, y) and a(x)^2 <= K(x, x) c (Cauchy and Schwarz). If M is far from 1, the
 * one-dimensional kernel is multiplied by a factor f near M^(-1/d) that has 5 bits, so that the products with the
 * coefficients in the table are exact. The sum is then f^d times the square, so its root is divided by f^(d/2). The
 * root has half the exponent of the square, so it is in the range of doubles in more dimensions.
 */
#include "measures/l2/l2.h"

#include <math.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"

/* Up to PLAIN_DIM dimensions every term of every L2 discrepancy is in the range of doubles. */
enum { PLAIN_DIM = 200, FAR_BITS = 900, GUARD_BITS = 1000 };

/* Returns log2(f K(x, x)) for the one-dimensional kernel K. */
static double bits_of(const koksma__l2_row *row, double x, double f)
{
    return koksma__log2(2 * koksma__l2_polynomial(row->g, x) * f);
}

/* Returns log2 M, with the M that the comment at the top of this file defines. */
static double bits_of_largest(const koksma__l2_row *row, const koksma_points *points)
{
    const size_t dim = (size_t)points->dim;
    double most = (double)dim * koksma__log2(row->c12 / 12);
    for (size_t i = 0; i < points->n; i++) {
        double bits = 0;
        for (size_t k = 0; k < dim; k++) {
            bits += bits_of(row, points->xs[i * dim + k], 1);
        }
        most = fmax(most, bits);
    }
    return most;
}

/* Returns whether the products over the first k coordinates of each point are in the range of doubles for all k.
   Points whose whole product is negligible are ignored. */
static bool stays_in_range(const koksma__l2_row *row, const koksma_points *points, double f)
{
    const size_t dim = (size_t)points->dim;
    for (size_t i = 0; i < points->n; i++) {
        double bits = 0, low = 0, high = 0;
        for (size_t k = 0; k < dim; k++) {
            bits += bits_of(row, points->xs[i * dim + k], f);
            low = fmin(low, bits);
            high = fmax(high, bits);
        }
        if (high > GUARD_BITS || (low < -GUARD_BITS && bits > -GUARD_BITS / 2)) {
            return false;
        }
    }
    return true;
}

static koksma_status fail_range(const koksma__l2_row *row, int dim)
{
    return koksma__fail(KOKSMA_DIM, "%s: in %d dimensions the value is beyond the range of doubles", row->name, dim);
}

/* Fails because an intermediate product is beyond the range of doubles; the value itself may be within that range. */
static koksma_status fail_product(const koksma__l2_row *row, int dim)
{
    return koksma__fail(KOKSMA_DIM,
                        "%s: in %d dimensions a product over the first coordinates of a point is beyond the range of "
                        "doubles; another order of the coordinates may work",
                        row->name, dim);
}

/* Writes to out the value whose square is `square` times 2^bits. */
static koksma_status unscale(const koksma__l2_row *row, double square, double bits, int dim, koksma_value *out)
{
    const double half = floor(bits / 2);
    out->value = ldexp(sqrt(square) * koksma__exp2(bits / 2 - half), (int)half);
    out->square = ldexp(square * koksma__exp2(bits - 2 * half), 2 * (int)half);
    if (!isfinite(out->value) || (square > 0 && out->value < 0x1p-1022)) {
        return fail_range(row, dim);
    }
    if (!isfinite(out->square) || (square > 0 && out->square < 0x1p-1022)) {
        out->square = NAN;
    }
    return KOKSMA_OK;
}

koksma_status koksma__l2_value_by_pairs(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                        koksma_value *out)
{
    const int dim = points->dim;
    if (!koksma__keep_going(run, 0)) {
        return koksma__fail_interrupted();
    }
    const double largest = dim > PLAIN_DIM ? bits_of_largest(row, points) : 0;
    koksma__l2_row scaled = *row;
    double f = 1;
    if (fabs(largest) > FAR_BITS) {
        int exponent;
        const double fraction = frexp(koksma__exp2(-largest / dim), &exponent);
        f = ldexp(round(32 * fraction), exponent - 5);
        for (int i = 0; i < 4; i++) {
            scaled.a24[i] *= f;
            scaled.g[i] *= f;
        }
        scaled.c12 *= f;
        scaled.q *= f;
        scaled.r *= f;
        if (!stays_in_range(row, points, f)) {
            return fail_product(row, dim);
        }
    }
    double square = NAN;
    const koksma_status status = koksma__l2_by_pairs(&scaled, points, run, &square);
    return status ? status : unscale(row, koksma__not_below_0(square), -dim * koksma__log2(f), dim, out);
}

/* ---- The choice of a method ------------------------------------------------------------------------------------ */

enum { SORT_FROM = 256 };

/* Returns whether to use divide and conquer. The table has the least n from which divide and conquer is faster than
   summing pairs (measured with AVX-512), by dimension and by the number of products of the kernel. Above n = 2^24 the
   lists of divide and conquer would take gigabytes. */
static bool divides(const koksma__l2_row *row, const koksma_points *points)
{
    static const size_t from[][3] = {{3072, 6144, 16384}, {8192, 49152, 131072}};
    const int ranks = koksma__l2_ranks(row);
    return points->dim >= 3 && points->dim <= KOKSMA__L2_DIVIDE_DIM &&
           points->n >= from[points->dim - 3][ranks - 1] && points->n <= (size_t)1 << 24;
}

koksma_status koksma__l2(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                         koksma_value *out)
{
    const bool sort = points->dim <= 2 && points->n >= SORT_FROM && points->n < (size_t)1 << 28;
    if (!sort && !divides(row, points)) {
        return koksma__l2_value_by_pairs(row, points, run, out);
    }
    const koksma_status status =
        (sort ? koksma__l2_by_sorting : koksma__l2_by_dividing)(row, points, run, &out->square);
    out->square = koksma__not_below_0(out->square);
    out->value = sqrt(out->square);
    return status;
}
