/* SPDX-License-Identifier: Apache-2.0 */
/* Overlaps of disks on the torus. The arc cosine and the logarithm in the formulas are evaluated as polynomials on
   whole vectors, and sums run in a fixed number of lanes, so that every instruction set gives the same bits. */
#include <math.h>
#include <string.h>

#include "kernels/kernels.h"
#include "kernels/lanes64.h"

enum { LANES = 8, VECTORS = LANES / LANES64 };

/* Coefficients of (asin(sqrt z) / sqrt z - 1) / z on [0, 1/4]: a Chebyshev fit of degree 11 with an error of 2.4e-16.
   */
static inline lanes64_d asin_series(lanes64_d z)
{
    static const double c[] = {0.166666666666666486,  0.0750000000002076436,  0.0446428571034236434,
                               0.0303819473670984811, 0.0223720476317445104,  0.0173552599557863217,
                               0.0139296529023266332, 0.0118754943826369232,  0.00780294947735331714,
                               0.0160355143491488231, -0.0107490503396978076, 0.0281692180608814129};
    lanes64_d sum = lanes64_splat_d(c[11]);
    for (int k = 10; k >= 0; k--) {
        sum = sum * z + c[k];
    }
    return sum;
}

/* Returns acos of numbers in [0, 1] with an error of 3e-16. */
static inline lanes64_d arc_cosine(lanes64_d x)
{
    const lanes64_i low = (lanes64_i)(x < 0.5);
    const lanes64_d half = (1 - x) / 2, z = lanes64_chosen(low, x * x, half);
    const lanes64_d root = lanes64_chosen(low, x, lanes64_sqrt(half)), angle = root + root * (z * asin_series(z));
    return lanes64_chosen(low, M_PI / 2 - angle, 2 * angle);
}

/* Returns the logarithm of a normal number >= 1, with an error of 3e-16 relative to the larger of 1 and the result.
   It is the exponent times ln 2, plus the series of ln m = 2 atanh((m-1)/(m+1)) for the mantissa m in [1/sqrt 2, sqrt
   2]. */
static inline lanes64_d logarithm(lanes64_d y)
{
    const lanes64_d biased = (lanes64_d)(((lanes64_u)y >> 52) | 0x4330000000000000u); /* 2^52 + the exponent */
    const lanes64_d exponent = biased - (0x1p52 + 1023);
    const lanes64_d m = (lanes64_d)(((lanes64_u)y & 0xfffffffffffffu) | 0x3ff0000000000000u);
    const lanes64_i high = (lanes64_i)(m > M_SQRT2);
    const lanes64_d nearest = lanes64_chosen(high, m / 2, m), s = (nearest - 1) / (nearest + 1), z = s * s;
    lanes64_d sum = lanes64_splat_d(1.0 / 21);
    for (int k = 19; k >= 1; k -= 2) {
        sum = sum * z + 1.0 / k;
    }
    return lanes64_chosen(high, exponent + 1, exponent) * M_LN2 + 2 * (s * sum);
}

/* Returns the overlap of two disks of radius 1 whose centres are 2q apart; 0 for q >= 1. */
static inline lanes64_d overlap(int law, lanes64_d q)
{
    const lanes64_d t = lanes64_min(q, lanes64_splat_d(1)), s = lanes64_sqrt((1 - t) * (1 + t)),
                    angle = arc_cosine(t); /* 1 - t * t cancels at t = 1 */
    if (law == 0) {
        return 2 * (angle - t * s);
    }
    if (law == 1) {
        const lanes64_d u = lanes64_max(t, lanes64_splat_d(1e-90));
        return (2 * angle - 4 * (t * s) + 2 * (t * t * t) * logarithm((1 + s) / u)) / 3;
    }
    return angle - (5 * (t * (s * s * s))) / 3 - (t * t * t) * s;
}

static inline lanes64_d overlap_at(int law, double scale, lanes64_d dx, lanes64_d dy)
{
    return overlap(law, scale * lanes64_sqrt(dx * dx + dy * dy));
}

static inline lanes64_d overlap_images(int law, int images, double scale, lanes64_d ax, lanes64_d ay)
{
    const lanes64_d bx = 1 - ax, by = 1 - ay;
    if (images == 1) {
        return overlap_at(law, scale, lanes64_min(ax, bx), lanes64_min(ay, by));
    }
    return (overlap_at(law, scale, ax, ay) + overlap_at(law, scale, bx, by)) +
           (overlap_at(law, scale, ax, by) + overlap_at(law, scale, bx, ay));
}

/* The last vectors are padded with disks at infinity, which overlap nothing and add 0. */
static inline double sum_overlaps(int law, int images, double r, double x, double y, size_t count, const double *xs,
                                  const double *ys)
{
    lanes64_d sums[VECTORS] = {{0}};
    const double scale = 1 / (2 * r);
    double lanes[LANES], rest[2][LANES];
    for (size_t j = 0; j < count; j += LANES) {
        const bool whole = count - j >= LANES;
        for (size_t l = 0; l < LANES && !whole; l++) {
            rest[0][l] = l < count - j ? xs[j + l] : (double)INFINITY;
            rest[1][l] = l < count - j ? ys[j + l] : (double)INFINITY;
        }
        for (size_t v = 0; v < VECTORS; v++) {
            const lanes64_d px = lanes64_load_d((whole ? xs + j : rest[0]) + v * LANES64);
            const lanes64_d py = lanes64_load_d((whole ? ys + j : rest[1]) + v * LANES64);
            sums[v] += overlap_images(law, images, scale, lanes64_abs(x - px), lanes64_abs(y - py));
        }
    }
    memcpy(lanes, sums, sizeof lanes);
    return r * r *
           (((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7])));
}

double KERNEL_NAME(disk_overlaps)(int law, double r, double x, double y, size_t count, const double *xs,
                                  const double *ys)
{
    /* For r <= 1/4 only the nearest periodic image of a disk can overlap; for r <= 1/2 the four nearest can. */
    switch (2 * law + (r > 0.25)) {
    case 0:
        return sum_overlaps(0, 1, r, x, y, count, xs, ys);
    case 1:
        return sum_overlaps(0, 4, r, x, y, count, xs, ys);
    case 2:
        return sum_overlaps(1, 1, r, x, y, count, xs, ys);
    case 3:
        return sum_overlaps(1, 4, r, x, y, count, xs, ys);
    case 4:
        return sum_overlaps(2, 1, r, x, y, count, xs, ys);
    default:
        return sum_overlaps(2, 4, r, x, y, count, xs, ys);
    }
}
