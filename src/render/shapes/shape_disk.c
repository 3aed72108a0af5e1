/* SPDX-License-Identifier: Apache-2.0 */
/* disk: n.(p - c) = 0 with u^2 + v^2 <= r^2. */
#include "render/shapes/flat_loops.h"

static int within(const koksma__batch_shape *s, float u, float v)
{
    return u * u + v * v <= s->radius2;
}

KOKSMA__FLAT_LOOPS(within)

static double equation(const koksma__shape *shape, const double p[3], double *beyond)
{
    double uv[2];
    const double height = koksma__flat_coordinates(shape, p, uv);
    *beyond = hypot(uv[0], uv[1]) - shape->half[0];
    return height;
}

static const koksma__parameter parameters[] = {
    {"radius", KOKSMA__RADIUS, .at = offsetof(koksma__shape, half)}, KOKSMA__SHAPE_CENTRE, KOKSMA__SHAPE_NORMAL, {0}};

const koksma__shape_type KOKSMA__SHAPE(disk) = {
    .kind =
        {.name = "disk", .title = "a disk", .cite = "-", .parameters = parameters, .keys = KOKSMA__FLAT_SHAPE_KEYS},
    .is_flat = true,
    .takes_checker = true,
    .parse = koksma__shape_axes,
    .equation = equation,
    .hit = hit,
    .shade = shade,
    .only = only,
};
