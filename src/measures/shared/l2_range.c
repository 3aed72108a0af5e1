/* SPDX-License-Identifier: Apache-2.0 */
/*
 * L2 discrepancies of hundreds of dimensions. With M the larger of c^d and max_i prod_k K(x_ik, x_ik), no term is
 * above M: |K(x, y)|^2 <= K(x, x) K(y, y) and a(x)^2 <= K(x, x) c, K being positive definite (Cauchy and Schwarz).
 * Where M is far from 1 the kernel of one dimension is multiplied by a factor f near M^(-1/d) of 5 bits, so that the
 * table's coefficients stay exact. The result is f^d times the square. Its root is divided by f^(d/2), and has half
 * the exponent: it stays a double in more dimensions than the square.
 */
#include <math.h>

#include "core/status.h"
#include "measures/shared/l2.h"

/* Up to PLAIN_DIM dimensions every term of every kind is a double. */
enum { PLAIN_DIM = 200, FAR_BITS = 900, GUARD_BITS = 1000 };

/* log2 of K(x, x) f in one dimension. */
static double bits_of(const koksma__l2_row *row, double x, double f)
{
    return log2(2 * koksma__l2_polynomial(row->g, x) * f);
}

/* log2 M */
static double bits_of_largest(const koksma__l2_row *row, const koksma_points *points)
{
    const size_t dim = (size_t)points->dim;
    double most = (double)dim * log2(row->c12 / 12);
    for (size_t i = 0; i < points->n; i++) {
        double bits = 0;
        for (size_t k = 0; k < dim; k++) {
            bits += bits_of(row, points->xs[i * dim + k], 1);
        }
        most = fmax(most, bits);
    }
    return most;
}

/* Whether the products are doubles also over the first coordinates alone, where they matter. */
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
    return koksma__fail(KOKSMA_DIM, "%s: in %d dimensions it is beyond the range of doubles", row->name, dim);
}

/* The value may be a double all the same. */
static koksma_status fail_product(const koksma__l2_row *row, int dim)
{
    return koksma__fail(KOKSMA_DIM,
                        "%s: in %d dimensions a product over the first coordinates of a point is beyond the range of "
                        "doubles; coordinates in another order may serve",
                        row->name, dim);
}

/* The value is that of `square` times 2^bits. */
static koksma_status unscale(const koksma__l2_row *row, double square, double bits, int dim, koksma_value *out)
{
    const double half = floor(bits / 2);
    out->value = ldexp(sqrt(square) * exp2(bits / 2 - half), (int)half);
    out->square = ldexp(square * exp2(bits - 2 * half), 2 * (int)half);
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
    const double largest = dim > PLAIN_DIM ? bits_of_largest(row, points) : 0;
    koksma__l2_row scaled = *row;
    double f = 1;
    if (fabs(largest) > FAR_BITS) {
        int exponent;
        const double fraction = frexp(exp2(-largest / dim), &exponent);
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
    return status ? status : unscale(row, koksma__not_below_0(square), -dim * log2(f), dim, out);
}
