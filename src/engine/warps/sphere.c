/* SPDX-License-Identifier: Apache-2.0 */
/*
 * sphere: height 1 - 2 u_0, angle 2 pi u_1; the directions are uniform in solid angle (the inverse of Lambert's
 * cylindrical equal-area projection). The sides u_0 = 0 and u_0 = 1 of the square shrink to the poles. Source: Brauchart
 * & Dick 2012, who lift (0,m,2)-nets to the sphere by this map.
 */
#include <math.h>

#include "core/elementary.h"
#include "warps/warps.h"

static void map(const double *u, double *x)
{
    const double height = u[0], radius = 2 * sqrt(height * (1 - height)); /* copied because x may be the same array */
    koksma__cos_sin(2 * M_PI * u[1], &x[0], &x[1]);
    x[0] *= radius;
    x[1] *= radius;
    x[2] = 1 - 2 * height;
}

const koksma_warp koksma__warp_sphere = {
    .name = "sphere",
    .title = "(u, v) to height 1 - 2u and angle 2 pi v on the whole sphere; uniform directions",
    .cite = "brauchart2012",
    .domain = KOKSMA_DOMAIN_SPHERE,
    .dim = 3,
    .map = map,
};
