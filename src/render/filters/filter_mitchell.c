/* SPDX-License-Identifier: Apache-2.0 */
/* The filter `mitchell` is the cubic of Mitchell & Netravali (1988) with B = C = 1/3, negative from 8/7 to 2. It
   is a partition of unity:
     |x| < 1:  (7 |x|^3 - 12 x^2 + 16/3) / 6       1 <= |x| < 2:  (-7/3 |x|^3 + 12 x^2 - 20 |x| + 32/3) / 6 */
#include <math.h>

#include "render/filters/filters.h"

static double value(double x)
{
    const double a = fabs(x);
    return a < 1   ? ((7 * a - 12) * a * a + 16.0 / 3) / 6
           : a < 2 ? (((-7.0 / 3 * a + 12) * a - 20) * a + 32.0 / 3) / 6
                   : 0;
}

const koksma_filter koksma__filter_mitchell = {
    .name = "mitchell",
    .title = "Mitchell and Netravali's cubic, B = C = 1/3; negative beyond 8/7, so use --splat",
    .cite = "mitchell1988",
    .radius = 2,
    .value = value,
};
