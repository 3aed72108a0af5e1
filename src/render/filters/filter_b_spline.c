/* SPDX-License-Identifier: Apache-2.0 */
/* The filter `b-spline` is the cubic B-spline, the box filter convolved three times with a box. It is a partition
   of unity:
     |x| < 1:  2/3 - x^2 + |x|^3 / 2       1 <= |x| < 2:  (2 - |x|)^3 / 6 */
#include <math.h>

#include "render/filters/filters.h"

static double value(double x)
{
    const double a = fabs(x);
    return a < 1 ? 2.0 / 3 - a * a * (1 - a / 2) : a < 2 ? (2 - a) * (2 - a) * (2 - a) / 6 : 0;
}

const koksma_filter koksma__filter_b_spline = {
    .name = "b-spline",
    .title = "the cubic B-spline",
    .cite = "mitchell1988",
    .radius = 2,
    .value = value,
};
