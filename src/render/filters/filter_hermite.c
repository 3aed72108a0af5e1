/* SPDX-License-Identifier: Apache-2.0 */
/* hermite: f = 1 - 3 x^2 + 2 |x|^3: separable, symmetric, of width 2, never negative, and a partition of unity, which
   are the properties that Shirley (1991, section 5.2) asks of a pixel filter; among those the one of least degree
   without slopes at 0 and 1. His own formula is another. */
#include <math.h>

#include "render/filters/filters.h"

static double value(double x)
{
    const double a = fabs(x);
    return a < 1 ? 1 - a * a * (3 - 2 * a) : 0;
}

const koksma_filter koksma__filter_hermite = {
    .name = "hermite",
    .title = "the smooth step of width 2",
    .cite = "shirley1991",
    .radius = 1,
    .value = value,
};
