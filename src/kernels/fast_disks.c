/* SPDX-License-Identifier: Apache-2.0 */
/* Disks on the torus. The arc cosine and the logarithm of their overlaps are polynomials here, so that whole vectors
   go through them and every instruction set gives the same bits; sums run in a fixed number of lanes. */
#include <math.h>
#include <string.h>

#include "kernels/kernels.h"

enum { LANES = 8 };

double KERNEL_NAME(disk_overlaps)(int law, double r, double x, double y, size_t count, const double *xs,
                                  const double *ys);

/* (asin(sqrt z) / sqrt z - 1) / z on [0, 1/4], to 2.4e-16: the Chebyshev fit of degree 11. */
static inline double asin_series(double z)
{
    static const double c[] = {0.166666666666666486,  0.0750000000002076436,  0.0446428571034236434,
                               0.0303819473670984811, 0.0223720476317445104,  0.0173552599557863217,
                               0.0139296529023266332, 0.0118754943826369232,  0.00780294947735331714,
                               0.0160355143491488231, -0.0107490503396978076, 0.0281692180608814129};
    double sum = c[11];
    for (int k = 10; k >= 0; k--) {
        sum = sum * z + c[k];
    }
    return sum;
}

/* acos of numbers in [0, 1], to 3e-16. */
static inline double arc_cosine(double x)
{
    const double half = (1 - x) / 2, z = x < 0.5 ? x * x : half, root = x < 0.5 ? x : sqrt(half);
    const double angle = root + root * (z * asin_series(z));
    return x < 0.5 ? M_PI / 2 - angle : 2 * angle;
}

/* ln of a normal number >= 1, to 3e-16 relative to 1 or to the result: the exponent, and 2 atanh((m-1)/(m+1)) of
   the mantissa m in [1/sqrt 2, sqrt 2] by its series. */
static inline double logarithm(double y)
{
    uint64_t bits;
    memcpy(&bits, &y, sizeof bits);
    const uint64_t exponent_bits = (bits >> 52) | 0x4330000000000000u, /* 2^52 + the exponent */
        mantissa_bits = (bits & 0xfffffffffffffu) | 0x3ff0000000000000u;
    double exponent, m;
    memcpy(&exponent, &exponent_bits, sizeof exponent);
    memcpy(&m, &mantissa_bits, sizeof m);
    exponent -= 0x1p52 + 1023;
    exponent = m > M_SQRT2 ? exponent + 1 : exponent;
    m = m > M_SQRT2 ? m / 2 : m;
    const double s = (m - 1) / (m + 1), z = s * s;
    double sum = 1.0 / 21;
    for (int k = 19; k >= 1; k -= 2) {
        sum = sum * z + 1.0 / k;
    }
    return exponent * M_LN2 + 2 * (s * sum);
}

/* The overlap for r = 1 of disks whose centres are 2q apart; 0 from q = 1 on. */
static inline double overlap(int law, double q)
{
    const double t = q < 1 ? q : 1, s = sqrt((1 - t) * (1 + t)),
                 angle = arc_cosine(t); /* 1 - t * t cancels at t = 1 */
    if (law == 0) {
        return 2 * (angle - t * s);
    }
    if (law == 1) {
        const double u = t > 1e-90 ? t : 1e-90;
        return (2 * angle - 4 * (t * s) + 2 * (t * t * t) * logarithm((1 + s) / u)) / 3;
    }
    return angle - (5 * (t * (s * s * s))) / 3 - (t * t * t) * s;
}

static inline double overlap_images(int law, int images, double scale, double x, double y, double px, double py)
{
    const double ax = fabs(x - px), ay = fabs(y - py), bx = 1 - ax, by = 1 - ay;
    if (images == 1) {
        const double a = ax < bx ? ax : bx, b = ay < by ? ay : by;
        return overlap(law, scale * sqrt(a * a + b * b));
    }
    return (overlap(law, scale * sqrt(ax * ax + ay * ay)) + overlap(law, scale * sqrt(bx * bx + by * by))) +
           (overlap(law, scale * sqrt(ax * ax + by * by)) + overlap(law, scale * sqrt(bx * bx + ay * ay)));
}

static inline double sum_lanes(const double *lanes)
{
    return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}

static inline double sum_overlaps(int law, int images, double r, double x, double y, size_t count, const double *xs,
                                  const double *ys)
{
    double lanes[LANES] = {0};
    const double scale = 1 / (2 * r);
    size_t j = 0;
    for (; j + LANES <= count; j += LANES) {
        for (size_t l = 0; l < LANES; l++) {
            lanes[l] += overlap_images(law, images, scale, x, y, xs[j + l], ys[j + l]);
        }
    }
    for (; j < count; j++) {
        lanes[j % LANES] += overlap_images(law, images, scale, x, y, xs[j], ys[j]);
    }
    return r * r * sum_lanes(lanes);
}

double KERNEL_NAME(disk_overlaps)(int law, double r, double x, double y, size_t count, const double *xs,
                                  const double *ys)
{
    /* Up to r = 1/4 only the nearest image can overlap; up to 1/2 the four nearest. */
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
