/* SPDX-License-Identifier: Apache-2.0 */
/* After Shewchuk 1997: in doubles with an error bound first; where that does not decide, the 16 exact products of the
   exact differences are summed as an expansion, whose largest part has the sign. */
#include "measures/parts/orientation.h"

#include <math.h>

#include "measures/parts/double_double.h"

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
    const double det = left - right, bound = 4.5e-16 * (fabs(left) + fabs(right));
    if (det > bound || det < -bound) {
        return det > 0 ? 1 : -1;
    }
    double parts[PARTS];
    int count = 0;
    grow_product(parts, &count, koksma__dd_sum(a[0], -a[1]), koksma__dd_sum(b[0], -b[1]), 1);
    grow_product(parts, &count, koksma__dd_sum(c[0], -c[1]), koksma__dd_sum(d[0], -d[1]), -1);
    return count == 0 ? 0 : parts[count - 1] > 0 ? 1 : -1;
}
