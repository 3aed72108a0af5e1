/* SPDX-License-Identifier: Apache-2.0 */
/* gaussian: exp(-x^2 / (2 s^2)) - exp(-r^2 / (2 s^2)), s = 1/2, r = 1.5 pixels: lowered so that it ends at 0. No
   partition of unity. */
#include <math.h>

#include "render/filters/filters.h"

static double value(double x)
{
    return fmax(exp(-2 * x * x) - exp(-4.5), 0);
}

const koksma_filter koksma__filter_gaussian = {
    .name = "gaussian",
    .title = "a Gaussian, sigma 1/2, cut at 1.5",
    .cite = "cook1986",
    .radius = 1.5,
    .value = value,
};
