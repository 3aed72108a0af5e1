/* SPDX-License-Identifier: Apache-2.0 */
/* plane: n.(p - c) = 0, infinite. */
#include "render/shapes/flat_loops.h"

static int within(const koksma__batch_shape *s, float u, float v)
{
    (void)s, (void)u, (void)v;
    return 1;
}

KOKSMA__FLAT_LOOPS(within)

static koksma_status parse(const char *name, const field *f, koksma_scene *scene, koksma__shape *shape)
{
    shape->half[0] = shape->half[1] = INFINITY;
    return koksma__shape_axes(name, f, scene, shape);
}

static double equation(const koksma__shape *shape, const double p[3], double *beyond)
{
    double uv[2];
    const double height = koksma__flat_coordinates(shape, p, uv);
    *beyond = -1;
    return height;
}

static const koksma__parameter parameters[] = {KOKSMA__SHAPE_CENTRE, KOKSMA__SHAPE_NORMAL, {0}};

const koksma__shape_type KOKSMA__SHAPE(plane) = {
    .kind = {.name = "plane",
             .title = "an infinite plane",
             .cite = "-",
             .parameters = parameters,
             .keys = KOKSMA__FLAT_SHAPE_KEYS},
    .is_flat = true,
    .takes_checker = true,
    .parse = parse,
    .equation = equation,
    .hit = hit,
    .shade = shade,
    .only = only,
};
