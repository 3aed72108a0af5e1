/* SPDX-License-Identifier: Apache-2.0 */
/* The filter `hermite` is f = 1 - 3 x^2 + 2 |x|^3, the cubic of Mitchell & Netravali (1988) with B = C = 0, which
   interpolates like Hermite's cubic with slopes of 0. It is separable, symmetric, of width 2, never negative and a
   partition of unity, as Shirley (1991, section 5.2) requires of a pixel filter; the formula of Shirley's own
   filter is not known. */
#include <math.h>

#include "render/filters/filters.h"

static double value(double x)
{
    const double a = fabs(x);
    return a < 1 ? 1 - a * a * (3 - 2 * a) : 0;
}

const koksma_filter koksma__filter_hermite = {
    .name = "hermite",
    .title = "Mitchell and Netravali's cubic, B = C = 0: two mirrored smoothsteps, of width 2",
    .cite = "mitchell1988",
    .radius = 1,
    .value = value,
};
