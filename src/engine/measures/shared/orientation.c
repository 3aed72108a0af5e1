/* SPDX-License-Identifier: Apache-2.0 */
/* Computes the exact sign of a cross product (Shewchuk 1997). The product is first computed in doubles, with an error
   bound. If the bound leaves the sign open, the 16 exact products of the exact differences are summed as an
   expansion, and the sign of its largest part is the result. Before this the numbers are multiplied by a power of
   two, so that no part of a product underflows. */
#include "measures/shared/shared.h"

#include <math.h>

#include "core/double_double.h"

enum { PARTS = 32 };

/* Adds x to a nonoverlapping expansion of `count` parts, smallest first. */
static void grow(double *parts, int *count, double x)
{
    int kept = 0;
    for (int i = 0; i < *count; i++) {
        const koksma__dd s = koksma__dd_sum(x, parts[i]);
        x = s.hi;
        if (s.lo != 0) {
            parts[kept++] = s.lo;
        }
    }
    if (x != 0) {
        parts[kept++] = x;
    }
    *count = kept;
}

static void grow_product(double *parts, int *count, koksma__dd a, koksma__dd b, double sign)
{
    const double as[2] = {a.lo, a.hi}, bs[2] = {b.lo, b.hi};
    for (int i = 0; i < 4; i++) {
        const koksma__dd p = koksma__dd_product(as[i / 2], bs[i % 2]);
        grow(parts, count, sign * p.lo);
        grow(parts, count, sign * p.hi);
    }
}

int koksma__sign_of_cross(const double a[2], const double b[2], const double c[2], const double d[2])
{
    const double left = (a[0] - a[1]) * (b[0] - b[1]), right = (c[0] - c[1]) * (d[0] - d[1]);
    const double det = left - right, terms = fabs(left) + fabs(right), bound = 4.5e-16 * terms;
    if (terms > 1e-290 && (det > bound || det < -bound)) {
        return det > 0 ? 1 : -1;
    }
    const double *const pairs[4] = {a, b, c, d};
    koksma__dd exact[4];
    double most = 0, parts[PARTS];
    int count = 0;
    for (int i = 0; i < 8; i++) {
        most = fmax(most, fabs(pairs[i / 2][i % 2]));
    }
    const double scale = most < 0x1p-300 ? 0x1p600 : 0x1p500;
    for (int i = 0; i < 4; i++) {
        exact[i] = koksma__dd_sum(pairs[i][0] * scale, -pairs[i][1] * scale);
    }
    grow_product(parts, &count, exact[0], exact[1], 1);
    grow_product(parts, &count, exact[2], exact[3], -1);
    return count == 0 ? 0 : parts[count - 1] > 0 ? 1 : -1;
}
