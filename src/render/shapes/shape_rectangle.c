/* SPDX-License-Identifier: Apache-2.0 */
/* rectangle: n.(p - c) = 0 with |u| <= half[0] and |v| <= half[1]. */
#include "render/shapes/flat_loops.h"

static int within(const koksma__batch_shape *s, float u, float v)
{
    return (fabsf(u) <= s->half_u) & (fabsf(v) <= s->half_v);
}

KOKSMA__FLAT_LOOPS(within)

static double equation(const koksma__shape *shape, const double p[3], double *beyond)
{
    double uv[2];
    const double height = koksma__flat_coordinates(shape, p, uv);
    *beyond = fmax(fabs(uv[0]) - shape->half[0], fabs(uv[1]) - shape->half[1]);
    return height;
}

static const koksma__parameter parameters[] = {
    {"half", KOKSMA__HALF, .at = offsetof(koksma__shape, half)}, KOKSMA__SHAPE_CENTRE, KOKSMA__SHAPE_NORMAL, {0}};

const koksma__shape_type KOKSMA__SHAPE(rectangle) = {
    .kind = {.name = "rectangle",
             .title = "a rectangle of half sides `half` along u and v",
             .cite = "-",
             .parameters = parameters,
             .keys = KOKSMA__FLAT_SHAPE_KEYS},
    .is_flat = true,
    .takes_checker = true,
    .takes_image = true,
    .parse = koksma__shape_axes,
    .equation = equation,
    .hit = hit,
    .shade = shade,
    .only = only,
};
