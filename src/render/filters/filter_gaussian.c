/* SPDX-License-Identifier: Apache-2.0 */
/* The filter `gaussian` is exp(-x^2 / (2 s^2)) - exp(-r^2 / (2 s^2)) with s = 1/2 and r = 1.5 pixels, a Gaussian
   lowered so that it is 0 at the radius r. It is not a partition of unity. */
#include <math.h>

#include "render/filters/filters.h"

static double value(double x)
{
    return fmax(exp(-2 * x * x) - exp(-4.5), 0);
}

const koksma_filter koksma__filter_gaussian = {
    .name = "gaussian",
    .title = "a Gaussian of sigma 1/2 pixel, cut off at 1.5 pixels",
    .cite = "cook1986",
    .radius = 1.5,
    .value = value,
};
