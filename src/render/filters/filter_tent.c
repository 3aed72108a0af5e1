/* SPDX-License-Identifier: Apache-2.0 */
/* The filter `tent` is f = 1 - |x|, a box convolved with a box. It is a partition of unity. */
#include <math.h>

#include "render/filters/filters.h"

static double value(double x)
{
    return fmax(1 - fabs(x), 0);
}

const koksma_filter koksma__filter_tent = {
    .name = "tent",
    .title = "a tent of width 2",
    .cite = "shirley1991",
    .radius = 1,
    .value = value,
};
