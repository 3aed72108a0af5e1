/* SPDX-License-Identifier: Apache-2.0 */
/*
 * triangle: x = 1 - sqrt(1 - u_0), y = u_1 sqrt(1 - u_0): strips of u_0 become strips along a side; area is kept.
 * The side u_0 = 1 of the square shrinks to a corner. Source: Turk 1990.
 */
#include <math.h>

#include "warps/warps.h"

static void map(const double *u, double *x)
{
    const double root = sqrt(1 - u[0]);
    x[0] = 1 - root;
    x[1] = u[1] * root;
}

const koksma_warp koksma__warp_triangle = {
    .name = "triangle",
    .title = "square-root map of a triangle",
    .cite = "turk1990",
    .domain = KOKSMA_DOMAIN_TRIANGLE,
    .dim = 2,
    .map = map,
};
