/* SPDX-License-Identifier: Apache-2.0 */
/* The filter `blackman-harris` is the four-term window of Harris (1978), stretched to a radius of 1.5 pixels. It
   is not a partition of unity. */
#include <math.h>

#include "render/filters/filters.h"

static double value(double x)
{
    const double turn = M_PI * x / 1.5;
    return fabs(x) < 1.5 ? 0.35875 + 0.48829 * cos(turn) + 0.14128 * cos(2 * turn) + 0.01168 * cos(3 * turn) : 0;
}

const koksma_filter koksma__filter_blackman_harris = {
    .name = "blackman-harris",
    .title = "the Blackman-Harris window with a radius of 1.5 pixels",
    .cite = "harris1978",
    .radius = 1.5,
    .value = value,
};
