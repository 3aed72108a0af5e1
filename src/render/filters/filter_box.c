/* SPDX-License-Identifier: Apache-2.0 */
/* The filter `box` is 1 within the pixel and 0 elsewhere. It is a partition of unity. */
#include <math.h>

#include "render/filters/filters.h"

static double value(double x)
{
    return fabs(x) <= 0.5 ? 1 : 0;
}

const koksma_filter koksma__filter_box = {
    .name = "box",
    .title = "the mean over the area of the pixel",
    .cite = "shirley1991",
    .radius = 0.5,
    .value = value,
};
