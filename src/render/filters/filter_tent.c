/* SPDX-License-Identifier: Apache-2.0 */
/* tent: f = 1 - |x|, the box smoothed by a box. A partition of unity. */
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
